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

from analytic.friction.contact_length import flat_length, length_between, may_lie_flat
from analytic.friction.contact_length import ripple as strip_ripple
from analytic.friction.contacts import POINT
from analytic.friction.laws import LAWS
from analytic.scene.ground import check_for_limbs, durations, surfaces_of
from analytic.scene.limbs import Limb, LimbedRobot, chambers_by_limb
from analytic.scene.robot import Robot
from analytic.scene.surface import Ground, Surface
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.rest import Rest

Array = NDArray[np.float64]

_POINTS = (0.5 - 12**-0.5, 0.5 + 12**-0.5)  # of a side: two that resist turning as all of it does
_NEAR, _WHOLE = 2, 1e-9  # elements from an end that count as there; of a length: all of it
_SHORT = 1e-9  # of a length
_TOUCHES = 1e-6  # of the weight: a node that pushes less hovers


class Contact(NamedTuple):
    """Contact of one limb with the ground.

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
        widths: dict[tuple[str | None, str], float] = {}  # of all limbs that begin at one place
        for limb in robot.limbs:
            widths[limb.on, limb.at] = widths.get((limb.on, limb.at), 0.0) + limb.strip.width
        self._limbs = [
            _Limb(
                limb.strip,
                tree.arclength[vertices].tolist(),
                None if limb.on is None else robot.place(limb.on),
                limb.at,
                limb.strip.width / widths[limb.on, limb.at],
                _free_ends(robot, limb),
                _NEAR * limb.strip.length / tree.elements,
                ripple(limb.strip, tree.elements),
            )
            for limb, vertices in zip(robot.limbs, tree.vertices, strict=True)
        ]
        self._least = _TOUCHES * robot.weight
        self._normal = tree.incline.normal

    def find(self, rest: Rest, pressures: Array) -> list[Contact]:
        """The contacts of a state at pressures of its chambers, (S,) [Pa]."""
        half = len(rest.force) // 2
        # both edges together; a limb that leans lies on one of its edges
        forces = (rest.force[:half] + rest.force[half:]).tolist()
        heights = np.minimum(rest.nodes[:half, 2], rest.nodes[half:, 2]).tolist()
        flat = may_lie_flat(pressures, self._tree.robot.peak_pressure).tolist()
        parts = chambers_by_limb(self._tree.robot)
        may_lie = [{"begin": flat[part.start], "end": flat[part.stop - 1]} for part in parts]
        state = _State(
            [forces[vertices] for vertices in self._tree.vertices],
            [heights[vertices] for vertices in self._tree.vertices],
            may_lie,
            {},
            set(),
        )
        inwards = range(len(may_lie) - 1, -1, -1)  # limbs that are carried come first
        return [contact for i in inwards for contact in self._of_limb(state, i)]

    def _of_limb(self, state: "_State", i: int) -> list[Contact]:
        """Contacts of one limb; notes the force that it leaves to its carrier."""
        limb = self._limbs[i]
        length, near, carrier = limb.strip.length, limb.near, limb.carrier
        contacts: list[Contact] = []
        low, high = -1.0, length + 1.0  # where no end's contact explains the forces
        at_tip = False
        for end in ("begin", "end"):
            if end not in limb.free and (i, end) not in state.passed:
                continue
            contact, surplus = self._at_end(state, i, end)
            if contact is None or (contacts and contact.length > length - contacts[0].length):
                continue  # a limb that lies flat as a whole does so once
            contacts.append(contact)
            at_tip |= end in limb.free
            if end == "begin":
                low = contact.length + near
                continue
            high = length - contact.length - near
            if carrier is not None:
                joint = carrier, limb.at
                if contact.length >= length - near:
                    state.reached.add(joint)
                if contact.length >= length * (1 - _WHOLE):
                    state.passed[joint] = state.passed.get(joint, 0.0) + surplus
        several = len(limb.strip.segments) > 1
        if at_tip and carrier is not None and not several:
            return contacts
        # a joint belongs to the limb that is flat there, and else to the carrier
        if (i, "begin") in state.reached or carrier is not None:
            low = max(low, near)
        if (i, "end") in state.reached:
            high = min(high, length - near)
        inner = [
            (place, push) for push, place in zip(state.force[i], limb.arclength, strict=True)
            if push > self._least and low < place < high
        ]  # fmt: skip
        if inner:
            contacts.append(self._underside(i, inner))
        return contacts

    def _underside(self, i: int, inner: list[tuple[float, float]]) -> Contact:
        """The contact of an underside between the ends, from places [m] and pushes [N].

        Of one segment it has nearly no length, since pressure or weight alone bends all of it; of
        several it lies flat as that of a strip, see analytic.friction.contacts.
        """
        strip, load = self._limbs[i].strip, sum(push for _, push in inner)
        at, length = sum(place * push for place, push in inner) / load, _SHORT * strip.length
        if len(strip.segments) > 1:
            places, push = zip(*inner, strict=True)
            flat = len(inner) > POINT
            weight = self._normal * strip.weight_per_length
            length = length_between(weight, places, push) if flat else 0.0
        return Contact(i, length, (at,), load)

    def _at_end(self, state: "_State", i: int, end: str) -> tuple[Contact | None, float]:
        """The contact that begins at an end of a limb, and the force that it passes on [N]."""
        limb, force = self._limbs[i], state.force[i]
        strip, order = limb.strip, 1 if end == "begin" else -1
        tip = limb.arclength[::order][0]
        total, moment, whole = state.passed.get((i, end), 0.0), 0.0, end == "end"
        for push, height, place in zip(
            force[::order], state.height[i][::order], limb.arclength[::order], strict=True
        ):
            if height > limb.ripple:
                whole = False
                break
            total += push
            moment += push * abs(place - tip)
        if total <= self._least:
            return None, 0.0
        if not state.may_lie[i][end]:
            if end not in limb.free:
                return None, 0.0
            # bent by pressure it stands on its tip alone; only a trunk may have two
            alone = limb.carrier is not None and len(strip.segments) == 1
            return Contact(i, 0.0, (tip,), sum(force) if alone else total), 0.0
        if whole and limb.carrier is not None:
            # limb and carrier share a joint, and which of them the ground pushes there is open
            carrier, ahead = limb.carrier, 1 if limb.at == "begin" else -1
            joint = limb.share * state.force[carrier][::ahead][0]
            whole = max(state.height[carrier][::ahead][:3]) <= self._limbs[carrier].ripple
            if not whole:
                total, moment = total + joint, moment + joint * strip.length
        else:
            whole = False
        weight, length = self._normal * strip.weight_per_length, strip.length
        side = length if whole else min(float(flat_length(weight, total, moment)), length)
        if side <= 0:
            return Contact(i, 0.0, (tip,), total), 0.0
        points = tuple(abs(tip - side * part) for part in _POINTS)
        return Contact(i, side, points, total), total - weight * side

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

    def strength(self, ground: Ground) -> float:
        """Greatest bound of all limbs together, each on its side or on its tip [N]."""
        robot = self._tree.robot
        loads = [limb.strip.weight_per_length * limb.strip.length for limb in robot.limbs]
        return max(
            sum(
                max(
                    self.resistance(Contact(i, length, (0.0,), load), surface)[0]
                    for length in (0.0, limb.strip.length)
                )
                for i, (limb, load) in enumerate(zip(robot.limbs, loads, strict=True))
            )
            for surface in surfaces_of(ground)
        )

    def resistance(self, contact: Contact, surface: Surface) -> tuple[float, float]:
        """Bound of friction [N] and viscous resistance [N s/m] of each point of a contact."""
        strip, points = self._tree.robot.limbs[contact.limb].strip, len(contact.at)
        width = strip.width
        if 0 < contact.length <= _SHORT * strip.length and not self._law.needs_load:
            # no area: what rounding leaves would be the only bound there is
            return 0.0, 0.0
        bound = self._law.bound(surface, width, contact.length, contact.load)
        if not contact.length and not self._law.needs_load:
            bound *= self._limbs[contact.limb].share
        return float(bound) / points, float(surface.drag(width, contact.length)) / points


class _Limb(NamedTuple):
    """A limb as the search for its contacts needs it.

    Attributes:
        strip: its geometry and weight.
        arclength: of its vertices [m].
        carrier, at: place of the limb that carries it, None for the trunk, and its end there.
        share: part of the width of all limbs that begin at the same place.
        free: ends that no limb begins at and that no limb carries.
        near: distance from an end that counts as there [m].
        ripple: height below which a vertex is on the ground [m].
    """

    strip: Robot
    arclength: list[float]
    carrier: int | None
    at: str
    share: float
    free: tuple[str, ...]
    near: float
    ripple: float


class _State(NamedTuple):
    """Forces [N] and heights [m] of each limb's vertices, and whether its ends may lie flat.

    Noted during the search: forces that limbs which lie flat pass on to ends of carriers, and ends
    of carriers where a limb is flat, or nearly.
    """

    force: list[list[float]]
    height: list[list[float]]
    may_lie: list[dict[str, bool]]
    passed: dict[tuple[int, str], float]
    reached: set[tuple[int, str]]


def _free_ends(robot: LimbedRobot, limb: Limb) -> tuple[str, ...]:
    """Ends of a limb that no other limb is attached to."""
    taken = {carried.at for carried in robot.limbs if carried.on == limb.name}
    ends = ("begin", "end") if limb.on is None else ("end",)
    return tuple(end for end in ends if end not in taken)


def ripple(strip: Robot, elements: int) -> float:
    """Height to which a limb that lies flat ripples between its nodes [m]."""
    # wider links are four thirds of an element
    return 4 * strip_ripple(strip, np.array([0.0, strip.length / elements]))


def spans_of(ground: Ground, times: Array | None, states: int) -> Array:
    """Durations of the increments between states, (B - 1,) [s]; of 1 s each without times.

    Raises:
        ValueError: the ground is viscous and no times are given, or sticky, or stronger at rest.
    """
    check_for_limbs(ground)
    if times is None and any(surface.viscosity for surface in surfaces_of(ground)):
        raise ValueError(f"times of the shapes must be given on viscous ground {ground.name!r}")
    return durations(np.arange(float(states)) if times is None else times)
