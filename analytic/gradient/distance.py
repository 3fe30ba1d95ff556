"""Distance per cycle as a sum over the ends of slides, and its derivatives.

Where a slide ends, or the other end begins to slide, the separation is Lambda_e and the slip
fraction of the left end changes from s_e to s_{e+1}. The displacement of the left end along a cycle
is the sum of (s_{e+1} - s_e) Lambda_e, all else telescopes, so that

    dD/dq = sum_e (s_{e+1} - s_e) dLambda_e/dq,

each by the implicit function theorem from balance and the condition that ends the slide, by one
transposed system per end for all fields. Residuals are differentiated by differences.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.gradient.bordered import solve_bordered
from analytic.gradient.equilibrium import Balance, Condition, Contacts
from analytic.gradient.inputs import Derivative, Inputs, Number
from analytic.gradient.run_ends import RunEnd, Search, frozen
from analytic.gradient.runs import SLIDERS, Run, runs_of
from analytic.gradient.solved import UnclearError, bordered
from analytic.shapes import ContactShapes, Flag

Array = NDArray[np.float64]

_TIES = "ties"
_BREAKS = 1e-7  # of a bound, by which two that are alike may part per change of a number; chosen
_AT_ONCE = 1e-6  # of a ramp, by which conditions may part per change of a number; chosen
_FLAT = 1e-9  # over L, height of a strip that lies flat; chosen
_NONE = Flag.BRANCH_END | Flag.ROLLED_UP | Flag.JUMPED | Flag.NOT_CONVERGED


class Term(NamedTuple):
    """End of a slide, and the weight of its separation in the distance."""

    end: RunEnd
    weight: float


def terms(
    inputs: Inputs,
    shapes: ContactShapes,
    left: Array,
    times: Array,
    cycles: int,
    chamber: str = "linearized",
) -> list[Term]:
    """Ends of slides in the last of some cycles.

    Args:
        inputs: the scene.
        shapes, left, times: of its walk, see analytic.prediction.Prediction.
        cycles: of it.
        chamber: law of the chambers.

    Raises:
        UnclearError: there are none, with the reason.
    """
    if shapes.status[-1] & int(_NONE) or (shapes.status & int(_NONE)).any():
        raise UnclearError("the strip jumps on the way, or its branch of equilibria ends")
    runs = runs_of(
        shapes.separation, left, times, times[-1] / cycles * (cycles - 1), inputs.robot.length
    )
    if not runs:
        return []
    walk = _Walk(inputs, shapes, times, chamber)
    counted = [run for run in runs if run.counts]
    before = [run for run in runs if not run.counts]
    slide_ends = []
    if counted:
        begin = walk.end(before[-1], counted[0]) if before else walk.begin(counted[0])
        slide_ends.append(Term(begin, counted[0].slip))
    for run, after in zip(counted, [*counted[1:], None], strict=True):
        weight = (after.slip if after else 0.0) - run.slip
        if weight:
            slide_ends.append(Term(walk.end(run, after), weight))
        if run.slip == 0.5:
            slide_ends += [Term(state, 0.0) for state in walk.tied_sides(run)]
    return slide_ends


def distance(slide_ends: Sequence[Term]) -> float:
    """Displacement per cycle from the ends of slides [m]."""
    return sum(term.weight * term.end.separation for term in slide_ends)


class _Walk:
    """States of a walk, from which the ends of its slides are found."""

    def __init__(self, inputs: Inputs, shapes: ContactShapes, times: Array, chamber: str) -> None:
        self._inputs, self._shapes, self._times = inputs, shapes, times
        self._chamber, self._links = chamber, len(shapes.nodes) - 2
        self._stages = np.concatenate([[0.0], np.cumsum(inputs.gait.ramp_times)])
        self._turns = bool(inputs.friction.tension) or not inputs.surface.is_round

    def begin(self, run: Run) -> RunEnd:
        """The first state of a walk, where its first slide begins."""
        return self._at(0, 0, 0.0, run, None)

    def end(self, run: Run, after: Run | None) -> RunEnd:
        """The state in which a slide ends, before another one."""
        row = run.end
        if after is None and self.lies_flat(len(self._times) - 1):
            row = len(self._times) - 1
        elif after and after.counts > run.counts and self.lies_flat(after.begin):
            row = after.begin
        ramp, x = self._place(row, 0.5 * (self._times[row - 1] + self._times[row]))
        until = 1.0
        if row + 1 < len(self._times):
            later = row + 1 if self._inputs.friction.tension or not after else after.begin
            until = min(1.0, self._part(ramp, max(self._times[later], self._times[row]), row))
        if x >= 1.0 - 1e-9:
            return self._at(row, ramp, x, run, None)
        try:
            return self._at(row, ramp, x, run, until)
        except UnclearError:
            # the contacts may have changed in this state, which is as near behind as before it
            if row - 1 <= run.begin:
                raise
            return self._at(row - 1, ramp, self._part(ramp, self._times[row - 1], row), run, until)

    def tied_sides(self, run: Run) -> list[RunEnd]:
        """A state in which both ends slide as sides that resist alike, if there is any."""
        rows = np.arange(run.begin + 1, run.end)
        sides = self._shapes.contact_left[rows] * self._shapes.contact_right[rows] > 0
        rows = rows[sides & (self._shapes.amplitude[rows] > _FLAT * self._inputs.robot.length)]
        if not len(rows):
            return []
        row = int(rows[len(rows) // 2])
        ramp, x = self._place(row, 0.5 * (self._times[row - 1] + self._times[row]))
        return [self._at(row, ramp, x, run, None)]

    def lies_flat(self, row: int) -> bool:
        """Tell whether the strip lies flat as a whole."""
        return bool(self._shapes.amplitude[row] < _FLAT * self._inputs.robot.length)

    def _at(self, row: int, ramp: int, x: float, run: Run, until: float | None) -> RunEnd:
        balance = Balance(self._inputs, self._links, self._chamber, ramp)
        u, active = self._unknowns(balance, row, x)
        before = max(row - 1, 0), max(row, 1)
        grows = self._shapes.separation[before[1]] > self._shapes.separation[before[0]]
        contacts = frozen(balance, u, active, SLIDERS[run.slip], bool(grows))
        search = Search(balance, self._turns)
        if until is None:
            return search.corner(u, contacts, ramp)
        return search.next(u, contacts, ramp, until)

    def _place(self, row: int, middle: float) -> tuple[int, float]:
        """Ramp of the increment that ends at a row, and the place on it."""
        period = self._stages[-1]
        ramp = int(np.searchsorted(self._stages, middle % period, side="right")) - 1
        return ramp, self._part(ramp, self._times[row], row)

    def _part(self, ramp: int, time: float, row: int) -> float:
        """Place of a time on a ramp of the cycle that a row ends an increment of."""
        period = self._stages[-1]
        middle = 0.5 * (self._times[row - 1] + self._times[row])
        within = time - period * np.floor(middle / period)
        begin, end = self._stages[ramp : ramp + 2]
        return float((within - begin) / (end - begin))

    def _unknowns(self, balance: Balance, row: int, x: float) -> tuple[Array, NDArray[np.bool_]]:
        """Unknowns of a state of the walk, and its nodes on the ground."""
        shapes, chain = self._shapes, balance.chain
        places, heights = (part[row] / self._inputs.robot.length
                           for part in shapes.curve(shapes.nodes))  # fmt: skip
        theta = np.arctan2(np.diff(heights), np.diff(places))
        force = shapes.force[row] / chain.force_unit
        shear = np.cumsum(chain.weight - force)[:-1]
        u = np.concatenate([heights, theta, shear, [0.0, x]])
        if self._inputs.friction.tension:
            free = Contacts(force != 0, (0, 0), "left", True, "none")
            torque = balance.residual(u, free)[len(heights) : len(heights) + len(theta)]
            arms = chain.length * np.sin(theta)
            u[-2] = -float(torque @ arms) / max(float(arms @ arms), 1e-30)
        return u, force != 0


def derivatives(
    inputs: Inputs, slide_ends: Sequence[Term], names: Sequence[str], links: int, chamber: str
) -> dict[str, Derivative]:
    """Derivatives of the distance by fields.

    Args:
        inputs: the scene.
        slide_ends: of its walk.
        names: of the fields, as in robot.length.
        links, chamber: of the chain.

    Raises:
        ValueError: there is no such field, or it has no number.
    """
    ends = [_Adjoint(term, Balance(inputs, links, chamber, term.end.ramp)) for term in slide_ends]
    make = partial(Balance, links=links, chamber=chamber)
    result = {}
    for name in names:
        numbers = inputs.numbers(name)
        shape = tuple(1 + max(number.place[axis] for number in numbers)
                      for axis in range(len(numbers[0].place)))  # fmt: skip
        values, reasons = np.full(shape, np.nan), []
        for number in numbers:
            values[number.place], reason = _by(inputs, number, ends, make)
            if reason and reason not in reasons:
                reasons.append(reason)
        result[name] = Derivative(values, "; ".join(reasons))
    return result


def _by(
    inputs: Inputs, number: Number, ends: "Sequence[_Adjoint]", make: Callable[..., Balance]
) -> tuple[float, str]:
    """Derivative by one number, and why there is none or what holds of it."""
    if not number.step:
        return np.nan, f"{number.name} cannot be changed alone"
    moved = [end for end in ends if number.acts_on(end.ramp, inputs.gait.ramps)]

    def residuals(changed: Inputs) -> Array:
        balances = {ramp: make(changed, ramp=ramp) for ramp in {end.ramp for end in moved}}
        return np.concatenate([end.residual(balances[end.ramp]) for end in moved])

    total = 0.0
    if moved:
        explicit = number.derivative(residuals, inputs)
        sizes = np.cumsum([end.size for end in moved])[:-1]
        for end, part in zip(moved, np.split(explicit, sizes), strict=True):
            change, reason = end.by(part, abs(number.value) or 1.0)
            if reason:
                return np.nan, reason
            total += change
    if not number.way or (number.name == "gait.stages" and number.value):
        return total, ""
    where = "where a stage is 0, " if number.name == "gait.stages" else ""
    return total, f"{where}of {'greater' if number.way > 0 else 'smaller'} values alone"


class _Adjoint:
    """Contribution of the end of a slide to derivatives.

    Attributes:
        ramp: of the cycle, that it is on.
        size: of its residuals.
    """

    def __init__(self, term: Term, balance: Balance) -> None:
        self._term, end = term, term.end
        system, _ = bordered(balance, end.u, end.contacts, end.place)
        goals = [balance.slope(end.u, end.contacts, None) * balance.inputs.robot.length]
        self._conditions: list[tuple[Condition, float]] = list(end.also)
        if end.contacts.slider == "both":
            self._conditions.append((Condition("bounds", 0, _TIES), 0.0))
        goals += [balance.slope(end.u, end.contacts, what) for what, _ in self._conditions]
        self._adjoint = solve_bordered(system.T, np.array(goals).T).T
        self._bound = max(float(balance.bound(end.u, end.contacts, e)) for e in (0, 1))
        self.ramp, self.size = end.ramp, len(end.u) + len(goals)

    def by(self, explicit: Array, scale: float) -> tuple[float, str]:
        """Change of the distance per change of a number, and why there is none.

        Args:
            explicit: change of `residual` with the unknowns as they are.
            scale: of the number.
        """
        size = len(self._term.end.u)
        total = explicit[size:] - self._adjoint @ explicit[:size]
        for (what, rate), change in zip(self._conditions, total[1:], strict=True):
            if what.what == _TIES:
                if abs(change) * scale > _BREAKS * self._bound:
                    return 0.0, "both ends resist alike, and would not beyond a change of it"
            elif abs(change) * scale > _AT_ONCE * abs(rate):
                return 0.0, f"two changes of contacts meet at {self._term.end.cause}"
        return self._term.weight * float(total[0]), ""

    def residual(self, balance: Balance) -> Array:
        """Balance, place, separation and conditions of the state in a scene that is changed."""
        end, place = self._term.end, 0.0
        if end.place is not None:
            place = float(balance.condition(end.u, end.contacts, end.place))
        conditions = [float(balance.condition(end.u, end.contacts, what))
                  for what, _ in self._conditions]  # fmt: skip
        return np.concatenate([
            balance.residual(end.u, end.contacts),
            [place, float(balance.separation(end.u)), *conditions],
        ])  # fmt: skip
