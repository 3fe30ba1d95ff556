"""Where a tree of limbs touches the ground, how strongly that resists, and where it acts.

As for the strip of [Majidi13], section 2.2: a limb whose free end is inflated touches by its tip,
which resists by V_t; one without pressure lies on its side over a length that follows from the
ground's forces (analytic.contact), which resists by tau times its area. A limb that lies flat as a
whole passes on to its carrier what its side does not carry. Limbs that begin at one place share
the tip force of an end by their widths.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic import pneunet
from analytic.contact import flat_length, may_lie_flat
from analytic.friction import LAWS
from analytic.ground import surfaces_of
from analytic.robot import Robot
from analytic.surface import Ground, Surface
from analytic.tree.kinematics import Tree
from analytic.tree.statics import Rest

Array = NDArray[np.float64]

_RIPPLE = 0.2  # of w L h^3 / D0: how high a flat stretch ripples between nodes; as for a strip
_POINTS = (0.5 - 12**-0.5, 0.5 + 12**-0.5)  # of a side: two that resist turning as all of it does
_NEAR, _WHOLE = 2, 1e-9  # elements from an end that count as there; of a length: all of it
_TOUCHES = 1e-6  # of the weight: a node that pushes less hovers


class Contact(NamedTuple):
    """One limb on the ground.

    Attributes:
        limb: its place.
        length: of side contact, 0 for a point [m].
        at: arclengths of the points that it resists at [m].
        load: normal force on the whole [N].
    """

    limb: int
    length: float
    at: tuple[float, ...]
    load: float


class Contacts:
    """Finds the contacts of a tree.

    Args:
        tree: its links.
        law: of friction, a name of analytic.friction.LAWS.
    """

    def __init__(self, tree: Tree, law: str = "constant") -> None:
        self._tree, self._law = tree, LAWS[law]
        robot = tree.robot
        self._up = [_ripple(limb.strip, tree.elements) for limb in robot.limbs]
        self._per_limb = tree.elements + 2
        at_place: dict[tuple[str | None, str], float] = {}
        for limb in robot.limbs:
            key = (limb.on, limb.at)
            at_place[key] = at_place.get(key, 0.0) + limb.strip.width
        self._share = [limb.strip.width / at_place[limb.on, limb.at] for limb in robot.limbs]
        self._leaves = {limb.name for limb in robot.limbs} - {limb.on for limb in robot.limbs}

    def find(self, rest: Rest, pressures: Array) -> list[Contact]:
        """The contacts of a state at pressures of its limbs, (L,) [Pa]."""
        robot, found = self._tree.robot, []
        passed: dict[tuple[int, str], float] = {}  # what flat limbs pass on to ends of carriers
        reached: set[tuple[int, str]] = set()  # ends of carriers where a limb is flat, or nearly
        order = range(len(robot.limbs) - 1, -1, -1)  # those that are carried come first
        least = _TOUCHES * robot.weight
        for i in order:
            limb = robot.limbs[i]
            force, height = self._of_limb(rest, i)
            ends = [(end, passed[i, end]) for end in ("begin", "end") if (i, end) in passed]
            if limb.name in self._leaves:
                ends = [("end", 0.0)]
            flat_may = bool(may_lie_flat(pressures[i], robot.peak_pressure))
            touched = force > least
            for end, more in ends:
                joint, on_ground = self._beyond(rest, i) if end == "end" else (0.0, False)
                contact, rest_of = self._at_end(
                    i, end, (more, joint, on_ground), force, height, flat_may, least
                )
                if contact is None:
                    continue
                found.append(contact)
                touched &= ~self._within(i, end, contact.length)
                if limb.on is None:
                    continue
                key = (robot.place(limb.on), limb.at)
                if contact.length >= limb.strip.length * (1 - _NEAR / self._tree.elements):
                    reached.add(key)
                if contact.length >= limb.strip.length * (1 - _WHOLE):
                    passed[key] = passed.get(key, 0.0) + rest_of
            # a joint belongs to the limb that is flat there, and else to the carrier
            for end in ("begin", "end"):
                if (i, end) in reached or (end == "begin" and limb.on is not None):
                    touched &= ~self._within(i, end, 0.0)
            if touched.any() and not (limb.name in self._leaves and found and found[-1].limb == i):
                found += self._between(i, force * touched)
        return found

    def places(self, rest: Rest, contacts: list[Contact]) -> Array:
        """Places of all points that resist, (C, 2) [m]."""
        return np.array(
            [self.point(rest, contact.limb, at) for contact in contacts for at in contact.at]
        ).reshape(-1, 2)

    def resistance(self, contact: Contact, surface: Surface) -> tuple[float, float]:
        """Bound of friction [N] and viscous resistance [N s/m] of each point of a contact."""
        width, points = self._tree.robot.limbs[contact.limb].strip.width, len(contact.at)
        bound = self._law.bound(surface, width, contact.length, contact.load)
        if not contact.length and not self._law.needs_load:
            bound *= self._share[contact.limb]
        return float(bound) / points, float(surface.drag(width, contact.length)) / points

    def point(self, rest: Rest, limb: int, at: float) -> Array:
        """Place of a point of a limb's middle line in plan, (2,) [m]."""
        here, half = self._slice(limb), len(rest.nodes) // 2
        middle = 0.5 * (rest.nodes[:half][here] + rest.nodes[half:][here])
        arclength = self._tree.arclength[here]
        return np.array([np.interp(at, arclength, middle[:, k]) for k in (0, 1)])

    def _slice(self, limb: int) -> slice:
        return slice(limb * self._per_limb, (limb + 1) * self._per_limb)

    def _of_limb(self, rest: Rest, limb: int) -> tuple[Array, Array]:
        """Force on each vertex, both edges together, and height of the lower edge.

        A leg that leans lies on one of its edges.
        """
        here, half = self._slice(limb), len(rest.force) // 2
        force = rest.force[:half][here] + rest.force[half:][here]
        height = np.minimum(rest.nodes[:half][here, 2], rest.nodes[half:][here, 2])
        return force, height

    def _beyond(self, rest: Rest, limb: int) -> tuple[float, bool]:
        """Of the carrier where a limb begins: the push there, and whether it is flat on from there.

        The two share a joint, and which of them the ground pushes there is open.
        """
        own = self._tree.robot.limbs[limb]
        if own.on is None:
            return 0.0, False
        carrier = self._tree.robot.place(own.on)
        force, height = self._of_limb(rest, carrier)
        if own.at == "end":
            force, height = force[::-1], height[::-1]
        return self._share[limb] * float(force[0]), bool(height[:3].max() <= self._up[carrier])

    def _within(self, limb: int, end: str, length: float) -> NDArray[np.bool_]:
        strip = self._tree.robot.limbs[limb].strip
        at = self._tree.arclength[self._slice(limb)]
        away = at if end == "begin" else strip.length - at
        spacing = strip.length / self._tree.elements
        return np.asarray(away <= length + _NEAR * spacing)

    def _at_end(
        self,
        i: int,
        end: str,
        more: tuple[float, float, bool],
        force: Array,
        height: Array,
        may: bool,
        least: float,
    ) -> tuple[Contact | None, float]:
        """The contact that begins at an end of a limb, and what it does not carry itself [N].

        Args:
            i, end: the limb and which end.
            more: what is passed on to it there; what its carrier is pushed by at the other end, and
                whether that is flat on from there.
            force, height: of its vertices.
            may: whether it may lie flat, by its pressure.
            least: force that counts.
        """
        strip = self._tree.robot.limbs[i].strip
        at = self._tree.arclength[self._slice(i)]
        away = at if end == "begin" else strip.length - at
        order = np.argsort(away)
        up = np.cumsum(height[order] > self._up[i]) > 0
        run = order[~up]
        passed, joint, on_ground = more
        total, moment = float(force[run].sum()) + passed, float(force[run] @ away[run])
        if total <= least:
            return None, 0.0
        if not may:
            if end == "end" and self._tree.robot.limbs[i].name in self._leaves:
                return Contact(i, 0.0, (float(at[-1]),), total), 0.0
            return None, 0.0
        weight = strip.weight_per_length
        whole = len(run) == len(at) and on_ground
        if len(run) == len(at) and not on_ground:
            total, moment = total + joint, moment + joint * strip.length
        length = strip.length if whole else float(flat_length(weight, total, moment))
        length = min(length, strip.length)
        if length <= 0:
            return Contact(i, 0.0, (float(at[0 if end == "begin" else -1]),), total), 0.0
        points = tuple(
            float(length * p if end == "begin" else strip.length - length * p) for p in _POINTS
        )
        return Contact(i, length, points, total), total - weight * length

    def _between(self, i: int, force: Array) -> list[Contact]:
        """A limb that touches with no end of its own: by a point, where it pushes."""
        at, load = self._tree.arclength[self._slice(i)], float(force.sum())
        return [Contact(i, 0.0, (float(force @ at / load),), load)]


def _ripple(strip: Robot, elements: int) -> float:
    spacing = strip.length / elements
    unit = strip.weight_per_length * strip.length * spacing**3 / pneunet.base_rigidity(strip)
    return _RIPPLE * unit * 4  # wider links are four thirds of an element


def check_ground(ground: Ground) -> None:
    """Raise ValueError for ground that limbs are not told of: sticky, or stronger at rest."""
    for surface in surfaces_of(ground):
        if surface.adhesion or surface.static_ratio > 1:
            what = "adhesion" if surface.adhesion else "static_ratio"
            raise ValueError(
                f"{what} of surface {surface.name!r} is for strips, not for robots of limbs; got "
                f"{getattr(surface, what)!r}"
            )
