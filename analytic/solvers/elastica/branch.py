"""The branch of stable equilibria along a path of pressures, and where contacts change on it.

States are a path: each starts from the last, in smaller steps of pressure where a step fails, and
every one is tested for stability. So the branch that begins with the strip lying flat is followed
as far as it is stable, and no other is ever returned. Friction that bends the strip is right in an
increment where the same contacts slide all along; where others do at its end, the change is
located (analytic.solvers.elastica.events) to where the strip moves by next to nothing.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.progress import counted
from analytic.scene.ground import durations
from analytic.shapes import Flag
from analytic.solvers.elastica.continuation import follow
from analytic.solvers.elastica.events import Event
from analytic.solvers.elastica.newton import Chain
from analytic.solvers.elastica.points import (
    NO_MEASURES,
    Point,
    changed,
    guess,
    slides_alike,
    turned,
)
from analytic.solvers.elastica.signature import UNSETTLED
from analytic.solvers.elastica.state import ChainState
from analytic.solvers.elastica.stick_slip import StickSlip

Array = NDArray[np.float64]

_LEAST_STEP = 1e-4  # of the way between two states, below which the branch is taken to end
_LEAST_PULLED = 1e-2  # where friction or adhesion may give way, and damped motion follows
_CURLED = 0.02  # slope that an end in flat contact does not have, even where it lifts off [rad]
_LOCATED = 1e-7  # motion over L within which a change of contacts is located; chosen
_PROBE = 1e-3  # of an increment, to tell whether a contact slides on; chosen
_NEAR = 1e-5  # motion over L that is no jump; chosen
_FAR = 0.01  # motion over L in an increment whose end is not known; chosen
_MOST_CHANGES = 8  # in an increment, beyond which they are a flicker and not looked for; chosen
NO_NUMBERS = Flag.BRANCH_END | Flag.ROLLED_UP
_JUMP = 0.03  # change of a direction at one pressure that is flagged as a jump [rad]; chosen
_LEAP = 0.3  # change of a direction in one step that may be a leap to another branch [rad]

_FIRST_DRAG, _LEAST_DRAG, _MOST_DRAG = 10.0, 1e-3, 1e6  # over the hinges' stiffness; chosen
_FLOW_STEPS = 200


class Branch:
    """The stable branch of equilibria that begins with the strip flat and without pressure.

    Args:
        chain: of the strip.
        traction: friction that bends it, if any does.
        may_curl: follow states with an end off the ground too, as far as they are wanted.
        pressures: the path, (B, S) [Pa].
        times: of its rows, (B,) [s]; None where time does not matter.
    """

    def __init__(
        self,
        chain: Chain,
        traction: StickSlip | None,
        may_curl: bool,
        pressures: Array,
        times: ArrayLike | None,
    ) -> None:
        self._chain, self._traction, self._may_curl = chain, traction, may_curl
        # row -1 is the strip without pressure, long ago
        self._path = np.concatenate([np.zeros((1, pressures.shape[1])), pressures])
        self._duration = np.full(len(pressures), np.inf)
        if times is not None:
            self._duration[1:] = durations(times)
        blank = np.full(chain.links + 2, np.nan)
        self.missing = chain.flat()._replace(
            y=blank, theta=blank[1:], shear=blank[1:], left=math.nan
        )

    def points(self) -> list[Point]:
        """States at the rows of the path, and two more on either side of changes of contacts."""
        points = [Point(-1.0, self._path[0], self._at_rest())]
        for row in counted(range(len(self._path) - 1)):
            changes = 0
            while points[-1].row < row:
                changes += 1
                search = changes <= _MOST_CHANGES and points[-1].contacts is not None
                after = self._after(points, float(row), trial=search)
                if search and changed(points[-1], after):
                    self._add_change(points, after, float(row))
                elif search and turned(points, after):
                    self._add_turn(points, after)
                else:
                    points.append(self._after(points, float(row)) if after.unsettled else after)
        return [self._checked(point) for point in points[1:]]

    def _checked(self, point: Point) -> Point:
        """A point with its residual, which is of no use on the way to it."""
        if point.status & NO_NUMBERS:
            return point
        self._chain.load_at(point.pressure)
        return point._replace(residual=self._chain.residual(point.state))

    def _add_change(self, points: list[Point], after: Point, row: float) -> None:
        """Add states on either side of the first change of contacts before a point.

        Which contact slides is told wrongly on the way from one to the other alone. One that comes
        to a stop before is added in its place.
        """
        states, solved = [*points], after
        event = Event(points[-2:] if slides_alike(points) else points[-1:], after)
        error = self._moved(points[-1].state, after.state)
        least = _LOCATED / (error if 0 < error < math.inf else _FAR) * event.width
        while (
            event.width > least
            and not self._moved(event.before.state, event.after.state) < _LOCATED
        ):
            middle = self._after(states, event.next(least), event.after, trial=True)
            behind_it = changed(states[-1], middle)
            if not behind_it and turned(states, middle):
                return self._add_turn(points, middle)
            event.narrow(middle, behind_it)
            if not behind_it:
                states = [*points, middle]
            elif math.isfinite(middle.state.left):
                solved = middle
        after = event.after
        behind = self._after(states, after.row, after)
        if Flag.BRANCH_END in behind.status and solved is not after:
            # a little farther on, where bounds are not all but alike, there is one
            beyond = self._after(states, solved.row, solved)
            if self._moved(states[-1].state, beyond.state) < _NEAR:
                behind = beyond
        points += self._over_jump(points, [*states[len(points) :], behind], row)
        return None

    def _add_turn(self, points: list[Point], after: Point) -> None:
        """Add the state in which a contact comes to a stop within a ramp, and those after it.

        It may be before the last point already, which is then solved for anew: the contact slid
        farther than in that point and came back to where it still pulls the same way. A state is
        before the turn if the contact slides on from it.
        """
        again = points.pop() if slides_alike(points) else None
        begin, end = points[-1], after
        probe = _PROBE * (after.row - begin.row)
        while self._moved(begin.state, end.state) > _LOCATED and end.row - begin.row > 2 * probe:
            middle = self._after(points, 0.5 * (begin.row + end.row), after)
            onward = self._after([*points, middle], middle.row + probe, after)
            if turned([*points, middle], onward) or turned(points, middle):
                end = middle
            else:
                begin = middle
        if begin is not points[-1]:
            points.append(begin)
        for row in sorted({again.row if again else after.row, after.row}):
            if row > points[-1].row:
                points.append(self._after(points, row))

    def _over_jump(self, points: list[Point], located: list[Point], row: float) -> list[Point]:
        """States on either side of a change, or the next row's if none is found right behind it.

        Where a contact lets go at once, the strip may come to rest only at pressures farther on.
        """
        if Flag.BRANCH_END not in located[-1].status:
            return located
        beyond = self._after(points, row)
        if Flag.BRANCH_END in beyond.status:
            return located
        return [beyond._replace(status=beyond.status | Flag.JUMPED)]

    def _at_rest(self) -> ChainState:
        """The strip without pressure: flat, or lifted by feet that stand proud."""
        chain, state = self._chain, self._chain.flat()
        floor = chain.floor
        if not floor.any():
            return state
        chain.load_at(self._path[0])

        def solve(_: float, end: float, near: ChainState) -> ChainState | None:
            chain.floor = end * floor
            return chain.equilibrium(near)

        part, state = follow(state, solve, first=0.01, least=_LEAST_STEP)
        chain.floor = floor
        if part < 1.0:
            raise ValueError("drop of a foot must be such that the strip stands on it at rest")
        return state

    def _after(
        self, points: list[Point], row: float, beyond: Point | None = None, trial: bool = False
    ) -> Point:
        """The state that follows on those before it at a row.

        Args:
            points: all so far.
            row: place along the path.
            beyond: a state at that row or after it, to guess by.
            trial: whether it is enough to know that contacts change, see StickSlip.begin.
        """
        before = points[-1]
        place = math.ceil(row)
        part = row - (place - 1)
        pressure = self._path[place] + part * (self._path[place + 1] - self._path[place])
        if Flag.BRANCH_END in before.status:
            return before._replace(row=row, pressure=pressure, iterations=0)
        chain, duration = self._chain, (row - before.row) * float(self._duration[place])
        steps, status = chain.iterations, Flag.OK
        chain.load_at(pressure)
        near = guess(points, pressure, row, beyond)
        early = trial and before.contacts is not None and "between" not in before.contacts.kinds
        state = self._near(before.state, duration, near, early)
        if state is None and trial:
            return Point(row, pressure, self.missing, contacts=UNSETTLED)
        state = state or self._in_smaller_steps(before, pressure, duration)
        if state is None and (self._traction or chain.reach):
            chain.load_at(pressure)
            state = self._damped(before.state)
            if state and _apart(state, before.state) > _JUMP:
                status = Flag.JUMPED
        steps = chain.iterations - steps
        if state is None:
            return Point(row, pressure, self.missing, Flag.BRANCH_END, steps)
        if _rolled_up(state, chain.floor) and not self._may_curl:
            return Point(row, pressure, state, Flag.ROLLED_UP, steps)
        traction = self._traction
        contacts = traction.signature() if traction else None
        unsettled = traction is not None and not traction.settled
        measures = NO_MEASURES if traction is None or unsettled else traction.measures(state)
        return Point(row, pressure, state, status, steps, contacts, unsettled, measures)

    def _moved(self, before: ChainState, after: ChainState) -> float:
        """Greatest motion of a node along x, over L."""
        links = self._chain.length * (np.cos(after.theta) - np.cos(before.theta))
        return abs(after.left - before.left) + float(np.abs(np.cumsum(links)).max())

    def _near(
        self,
        state: ChainState,
        duration: float = math.inf,
        first: ChainState | None = None,
        trial: bool = False,
    ) -> ChainState | None:
        """The equilibrium that follows a state; None far away, where another branch may be."""
        if self._traction:
            self._traction.begin(state, duration, trial)
        candidate = self._chain.equilibrium(first or state, self._traction)
        return None if candidate is None or _apart(candidate, state) > _LEAP else candidate

    def _in_smaller_steps(
        self, before: Point, pressure: Array, duration: float
    ) -> ChainState | None:
        """The next state by continuation; None if the branch ends on the way."""

        def solve(begin: float, end: float, near: ChainState) -> ChainState | None:
            self._chain.load_at(before.pressure + end * (pressure - before.pressure))
            return self._near(near, (end - begin) * duration)

        least = _LEAST_PULLED if self._traction or self._chain.reach else _LEAST_STEP
        part, state = follow(before.state, solve, first=0.25, least=least)
        return state if part >= 1.0 else None

    def _damped(self, state: ChainState) -> ChainState | None:
        """The state that hinges lead to that resist turning, ever less; None if they reach none."""
        drag = _FIRST_DRAG
        for _ in range(_FLOW_STEPS):
            self._chain.damp(drag, state)
            candidate = self._near(state)
            self._chain.damp(0.0)
            if candidate is None:
                drag *= 4.0
                if drag >= _MOST_DRAG:
                    return None
                continue
            if _apart(candidate, state) < _LEAP / 3:
                drag *= 0.5
            state = candidate
            if drag < _LEAST_DRAG:
                return self._near(state)
        return None


def _rolled_up(state: ChainState, floor: Array) -> bool:
    """Tell whether an end is off the ground and not for lying nearly flat."""
    gap = state.y - floor
    ends = ((gap[0], state.theta[0]), (gap[-1], state.theta[-1]))
    return any(y > 1e-9 and abs(theta) > _CURLED for y, theta in ends)


def _apart(state: ChainState, reference: ChainState) -> float:
    """Greatest difference of a direction [rad]."""
    return float(np.abs(state.theta - reference.theta).max())
