"""Contacts of a tree of limbs with the ground, found from the ground's forces.

As for the strip of [Majidi13], section 2.2: a limb whose free end is inflated touches by its tip;
one without pressure lies on its side over a length that follows from the ground's forces
(analytic.friction.contact_length); one that curls up stands on its underside. Between its ends an
underside, of a torso that carries others or of any limb, lies flat over the length that its weight
and forces tell. A limb that lies flat as a whole passes on to its carrier what its side does not
carry. Each vertex that pushes loads one contact alone: a tip carries what pushes its end, and where
else the limb rests the rest.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import flat_length, flat_up_to, length_between
from analytic.friction.contacts import POINT, runs_without_gaps
from analytic.friction.laws import LAWS
from analytic.scene.limbs import Limb, LimbedRobot, chambers_by_limb
from analytic.solvers.limbs.contact_state import ContactState, LimbAtRest, free_ends, ripple
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
            LimbAtRest(
                limb.strip,
                tree.arclength[vertices].tolist(),
                None if limb.on is None else robot.place(limb.on),
                limb.at,
                limb.strip.width / widths[limb.on, limb.at],
                free_ends(robot, limb),
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
        parts = chambers_by_limb(self._tree.robot)
        may_lie, curls = (
            [{"begin": which[part.start], "end": which[part.stop - 1]} for part in parts]
            for which in ((np.abs(pressures) <= self._flat_up_to).tolist(),
                          (pressures < -self._flat_up_to).tolist())
        )  # fmt: skip
        state = ContactState(
            [forces[vertices] for vertices in self._tree.vertices],
            [heights[vertices] for vertices in self._tree.vertices],
            may_lie,
            curls,
            {},
            set(),
        )
        inwards = range(len(may_lie) - 1, -1, -1)  # limbs that are carried come first
        return [contact for i in inwards for contact in self._of_limb(state, i)]

    def _of_limb(self, state: ContactState, i: int) -> list[Contact]:
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
            # a joint belongs to the limb that is flat or curls up there, and else to the carrier
            away = carrier is not None and not self._stands_at_joint(state, i)
            if (i, "begin") in state.reached or away:
                low = max(low, near)
            if (i, "end") in state.reached:
                high = min(high, length - near)
            inner = [
                vertex for vertex, (place, push) in enumerate(
                    zip(limb.arclength, force, strict=True))
                if push > self._least and low < place < high
            ]  # fmt: skip
        if sum(force[vertex] for vertex in inner) > self._least:
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
        load, length = sum(force[vertex] for vertex in inner), limb.strip.length
        if len(run) > POINT:
            places = [place[vertex] for vertex in run]
            push = [force[vertex] for vertex in run]
            flat = min(length_between(limb.weight, places, push), length)
            if flat > SHORT * length:
                begin = min(max(0.5 * (places[0] + places[-1] - flat), 0.0), length - flat)
                return self._contact(i, part, begin, flat, load)
        at = sum(place[vertex] * force[vertex] for vertex in inner) / load
        if len(limb.strip.segments) > 1 or any(state.curls[i].values()):
            return self._contact(i, part, at, 0.0, load)
        return Contact(i, part, SHORT * length, (at,), (0.0,), load)

    def _flat_at_joint(self, state: ContactState, i: int) -> bool:
        """Tell whether the limb that carries another lies flat where that begins."""
        carrier, at = self._limbs[i].carrier, self._limbs[i].at
        if carrier is None or state.curls[carrier][at]:
            return False
        ahead = 1 if at == "begin" else -1
        return max(state.height[carrier][::ahead][:3]) <= self._limbs[carrier].ripple

    def _stands_at_joint(self, state: ContactState, i: int) -> bool:
        """Tell whether a limb may stand where it begins, as it curls up there.

        It takes its part of what pushes its carrier there, unless that lies flat.
        """
        limb = self._limbs[i]
        if limb.carrier is None or not state.curls[i]["begin"]:
            return False
        if not self._flat_at_joint(state, i):
            end = 0 if limb.at == "begin" else -1
            state.force[i][0] += limb.share * state.force[limb.carrier][end]
            state.reached.add((limb.carrier, limb.at))
        return True

    def _at_end(self, state: ContactState, i: int, end: str) -> tuple[Contact | None, float, int]:
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
        if state.curls[i][end]:
            if force[::order][0] <= self._least:
                return None, 0.0, 0  # the end is in the air, however little
        elif not state.may_lie[i][end]:
            # bent by pressure it stands on its tip alone; what else it rests on is an underside
            if end not in limb.free or not carried:
                return None, 0.0, 0
            if self._all_on_tips and limb.carrier is not None and len(strip.segments) == 1:
                return self._contact(i, end, tip, 0.0, sum(force)), 0.0, len(force)
            return self._contact(i, end, tip, 0.0, force[::order][0]), 0.0, 1
        if whole and limb.carrier is not None:
            # limb and carrier share a joint, and which of them the ground pushes there is open
            whole = self._flat_at_joint(state, i)
            if not whole:
                joint = limb.share * state.force[limb.carrier][0 if limb.at == "begin" else -1]
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


def parts_of(limb: Limb, robot: LimbedRobot) -> tuple[str, ...]:
    """Parts of a limb that may be contacts, see Contact.part."""
    if limb.on is None or limb.name not in robot.outer:
        return "begin", "end", "between"
    return "end", "between"
