"""Contacts of a tree of limbs with the ground: where they are and how strongly they resist.

As for the strip of [Majidi13], section 2.2: a limb whose free end is inflated touches by its tip,
which resists by V_t and carries all that pushes the limb; one without pressure lies on its side
over a length that follows from the ground's forces (analytic.friction.contact_length), which
resists by tau times its area; an underside that touches in between is a side of no area. A limb
that lies flat as a whole passes on to its carrier what its side does not carry. Limbs that begin at
one place share the tip force of an end by their widths.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import flat_length, may_lie_flat
from analytic.friction.contact_length import ripple as strip_ripple
from analytic.friction.laws import LAWS
from analytic.scene.ground import surfaces_of
from analytic.scene.limbs import TreeRobot
from analytic.scene.robot import Robot
from analytic.scene.surface import Ground, Surface
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.statics import Rest

Array = NDArray[np.float64]

_POINTS = (0.5 - 12**-0.5, 0.5 + 12**-0.5)  # of a side: two that resist turning as all of it does
_NEAR, _WHOLE = 2, 1e-9  # elements from an end that count as there; of a length: all of it
_HARDLY = 1e-9  # of a length
_TOUCHES = 1e-6  # of the weight: a node that pushes less hovers
_INSTANT = 1e-12  # s; a shortest increment


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
    """Finds the contacts of a tree; in plain floats, since numpy is slow on a few numbers.

    Args:
        tree: its links.
        law: of friction, a name of analytic.friction.laws.LAWS.
    """

    def __init__(self, tree: Tree, law: str = "constant") -> None:
        self._tree, self._law = tree, LAWS[law]
        robot = tree.robot
        self._up = [ripple(limb.strip, tree.elements) for limb in robot.limbs]
        self._per_limb = tree.elements + 2
        at_place: dict[tuple[str | None, str], float] = {}
        for limb in robot.limbs:
            key = (limb.on, limb.at)
            at_place[key] = at_place.get(key, 0.0) + limb.strip.width
        self._share = [limb.strip.width / at_place[limb.on, limb.at] for limb in robot.limbs]
        self._carrier = [-1 if limb.on is None else robot.place(limb.on) for limb in robot.limbs]
        self._free = [_free_ends(robot, i) for i in range(len(robot.limbs))]
        self._at = [tree.arclength[self._slice(i)].tolist() for i in range(len(robot.limbs))]
        self._least = _TOUCHES * robot.weight
        self._near = [_NEAR * limb.strip.length / tree.elements for limb in robot.limbs]

    def find(self, rest: Rest, pressures: Array) -> list[Contact]:
        """The contacts of a state at pressures of its limbs, (L,) [Pa]."""
        robot, half = self._tree.robot, len(rest.force) // 2
        # both edges together; a limb that leans lies on one of its edges
        forces = (rest.force[:half] + rest.force[half:]).tolist()
        heights = np.minimum(rest.nodes[:half, 2], rest.nodes[half:, 2]).tolist()
        may = may_lie_flat(pressures, robot.peak_pressure).tolist()
        here = [self._slice(i) for i in range(len(robot.limbs))]
        state = _State([forces[own] for own in here], [heights[own] for own in here], may)
        found: list[Contact] = []
        passed: dict[tuple[int, str], float] = {}  # what flat limbs pass on to ends of carriers
        reached: set[tuple[int, str]] = set()  # ends of carriers where a limb is flat, or nearly
        for i in range(len(robot.limbs) - 1, -1, -1):  # those that are carried come first
            own = self._of_limb(state, i, passed, reached)
            found += own
        return found

    def _of_limb(
        self,
        state: "_State",
        i: int,
        passed: dict[tuple[int, str], float],
        reached: set[tuple[int, str]],
    ) -> list[Contact]:
        """Contacts of one limb; notes what it leaves to its carrier."""
        limb, force, at = self._tree.robot.limbs[i], state.force[i], self._at[i]
        length, near, carrier = limb.strip.length, self._near[i], self._carrier[i]
        found: list[Contact] = []
        low, high = -1.0, length + 1.0  # what no end's contact explains
        at_tip = False
        for end in ("begin", "end"):
            free = end in self._free[i]
            if not free and (i, end) not in passed:
                continue
            contact, left = self._at_end(state, i, end, passed.get((i, end), 0.0))
            if contact is None:
                continue
            if found and contact.length > length - found[0].length:
                continue  # it lies flat as a whole, once
            found.append(contact)
            at_tip |= free
            if end == "begin":
                low = contact.length + near
            else:
                high = length - contact.length - near
                if carrier >= 0:
                    key = (carrier, limb.at)
                    if contact.length >= length - near:
                        reached.add(key)
                    if contact.length >= length * (1 - _WHOLE):
                        passed[key] = passed.get(key, 0.0) + left
        # a joint belongs to the limb that is flat there, and else to the carrier
        if (i, "begin") in reached or carrier >= 0:
            low = max(low, near)
        if (i, "end") in reached:
            high = min(high, length - near)
        if at_tip and carrier >= 0:
            return found
        load = moment = 0.0
        for push, place in zip(force, at, strict=True):
            if push > self._least and low < place < high:
                load += push
                moment += push * place
        if load:  # a belly that touches, no end: a side of hardly any length, where it pushes
            found.append(Contact(i, _HARDLY * length, (moment / load,), load))
        return found

    def weights(self, contacts: list[Contact]) -> Array:
        """Weights of the nodes in the points of all contacts that resist, (C, P)."""
        limbs = [contact.limb for contact in contacts for _ in contact.at]
        return self._tree.points(limbs, [at for contact in contacts for at in contact.at])

    def resistances(self, contacts: list[Contact], ground: Ground, x: Array) -> tuple[Array, Array]:
        """Bounds [N] and viscous resistances [N s/m] of all these points, at places x (C,) [m]."""
        points = [contact for contact in contacts for _ in contact.at]
        pairs = [
            self.resistance(contact, ground.at(place))
            for contact, place in zip(points, x.tolist(), strict=True)
        ]
        bounds, viscous = np.array(pairs).reshape(-1, 2).T
        return bounds, viscous

    def resistance(self, contact: Contact, surface: Surface) -> tuple[float, float]:
        """Bound of friction [N] and viscous resistance [N s/m] of each point of a contact."""
        strip, points = self._tree.robot.limbs[contact.limb].strip, len(contact.at)
        width = strip.width
        if 0 < contact.length <= _HARDLY * strip.length and not self._law.needs_load:
            # no area: what rounding leaves would be the only bound there is
            return 0.0, 0.0
        bound = self._law.bound(surface, width, contact.length, contact.load)
        if not contact.length and not self._law.needs_load:
            bound *= self._share[contact.limb]
        return float(bound) / points, float(surface.drag(width, contact.length)) / points

    def _slice(self, limb: int) -> slice:
        return slice(limb * self._per_limb, (limb + 1) * self._per_limb)

    def _beyond(self, state: "_State", limb: int) -> tuple[float, bool]:
        """Of the carrier where a limb begins: the push there, and whether it is flat on from there.

        The two share a joint, and which of them the ground pushes there is open.
        """
        carrier = self._carrier[limb]
        if carrier < 0:
            return 0.0, False
        force, height = state.force[carrier], state.height[carrier]
        at_end = self._tree.robot.limbs[limb].at == "end"
        push, near = (force[-1], height[-3:]) if at_end else (force[0], height[:3])
        return self._share[limb] * push, max(near) <= self._up[carrier]

    def _at_end(
        self, state: "_State", i: int, end: str, passed: float
    ) -> tuple[Contact | None, float]:
        """The contact that begins at an end of a limb, and what it does not carry itself [N].

        Args:
            state: of all limbs.
            i, end: the limb and which end.
            passed: force that limbs which begin there do not carry [N].
        """
        strip, at, up = self._tree.robot.limbs[i].strip, self._at[i], self._up[i]
        force, height, length = state.force[i], state.height[i], strip.length
        count = len(at)
        total, moment, run = passed, 0.0, 0
        for k in range(count) if end == "begin" else range(count - 1, -1, -1):
            if height[k] > up:
                break
            total += force[k]
            moment += force[k] * (at[k] if end == "begin" else length - at[k])
            run += 1
        if total <= self._least:
            return None, 0.0
        tip = at[0 if end == "begin" else -1]
        if not state.may[i]:
            if end not in self._free[i]:
                return None, 0.0
            # bent by pressure it stands on its tip alone; only a trunk may have two
            return Contact(i, 0.0, (tip,), sum(force) if self._carrier[i] >= 0 else total), 0.0
        whole = False
        if run == count and end == "end":
            joint, whole = self._beyond(state, i)
            if not whole:
                total, moment = total + joint, moment + joint * length
        weight = strip.weight_per_length
        side = length if whole else min(float(flat_length(weight, total, moment)), length)
        if side <= 0:
            return Contact(i, 0.0, (tip,), total), 0.0
        points = tuple(side * p if end == "begin" else length - side * p for p in _POINTS)
        return Contact(i, side, points, total), total - weight * side


class _State(NamedTuple):
    """Forces and heights of each limb's vertices, and whether it may lie flat."""

    force: list[list[float]]
    height: list[list[float]]
    may: list[bool]


def _free_ends(robot: TreeRobot, limb: int) -> tuple[str, ...]:
    """Ends of a limb that nothing is fast to."""
    own = robot.limbs[limb]
    taken = {other.at for other in robot.limbs if other.on == own.name}
    ends = ("begin", "end") if own.on is None else ("end",)
    return tuple(end for end in ends if end not in taken)


def ripple(strip: Robot, elements: int) -> float:
    """Height to which a limb that lies flat ripples between its nodes [m]."""
    # wider links are four thirds of an element
    return 4 * strip_ripple(strip, np.array([0.0, strip.length / elements]))


def check_ground(ground: Ground) -> None:
    """Raise ValueError for ground that limbs are not told of: sticky, or stronger at rest."""
    for surface in surfaces_of(ground):
        if surface.adhesion or surface.static_ratio > 1:
            what = "adhesion" if surface.adhesion else "static_ratio"
            raise ValueError(
                f"{what} of surface {surface.name!r} is for strips, not for robots of limbs; got "
                f"{getattr(surface, what)!r}"
            )


def durations(ground: Ground, times: Array | None, states: int) -> Array:
    """Durations of the increments between states, (B - 1,) [s]; of 1 s each without times.

    Raises:
        ValueError: the ground is viscous and no times are given, or see check_ground.
    """
    check_ground(ground)
    if times is None and any(surface.viscosity for surface in surfaces_of(ground)):
        raise ValueError(f"times of the shapes must be given on viscous ground {ground.name!r}")
    return np.maximum(np.diff(np.arange(float(states)) if times is None else times), _INSTANT)
