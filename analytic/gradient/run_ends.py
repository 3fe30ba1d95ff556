"""States in which a slide ends: solved for together with the condition that ends it.

A walk gives each to 1e-7 of the length. From there the state and its tangent along the ramp tell
what happens first: a side lifts or lands, an end's pressure no longer lets it lie flat, the other
end's bound is less, the separation turns, smoothly or as a node lands, or the ramp ends.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import flat_nodes, flat_pressures, ripple
from analytic.friction.laws import friction_number
from analytic.gradient.bordered import solve_bordered
from analytic.gradient.conditions import possible
from analytic.gradient.equilibrium import Balance, Condition, Contacts
from analytic.gradient.solved import UnclearError, solved

Array = NDArray[np.float64]

_EVENTS, _TURNS = 8, 12  # at most; chosen
_SAME = 1e-7  # of a ramp, within which two conditions are met at once; chosen
_ABOUT = 0.02  # of a ramp, by which a turn may be off the place where a walk has it; chosen
_BEFORE = 1e-5  # of a ramp, by which the condition may have been met already; chosen
_JUST = 1e-9  # of a ramp; chosen
_BOUND = 1e-4  # of the greatest bound, by which the tension may be off the slider's; chosen
_ALIKE = 1e-9  # likewise, by which two bounds may differ and be alike; chosen
_EDGE_FORCE, _EDGE_HEIGHT = 1e-4, 1e-6  # of a node's weight, over L, at the edge of a tip; chosen


class RunEnd(NamedTuple):
    """State in which a slide ends.

    Attributes:
        u: unknowns, see Balance.
        contacts: until there.
        ramp: number of the ramp in the cycle.
        place: condition that ends it; None at a corner of the path and where the separation turns.
        also: conditions that are met there too, each with its rate along the ramp.
        separation: Lambda [m].
        cause: in words.
    """

    u: Array
    contacts: Contacts
    ramp: int
    place: Condition | None
    also: tuple[tuple[Condition, float], ...]
    separation: float
    cause: str


def frozen(
    balance: Balance, u: Array, active: NDArray[np.bool_], slider: str, grows: bool
) -> Contacts:
    """Contacts of a state that slides or is about to stop.

    Raises:
        UnclearError: the tension is not one with which an end slides.
    """
    robot, friction = balance.inputs.robot, balance.inputs.friction
    y, theta = balance.split(u)[:2]
    force = balance.forces(u) * active
    air = y * robot.length > ripple(robot, balance.nodes)
    pressure = np.abs(balance.pressure(float(u[-1]) - _JUST))  # until there
    lies = pressure <= flat_pressures(robot, balance.inputs.surface)
    sides = tuple(
        flat_nodes(force[::order], air[::order], bool(lies[::order][0])) for order in (1, -1)
    )
    contacts = Contacts(active, sides, slider, grows, "none")  # type: ignore[arg-type]
    sides = tuple(
        count if count is None or balance.side(u, contacts, end) > 0 else 0
        for end, count in enumerate(sides)
    )
    contacts = contacts._replace(sides=sides)  # type: ignore[arg-type]
    if not friction.tension:
        return contacts
    scale = friction_number(balance.inputs.surface, robot, balance.rigidity)
    left, right = (float(balance.bound(u, contacts, end)) for end in (0, 1))
    slides = abs(float(balance.sliding(u, contacts)) - float(u[-2])) <= _BOUND * scale
    straight = np.abs(np.sin(theta)).max() < 1e-9  # a tension does nothing there
    alike = abs(left - right) <= _ALIKE * scale and slider != "both"  # which of them would slide?
    if straight or (slides and not alike):
        return contacts._replace(tension="slides")
    least = [_EDGE_FORCE * balance.chain.weight[1] if active[node] else _EDGE_HEIGHT
             for node in (1, -2)]  # fmt: skip
    edges = [end for end in (0, 1) if abs(float(balance.at_edge(u, end, active))) < least[end]]
    if len(edges) == 1:
        return contacts._replace(tension="edge", edge=edges[0])
    if slides:
        return contacts._replace(tension="slides")
    raise UnclearError("the friction of a slide's last state is not that of one of its ends")


class Search:
    """Search for what ends a slide, from its last state in a walk on.

    Args:
        balance: of the ramp it is on.
        turns: whether a slide ends where the separation turns.
    """

    def __init__(self, balance: Balance, turns: bool) -> None:
        self._balance, self._turns = balance, turns

    def corner(self, u: Array, contacts: Contacts, ramp: int) -> RunEnd:
        """The state at the end of the ramp, or at its beginning."""
        u = solved(self._balance, u, contacts, None)
        return self._end(u, contacts, ramp, None, "a stage")

    def next(self, u: Array, contacts: Contacts, ramp: int, until: float) -> RunEnd:
        """The first end of the slide from a state on.

        Args:
            u, contacts: of the state.
            ramp: number of the ramp.
            until: place on the ramp where the slide has ended.

        Raises:
            UnclearError: nothing that is known ends it there.
        """
        u = solved(self._balance, u, contacts, None)
        begin = float(u[-1])
        for _ in range(_EVENTS):
            tangent = self._tangent(u, contacts)
            rows = [(self._distance(u, contacts, c, tangent), c, ends)
                    for c, ends in possible(self._balance, u, contacts)]  # fmt: skip
            rows = [row for row in rows if row[0] > begin - float(u[-1]) - _BEFORE]
            first = min(rows, key=lambda row: row[0], default=None)
            turn = self._turn(u, contacts, tangent) if self._turns else np.inf
            if first is None or turn < first[0]:
                return self._turned(u, contacts, ramp, turn, until)
            distance, condition, ends = first
            if float(u[-1]) + distance > until + _BEFORE:
                break
            u = solved(self._balance, u + distance * tangent, contacts, condition)
            if ends:
                return self._end(u, contacts, ramp, condition, condition.what)
            after = self._passed(contacts, condition)
            if self._turns and self._rate(u, contacts) * self._rate(u, after) < 0:
                return self._end(u, contacts, ramp, condition, "a turn as a node lands or lifts")
            contacts = after
        raise UnclearError("what ends a slide is not found")

    def _end(
        self, u: Array, contacts: Contacts, ramp: int, place: Condition | None, cause: str
    ) -> RunEnd:
        also = []
        tangent = self._tangent(u, contacts)
        for condition, ends in possible(self._balance, u, contacts):
            rate = float(self._balance.slope(u, contacts, condition) @ tangent)
            value = float(self._balance.condition(u, contacts, condition))
            if ends and condition != place and abs(value) <= _SAME * abs(rate):
                also.append((condition, rate))
        separation = float(self._balance.separation(u))
        return RunEnd(u, contacts, ramp, place, tuple(also), separation, cause)

    def _tangent(self, u: Array, contacts: Contacts) -> Array:
        """Change of the unknowns per ramp."""
        right = np.eye(len(u))[-1]  # nothing but the place changes
        return solve_bordered(np.vstack([self._balance.jacobian(u, contacts), right]), right)

    def _rate(self, u: Array, contacts: Contacts) -> float:
        """Change of the separation over L per ramp."""
        slope = self._balance.slope(u, contacts, None)
        return float(slope @ self._tangent(u, contacts))

    def _distance(
        self, u: Array, contacts: Contacts, condition: Condition, tangent: Array
    ) -> float:
        """Part of the ramp to where a condition is met; infinite if it never is."""
        value = float(self._balance.condition(u, contacts, condition))
        rate = float(self._balance.slope(u, contacts, condition) @ tangent)
        leaves = condition.kind in ("force", "height") and rate > 0
        return -value / rate if rate and not leaves else np.inf

    @staticmethod
    def _passed(contacts: Contacts, condition: Condition) -> Contacts:
        """Contacts after a node that ends no slide has landed or lifted off."""
        active = contacts.active.copy()
        active[condition.place] = not active[condition.place]
        return contacts._replace(active=active)

    def _turn(self, u: Array, contacts: Contacts, tangent: Array) -> float:
        """Part of the ramp to where the separation seems to turn; infinite if it does not."""
        step = -1e-4 if u[-1] > 0.5 else 1e-4
        there = solved(self._balance, u + step * tangent, contacts, None)
        rate = float(self._balance.slope(u, contacts, None) @ tangent)
        change = (self._rate(there, contacts) - rate) / step
        distance = -rate / change if change else np.inf
        return distance if distance > -_BEFORE - abs(step) else np.inf

    def _turned(
        self, u: Array, contacts: Contacts, ramp: int, distance: float, until: float
    ) -> RunEnd:
        """The state in which the separation turns."""
        for _ in range(_TURNS):
            if not -_ABOUT <= float(u[-1]) + distance <= until + _ABOUT:
                break
            tangent = self._tangent(u, contacts)
            u = solved(self._balance, u + distance * tangent, contacts, None)
            if abs(distance) < 1e-9:
                return self._end(u, contacts, ramp, None, "a turn")
            distance = self._turn(u, contacts, self._tangent(u, contacts))
        raise UnclearError("where the separation turns is not found")
