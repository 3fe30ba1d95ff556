"""Contacts of a tree of limbs with the ground, found from the ground's forces.

As for the strip of [Majidi13], section 2.2: a limb whose free end is inflated touches by its tip;
one without pressure lies on its side over a length that follows from the ground's forces
(analytic.friction.contact_length); one that curls up stands on its underside. Between its ends an
underside, of a torso that carries others or of any limb, lies flat over the length that its weight
and forces tell. A limb that lies flat as a whole passes on to its carrier what its side does not
carry. Each vertex that pushes loads one contact alone: a tip carries what pushes its end, and where
else the limb rests the rest.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import flat_pressures
from analytic.friction.contacts import POINT, runs_without_gaps
from analytic.friction.laws import LAWS
from analytic.scene.limbs import Limb, LimbedRobot, chambers_by_limb, check_tethers
from analytic.solvers.limbs.contact_points import EVEN, of_area, of_load
from analytic.solvers.limbs.contact_state import TETHER, Contact, ContactState
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.rest import Rest
from analytic.solvers.limbs.resting_limb import resting_limbs

Array = NDArray[np.float64]

_WHOLE = 1e-9  # of a length: all of it
SHORT = 1e-9  # of a length
END = {"begin": 0, "end": -1}
_FLAT = 1e-3  # rad; a gap between vertices that push is air if steeper, as of a strip; chosen
_TOUCHES = 1e-6  # of the weight: a node that pushes less hovers
# of the step that a twist makes in the edges' difference of height: how high the lower one may be
_BY_TWIST = 0.25  # where a limb lies on it; a sixth, as every other link twists, and room; chosen


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
        vertices = len(self._limbs[0].arclength)
        self._steps = np.zeros((len(self._limbs), vertices + 1))  # none beyond the ends
        self._least = _TOUCHES * robot.weight
        parts = chambers_by_limb(robot)
        self._flat = flat_pressures(robot, tree.surface)
        self._end_chambers = np.array([[part.start, part.stop - 1] for part in parts])
        self._tethers = _tethers(robot)

    def find(self, rest: Rest, pressures: Array) -> list[Contact]:
        """The contacts of a state at pressures of its chambers, (S,) [Pa]."""
        half = len(rest.force) // 2
        # both edges together; a limb that leans lies on one of its edges
        forces = (rest.force[:half] + rest.force[half:]).tolist()
        heights = self.heights(rest.nodes[:half, 2], rest.nodes[half:, 2]).tolist()
        return self.search(forces, heights, self.bends(pressures).tolist())

    def bends(self, pressures: Array) -> NDArray[np.int_]:
        """Bend of limbs at their begin and end, by pressures, (..., L, 2): see ContactState.

        Args:
            pressures: of the chambers, (..., S) [Pa].
        """
        ways = np.where(np.abs(pressures) <= self._flat, 0, np.sign(pressures)).astype(int)
        return np.asarray(ways[..., self._end_chambers])

    def search(
        self, force: list[float], height: list[float], bends: list[list[int]]
    ) -> list[Contact]:
        """The contacts of a state.

        Args:
            force: of the ground on the vertices of all limbs [N].
            height: of the vertices [m].
            bends: see `bends`.
        """
        vertices = self._tree.vertices
        state = ContactState(
            [force[limb] for limb in vertices], [height[limb] for limb in vertices], bends,
            {}, set(),
        )  # fmt: skip
        contacts: list[Contact] = []
        for i in range(len(vertices) - 1, -1, -1):  # limbs that are carried come first
            if state.passed or max(state.force[i]) > 0.0:
                contacts += self._of_limb(state, i)
        return contacts + self._tethers

    def heights(self, right: Array, left: Array) -> Array:
        """Heights of vertices, (P,), by those of their edges, less what their links lift [m].

        A twisted limb lies on a straight edge; of plane links every other corner is in the air.
        """
        heights = np.minimum(right, left)
        if not self._tree.twists:
            return heights
        across, steps = (left - right).reshape(len(self._limbs), -1), self._steps
        np.abs(across[:, 1:] - across[:, :-1], out=steps[:, 1:-1])
        lifted: Array = _BY_TWIST * np.maximum(steps[:, 1:], steps[:, :-1])
        return heights - lifted.ravel()

    def _of_limb(self, state: ContactState, i: int) -> list[Contact]:
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
            # a joint belongs to the limb that is flat or curls up there, and else to the carrier
            away = carrier is not None and not self._stands_at_joint(state, i)
            if away or (i, "begin") in state.reached:
                low = max(low, near)
            if (i, "end") in state.reached:
                high = min(high, length - near)
            least, place = self._least, limb.arclength
            inner = [
                vertex for vertex, push in enumerate(force)
                if push > least and low < place[vertex] < high
            ]  # fmt: skip
        if inner and sum([force[vertex] for vertex in inner]) > self._least:
            contacts += self._undersides(state, i, inner, [contact.part for contact in contacts])
        return contacts

    def _undersides(
        self, state: ContactState, i: int, inner: list[int], taken: list[str]
    ) -> list[Contact]:
        """Contacts of an underside: one, and one more for each free end that is in the air."""
        limb, place = self._limbs[i], self._limbs[i].arclength
        runs = runs_without_gaps(
            inner, state.height[i], lambda before, node: _FLAT * (place[node] - place[before])
        )
        contacts = []
        for end, outermost in (("begin", 0), ("end", -1)):
            if len(runs) > 1 and end in limb.free and end not in taken:
                run = runs.pop(outermost)
                contacts.append(self._underside(state, i, end, run, run))
        run = max(runs, key=len)
        at_joint = limb.carrier is not None and place[run[-1]] <= limb.near
        if len(run) <= POINT and at_joint and self._flat_at_joint(state, i):
            return contacts  # the carrier's side
        inner = [vertex for part in runs for vertex in part]
        return [*contacts, self._underside(state, i, "between", run, inner)]

    def _underside(
        self, state: ContactState, i: int, part: str, run: list[int], inner: list[int]
    ) -> Contact:
        """A contact of an underside away from the ends, where vertices push.

        Where it lies flat either half carries its weight and a push, as of a strip, see
        analytic.friction.contacts. One of several segments, or that curls up, stands on a tip where
        it touches at a point, as a strip does; another on a side of no area.

        Args:
            state: what pushes.
            i: place of the limb.
            part: see Contact.
            run: vertices that push with no air between them.
            inner: all that it carries.
        """
        limb, force, place = self._limbs[i], state.force[i], self._limbs[i].arclength
        load, length = sum([force[vertex] for vertex in inner]), limb.length
        if len(run) > POINT:
            places = [place[vertex] for vertex in run]
            flat = min(limb.load.length_between(places, [force[on] for on in run]), length)
            if flat > SHORT * length:
                begin = min(max(0.5 * (places[0] + places[-1] - flat), 0.0), length - flat)
                pushes = [place[vertex] for vertex in inner], [force[vertex] for vertex in inner]
                return self._contact(i, part, begin, flat, load, pushes)
        at = sum([place[vertex] * force[vertex] for vertex in inner]) / load
        if limb.segments > 1 or min(state.bends[i]) < 0:
            return self._contact(i, part, at, 0.0, load)
        return Contact(i, part, SHORT * length, (at,), (0.0,), load)

    def _flat_at_joint(self, state: ContactState, i: int) -> bool:
        """Tell whether the limb that carries another lies flat where that begins."""
        carrier, at = self._limbs[i].carrier, self._limbs[i].at
        if carrier is None or state.bends[carrier][END[at]] < 0:
            return False
        ahead = 1 if at == "begin" else -1
        return max(state.height[carrier][::ahead][:3]) <= self._limbs[carrier].ripple

    def _stands_at_joint(self, state: ContactState, i: int) -> bool:
        """Tell whether a limb may stand where it begins, as it curls up there.

        It takes its part of what pushes its carrier there, unless that lies flat.
        """
        limb = self._limbs[i]
        if limb.carrier is None or state.bends[i][0] >= 0:
            return False
        if not self._flat_at_joint(state, i):
            state.force[i][0] += limb.share * state.force[limb.carrier][END[limb.at]]
            state.reached.add((limb.carrier, limb.at))
        return True

    def _at_end(self, state: ContactState, i: int, end: str) -> tuple[Contact | None, float, int]:
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
        length, tip = limb.length, 0.0 if at_begin else limb.length
        bends = state.bends[i][END[end]]
        if bends < 0:
            if force[0] <= self._least:
                return None, 0.0, 0  # the end is in the air, however little
        elif bends:
            # bent by pressure it stands on its tip alone; what else it rests on is an underside
            if end not in limb.free or not carried:
                return None, 0.0, 0
            if self._all_on_tips and limb.carrier is not None and limb.segments == 1:
                return self._contact(i, end, tip, 0.0, sum(force)), 0.0, len(force)
            return self._contact(i, end, tip, 0.0, force[0]), 0.0, 1
        carrier = limb.carrier
        whole = carrier is not None and carried == len(force) and not at_begin
        if whole and carrier is not None:
            # limb and carrier share a joint, and which of them the ground pushes there is open
            whole = self._flat_at_joint(state, i)
            if not whole:
                joint = limb.share * state.force[carrier][END[limb.at]]
                total, moment = total + joint, moment + joint * length
        load_from = limb.load.from_begin if at_begin else limb.load.from_end
        side = length if whole else min(load_from.length(total, moment), length)
        if side <= 0:
            return self._contact(i, end, tip, 0.0, load), 0.0, carried
        begin = tip if at_begin else tip - side
        places = limb.arclength if at_begin else limb.arclength[::-1]
        contact = self._contact(i, end, begin, side, load, (places[:carried], force[:carried]))
        return contact, total - load_from.of(side), carried

    def _contact(
        self, i: int, part: str, begin: float, length: float, load: float,
        pushes: tuple[Sequence[float], Sequence[float]] = ((), ()),
    ) -> Contact:  # fmt: skip
        """A side that begins somewhere along a limb, or a tip there: all across the limb.

        By load a side resists where the vertices that load it push, at places [m] by forces [N].
        """
        aside = self._limbs[i].aside
        if not length:
            return Contact(i, part, length, (begin,) * len(aside), aside, load)
        along, share = of_area(begin, length), EVEN
        if self._law.needs_load:
            along, parts = of_load(*pushes, self._limbs[i].length)
            share = tuple([part / len(aside) for part in parts for _ in aside])
        at = tuple([place for place in along for _ in aside])
        return Contact(i, part, length, at, aside + aside, load, begin, share)


def parts_of(limb: Limb, robot: LimbedRobot) -> tuple[str, ...]:
    """Parts of a limb that may be contacts, see Contact.part."""
    tied = (TETHER,) if limb.strip.tether and limb.strip.tether.drag else ()
    if limb.on is None or limb.name not in robot.outer:
        return "begin", "end", "between", *tied
    return "end", "between", *tied


def _tethers(robot: LimbedRobot) -> list[Contact]:
    """Contacts that tethers of limbs are, in whatever state."""
    check_tethers(robot)
    tied = [(i, limb.strip) for i, limb in enumerate(robot.limbs) if limb.strip.tether]
    return [
        Contact(i, TETHER, 0.0, (strip.tether.at * strip.length,), (0.0,), strip.tether.drag)
        for i, strip in tied if strip.tether and strip.tether.drag
    ]  # fmt: skip
