"""Contacts of a tree of limbs with the ground, found from the ground's forces.

As for the strip of [Majidi13], section 2.2: a limb whose free end is inflated touches by its tip;
one without pressure lies on its side over a length that follows from the ground's forces
(analytic.friction.contact_length). Between its ends an underside, of a torso that carries others or
of any limb, lies flat over the length that its weight and forces tell. A limb that lies flat as a
whole passes on to its carrier what its side does not carry. Each vertex that pushes loads one
contact alone: a tip carries what pushes its end, and where else the limb rests the rest.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import flat_length, flat_up_to, length_between
from analytic.friction.contact_length import ripple as strip_ripple
from analytic.friction.contacts import POINT, runs_without_gaps
from analytic.friction.laws import LAWS
from analytic.scene.limbs import Limb, LimbedRobot, chambers_by_limb
from analytic.scene.robot import Robot
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.rest import Rest

Array = NDArray[np.float64]

_ALONG = (0.5 - 12**-0.5, 0.5 + 12**-0.5)  # of a side: Gauss's points, over its length; and over
_ASIDE = (-0.25, 0.25)  # its width, or that of a tip: they resist turning as a line across does
_NEAR, _WHOLE = 2, 1e-9  # elements from an end that count as there; of a length: all of it
SHORT = 1e-9  # of a length
_FLAT = 1e-3  # rad; a gap between vertices that push is air if steeper, as of a strip; chosen
_TOUCHES = 1e-6  # of the weight: a node that pushes less hovers


class Contact(NamedTuple):
    """Contact of one limb with the ground.

    Attributes:
        limb: its place.
        part: of the limb, "begin", "end" or "between" them.
        length: of side contact, 0 for a tip [m].
        at, aside: arclengths of the points that it resists at, and how far to the left of the
            middle line each is [m].
        load: normal force on the whole [N].
    """

    limb: int
    part: str
    length: float
    at: tuple[float, ...]
    aside: tuple[float, ...]
    load: float

    @property
    def middle(self) -> float:
        """Arclength of its middle [m]."""
        return sum(self.at) / len(self.at)


class ContactSearch:
    """Search for the contacts of a tree; in plain floats, since numpy is slow on a few numbers.

    Args:
        tree: its links.
        law: of friction, a name of analytic.friction.laws.LAWS.
        all_on_tips: whether a limb under pressure loads its tip by all that pushes it, even where
            it rests on its underside too.
    """

    def __init__(self, tree: Tree, law: str = "constant", all_on_tips: bool = False) -> None:
        self._tree, self._law, self._all_on_tips = tree, LAWS[law], all_on_tips
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
                tree.incline.normal * limb.strip.weight_per_length + press,
            )
            for limb, vertices, press in zip(
                robot.limbs, tree.vertices, tree.press.tolist(), strict=True
            )
        ]
        self._least = _TOUCHES * robot.weight
        self._flat_up_to = np.array([
            flat_up_to(limb.strip, robot.peak_pressure, tree.surface)
            for limb in robot.limbs for _ in limb.strip.segments
        ])  # fmt: skip

    def find(self, rest: Rest, pressures: Array) -> list[Contact]:
        """The contacts of a state at pressures of its chambers, (S,) [Pa]."""
        half = len(rest.force) // 2
        # both edges together; a limb that leans lies on one of its edges
        forces = (rest.force[:half] + rest.force[half:]).tolist()
        heights = np.minimum(rest.nodes[:half, 2], rest.nodes[half:, 2]).tolist()
        flat = (np.abs(pressures) <= self._flat_up_to).tolist()
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
        limb, force, contacts = self._limbs[i], state.force[i], list[Contact]()
        length, near, carrier = limb.strip.length, limb.near, limb.carrier
        low, high = -1.0, length + 1.0  # where no end's contact explains the forces
        at_tip = False
        rest = list(range(len(force)))  # vertices whose forces no contact carries
        for end in ("begin", "end"):
            if end not in limb.free and (i, end) not in state.passed:
                continue
            contact, surplus, carried = self._at_end(state, i, end)
            if contact is None or (contacts and contact.length > length - contacts[0].length):
                continue  # a limb that lies flat as a whole does so once
            contacts.append(contact)
            at_tip |= end in limb.free
            if end == "begin":
                rest = rest[carried:]
                low = contact.length + near
                continue
            rest = rest[: max(len(rest) - carried, 0)]
            high = length - contact.length - near
            if carrier is not None:
                joint = carrier, limb.at
                if contact.length >= length - near:
                    state.reached.add(joint)
                if contact.length >= length * (1 - _WHOLE):
                    state.passed[joint] = state.passed.get(joint, 0.0) + surplus
        if self._law.needs_load:
            inner = [vertex for vertex in rest if force[vertex] > 0]
        elif at_tip and carrier is not None and len(limb.strip.segments) == 1:
            return contacts
        else:
            # a joint belongs to the limb that is flat there, and else to the carrier
            if (i, "begin") in state.reached or carrier is not None:
                low = max(low, near)
            if (i, "end") in state.reached:
                high = min(high, length - near)
            inner = [
                vertex for vertex, (place, push) in enumerate(
                    zip(limb.arclength, force, strict=True))
                if push > self._least and low < place < high
            ]  # fmt: skip
        if sum(force[vertex] for vertex in inner) > self._least:
            contacts.append(self._underside(state, i, inner))
        return contacts

    def _underside(self, state: "_State", i: int, inner: list[int]) -> Contact:
        """The contact of an underside between the ends, where vertices push.

        Where it lies flat either half carries its weight and a push, as of a strip, see
        analytic.friction.contacts. One of several segments that touches at a point stands on a tip
        there, as a strip does; one of a single segment on a side of no area.
        """
        limb, force = self._limbs[i], state.force[i]
        load, length = sum(force[vertex] for vertex in inner), limb.strip.length
        place = limb.arclength
        runs = runs_without_gaps(
            inner, state.height[i], lambda before, node: _FLAT * (place[node] - place[before])
        )
        run = max(runs, key=len)
        if len(run) > POINT:
            places = [place[vertex] for vertex in run]
            push = [force[vertex] for vertex in run]
            flat = min(length_between(limb.weight, places, push), length)
            if flat > SHORT * length:
                begin = min(max(0.5 * (places[0] + places[-1] - flat), 0.0), length - flat)
                return self._contact(i, "between", begin, flat, load)
        at = sum(place[vertex] * force[vertex] for vertex in inner) / load
        if len(limb.strip.segments) > 1:
            return self._contact(i, "between", at, 0.0, load)
        return Contact(i, "between", SHORT * length, (at,), (0.0,), load)

    def _at_end(self, state: "_State", i: int, end: str) -> tuple[Contact | None, float, int]:
        """The contact that begins at an end of a limb.

        Returns:
            The contact; the force that it passes on [N]; and how many vertices it carries.
        """
        limb, force = self._limbs[i], state.force[i]
        strip, order = limb.strip, 1 if end == "begin" else -1
        tip = limb.arclength[::order][0]
        load, moment, whole, carried = 0.0, 0.0, end == "end", 0
        for push, height, place in zip(
            force[::order], state.height[i][::order], limb.arclength[::order], strict=True
        ):
            if height > limb.ripple:
                whole = False
                break
            load += push
            moment += push * abs(place - tip)
            carried += 1
        total = load + state.passed.get((i, end), 0.0)
        if total <= self._least:
            return None, 0.0, 0
        if not state.may_lie[i][end]:
            # bent by pressure it stands on its tip alone; what else it rests on is an underside
            if end not in limb.free or not carried:
                return None, 0.0, 0
            if self._all_on_tips and limb.carrier is not None and len(strip.segments) == 1:
                return self._contact(i, end, tip, 0.0, sum(force)), 0.0, len(force)
            return self._contact(i, end, tip, 0.0, force[::order][0]), 0.0, 1
        if whole and limb.carrier is not None:
            # limb and carrier share a joint, and which of them the ground pushes there is open
            carrier, ahead = limb.carrier, 1 if limb.at == "begin" else -1
            joint = limb.share * state.force[carrier][::ahead][0]
            whole = max(state.height[carrier][::ahead][:3]) <= self._limbs[carrier].ripple
            if not whole:
                total, moment = total + joint, moment + joint * strip.length
        else:
            whole = False
        weight, length = limb.weight, strip.length
        side = length if whole else min(float(flat_length(weight, total, moment)), length)
        if side <= 0:
            return self._contact(i, end, tip, 0.0, load), 0.0, carried
        begin = tip if end == "begin" else tip - side
        return self._contact(i, end, begin, side, load), total - weight * side, carried

    def _contact(self, i: int, part: str, begin: float, length: float, load: float) -> Contact:
        """A side that begins somewhere along a limb, or a tip there: all across the limb."""
        width = self._limbs[i].strip.width
        along = [begin + length * share for share in _ALONG] if length else [begin]
        points = [(at, width * aside) for at in along for aside in _ASIDE]
        at, aside = zip(*points, strict=True)
        return Contact(i, part, length, at, aside, load)


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
        weight: that presses a flat stretch to the ground, with adhesion [N/m].
    """

    strip: Robot
    arclength: list[float]
    carrier: int | None
    at: str
    share: float
    free: tuple[str, ...]
    near: float
    ripple: float
    weight: float


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


def parts_of(limb: Limb, robot: LimbedRobot) -> tuple[str, ...]:
    """Parts of a limb that may be contacts, see Contact.part."""
    if limb.on is None or limb.name not in robot.outer:
        return "begin", "end", "between"
    return "end", "between"


def _free_ends(robot: LimbedRobot, limb: Limb) -> tuple[str, ...]:
    """Ends of a limb that no other limb is attached to."""
    taken = {carried.at for carried in robot.limbs if carried.on == limb.name}
    ends = ("begin", "end") if limb.on is None else ("end",)
    return tuple(end for end in ends if end not in taken)


def ripple(strip: Robot, elements: int) -> float:
    """Height to which a limb that lies flat ripples between its nodes [m]."""
    # wider links are four thirds of an element
    return 4 * strip_ripple(strip, np.array([0.0, strip.length / elements]))
