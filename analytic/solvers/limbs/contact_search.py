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

from analytic.friction.contact_length import (
    bending_peaks,
    flat_length,
    length_between,
    may_lie_flat,
)
from analytic.friction.contacts import POINT, runs_without_gaps
from analytic.friction.laws import LAWS
from analytic.scene.limbs import Limb, LimbedRobot, chambers_by_limb
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.rest import Rest
from analytic.solvers.limbs.resting_limb import resting_limbs

Array = NDArray[np.float64]

_ALONG = (0.5 - 12**-0.5, 0.5 + 12**-0.5)  # of a side: Gauss's points, over its length
_WHOLE = 1e-9  # of a length: all of it
SHORT = 1e-9  # of a length
_FLAT = 1e-3  # rad; a gap between vertices that push is air if steeper, as of a strip; chosen
_TOUCHES = 1e-6  # of the weight: a node that pushes less hovers
# of the step that a twist makes in the edges' difference of height: how high the lower one may be
_BY_TWIST = 0.25  # where a limb lies on it; a sixth, as every other link twists, and room; chosen


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
        return 0.5 * (self.at[0] + self.at[-1])


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
        robot, self._limbs = tree.robot, resting_limbs(tree)
        self._least = _TOUCHES * robot.weight
        parts = chambers_by_limb(robot)
        self._peaks = bending_peaks(robot)
        self._end_chambers = np.array([[part.start, part.stop - 1] for part in parts])

    def find(self, rest: Rest, pressures: Array) -> list[Contact]:
        """The contacts of a state at pressures of its chambers, (S,) [Pa]."""
        half = len(rest.force) // 2
        # both edges together; a limb that leans lies on one of its edges
        forces = (rest.force[:half] + rest.force[half:]).tolist()
        heights = self.heights(rest.nodes[:half, 2], rest.nodes[half:, 2]).tolist()
        return self.search(forces, heights, self.may_lie(pressures).tolist())

    def may_lie(self, pressures: Array) -> NDArray[np.bool_]:
        """Tell whether each limb may lie flat at its begin and its end, by pressures, (..., L, 2).

        Args:
            pressures: of the chambers, (..., S) [Pa].
        """
        flat: NDArray[np.bool_] = may_lie_flat(pressures, self._peaks)[..., self._end_chambers]
        return flat

    def search(
        self, force: list[float], height: list[float], may_lie: list[list[bool]]
    ) -> list[Contact]:
        """The contacts of a state.

        Args:
            force: of the ground on the vertices of all limbs [N].
            height: of the vertices [m].
            may_lie: whether each limb may lie flat at its two ends.
        """
        vertices = self._tree.vertices
        state = _State(
            [force[limb] for limb in vertices], [height[limb] for limb in vertices], may_lie,
            {}, set(),
        )  # fmt: skip
        contacts: list[Contact] = []
        for i in range(len(vertices) - 1, -1, -1):  # limbs that are carried come first
            if state.passed or max(state.force[i]) > 0.0:
                contacts += self._of_limb(state, i)
        return contacts

    def heights(self, right: Array, left: Array) -> Array:
        """Heights of vertices, (P,), by those of their edges, less what their links lift [m].

        A twisted limb lies on a straight edge; of plane links every other corner is in the air.
        """
        heights = np.minimum(right, left)
        if not self._tree.twists:
            return heights
        across = (left - right).reshape(len(self._limbs), -1)
        steps = np.zeros((len(across), across.shape[1] + 1))
        steps[:, 1:-1] = np.abs(np.diff(across))
        lifted: Array = _BY_TWIST * np.maximum(steps[:, 1:], steps[:, :-1])
        return heights - lifted.ravel()

    def _of_limb(self, state: "_State", i: int) -> list[Contact]:
        """Contacts of one limb; notes the force that it leaves to its carrier."""
        limb, force, passed = self._limbs[i], state.force[i], state.passed
        contacts: list[Contact] = []
        length, near, carrier = limb.length, limb.near, limb.carrier
        low, high = -1.0, length + 1.0  # where no end's contact explains the forces
        first, stop, at_tip = 0, len(force), False  # vertices whose forces no contact carries
        for end in limb.free if not passed else ("begin", "end"):
            if end not in limb.free and (i, end) not in passed:
                continue
            contact, surplus, carried = self._at_end(state, i, end)
            if contact is None or (contacts and contact.length > length - contacts[0].length):
                continue  # a limb that lies flat as a whole does so once
            contacts.append(contact)
            at_tip |= end in limb.free
            if end == "begin":
                first, low = carried, contact.length + near
                continue
            stop -= carried
            high = length - contact.length - near
            if carrier is not None and contact.length >= length - near:
                joint = carrier, limb.at
                state.reached.add(joint)
                if contact.length >= length * (1 - _WHOLE):
                    passed[joint] = passed.get(joint, 0.0) + surplus
        if self._law.needs_load:
            inner = [vertex for vertex in range(first, stop) if force[vertex] > 0]
        elif at_tip and carrier is not None and limb.segments == 1:
            return contacts
        else:
            # a joint belongs to the limb that is flat there, and else to the carrier
            if carrier is not None or (i, "begin") in state.reached:
                low = max(low, near)
            if (i, "end") in state.reached:
                high = min(high, length - near)
            least, place = self._least, limb.arclength
            inner = [
                vertex for vertex, push in enumerate(force)
                if push > least and low < place[vertex] < high
            ]  # fmt: skip
        if inner and sum([force[vertex] for vertex in inner]) > self._least:
            contacts.append(self._underside(state, i, inner))
        return contacts

    def _underside(self, state: "_State", i: int, inner: list[int]) -> Contact:
        """The contact of an underside between the ends, where vertices push.

        Where it lies flat either half carries its weight and a push, as of a strip, see
        analytic.friction.contacts. One of several segments that touches at a point stands on a tip
        there, as a strip does; one of a single segment on a side of no area.
        """
        limb, force, length = self._limbs[i], state.force[i], self._limbs[i].length
        load, place = sum([force[vertex] for vertex in inner]), limb.arclength
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
        at = sum([place[vertex] * force[vertex] for vertex in inner]) / load
        if limb.segments > 1:
            return self._contact(i, "between", at, 0.0, load)
        return Contact(i, "between", SHORT * length, (at,), (0.0,), load)

    def _at_end(self, state: "_State", i: int, end: str) -> tuple[Contact | None, float, int]:
        """The contact that begins at an end of a limb.

        Returns:
            The contact; the force that it passes on [N]; and how many vertices it carries.
        """
        limb, at_begin = self._limbs[i], end == "begin"
        force, height, distance = state.force[i], state.height[i], limb.arclength
        if not at_begin:
            force, height, distance = force[::-1], height[::-1], limb.from_end
        load, moment, carried, ripple = 0.0, 0.0, 0, limb.ripple
        for push, lifted, arm in zip(force, height, distance, strict=True):
            if lifted > ripple:
                break
            load += push
            moment += push * arm
            carried += 1
        total = load + state.passed.get((i, end), 0.0) if state.passed else load
        if total <= self._least:
            return None, 0.0, 0
        length = limb.length
        tip = 0.0 if at_begin else length
        if not state.may_lie[i][0 if at_begin else 1]:
            # bent by pressure it stands on its tip alone; what else it rests on is an underside
            if end not in limb.free or not carried:
                return None, 0.0, 0
            if self._all_on_tips and limb.carrier is not None and limb.segments == 1:
                return self._contact(i, end, tip, 0.0, sum(force)), 0.0, len(force)
            return self._contact(i, end, tip, 0.0, force[0]), 0.0, 1
        whole, carrier = carried == len(force) and not at_begin, limb.carrier
        if carrier is None:
            whole = False
        elif whole:
            # limb and carrier share a joint, and which of them the ground pushes there is open
            ahead = 1 if limb.at == "begin" else -1
            joint = limb.share * state.force[carrier][::ahead][0]
            whole = max(state.height[carrier][::ahead][:3]) <= self._limbs[carrier].ripple
            if not whole:
                total, moment = total + joint, moment + joint * length
        weight = limb.weight
        side = length if whole else min(float(flat_length(weight, total, moment)), length)
        if side <= 0:
            return self._contact(i, end, tip, 0.0, load), 0.0, carried
        begin = tip if at_begin else tip - side
        return self._contact(i, end, begin, side, load), total - weight * side, carried

    def _contact(self, i: int, part: str, begin: float, length: float, load: float) -> Contact:
        """A side that begins somewhere along a limb, or a tip there: all across the limb."""
        aside = self._limbs[i].aside
        across = len(aside)
        if not length:
            return Contact(i, part, length, (begin,) * across, aside, load)
        near, far = _ALONG
        at = (begin + length * near,) * across + (begin + length * far,) * across
        return Contact(i, part, length, at, aside + aside, load)


class _State(NamedTuple):
    """Forces [N] and heights [m] of each limb's vertices, and whether its ends may lie flat.

    Noted during the search: forces that limbs which lie flat pass on to ends of carriers, and ends
    of carriers where a limb is flat, or nearly.
    """

    force: list[list[float]]
    height: list[list[float]]
    may_lie: list[list[bool]]
    passed: dict[tuple[int, str], float]
    reached: set[tuple[int, str]]


def parts_of(limb: Limb, robot: LimbedRobot) -> tuple[str, ...]:
    """Parts of a limb that may be contacts, see Contact.part."""
    if limb.on is None or limb.name not in robot.outer:
        return "begin", "end", "between"
    return "end", "between"
