"""Minimum and intervals of a fit on the cost itself, not on its slopes.

The cost of walks under friction is kinked where another end begins to slide and flat where none
changes, so that slopes at one point say little. Each end of an interval that the slopes give is
walked: where the cost has risen there by what it should, the interval stays. Else the parameter is
moved, the others fitted anew, until the cost has risen so (profile likelihood; Pawitan, In All
Likelihood, chapter 3). Where a lower cost shows on the way, the search for the minimum goes on from
there, without slopes.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from mjsim.fitting.problem import STEP, Problem

Array = NDArray[np.float64]

_AS_IT_SHOULD = (0.6, 1.6)  # rise of the cost over the expected one: widths within 27 %; chosen
_LOWER = 0.1  # of the rise: by which a cost must be lower to be another minimum; chosen
_SHARP = 0.05  # of a distance: to which an end of an interval is found; chosen
_POINTS = 10  # of a profile on one side, at most; chosen
_FIRST_RISES = (0.25, 100.0)  # between which a rise tells where to look first; chosen
_TRIES = 4  # steps of the other parameters at each; chosen
_RESTARTS = 3  # from lower costs; chosen
_FIRST, _LAST = 1.0, 0.2  # steps of the search without slopes, of standard errors; chosen
_LONGEST = 0.3  # likewise, of the logarithm; chosen
_EDGE = 1e-6  # of a logarithm, to a bound


class Profiled(NamedTuple):
    """A minimum, and the distances from it to the ends of the 95 % intervals.

    Attributes:
        point: the minimum.
        sensitivity: of the model there.
        below, above: distances of the parameters' logarithms, infinite where the cost has not risen
            enough at the bound, (P,).
    """

    point: Array
    sensitivity: Array
    below: Array
    above: Array


class _End(NamedTuple):
    """Point of a profile: its distance from the minimum, and the rise over the expected one."""

    distance: float
    rise: float
    point: Array


class _LowerCostError(Exception):
    """A point whose cost is below that of the minimum."""

    def __init__(self, point: Array) -> None:
        super().__init__()
        self.point = point


def profiled(problem: Problem, point: Array, sensitivity: Array) -> Profiled:
    """Minimum of the cost near a point, and the intervals about it.

    Args:
        problem: its noise is estimated anew at the minimum.
        point: of a fit.
        sensitivity: of the model there.
    """
    for at_the_end in [*[False] * _RESTARTS, True]:
        errors = problem.errors_alone(sensitivity)
        if errors.max() > STEP:
            sensitivity = problem.sensitivity(point, errors)
        profile = _Profile(problem, point, sensitivity)
        try:
            below, above = profile.sides(stop=not at_the_end)
            break
        except _LowerCostError as lower:
            point, sensitivity = _anew(problem, profile.lowest(lower.point))
    return Profiled(point, sensitivity, below, above)


def lowered(problem: Problem, point: Array, sensitivity: Array) -> tuple[Array, Array]:
    """Point of least cost near a point by a search without slopes, and the sensitivity there."""
    return _anew(problem, _Profile(problem, point, sensitivity).lowest(point))


def by_slopes(problem: Problem, point: Array, sensitivity: Array) -> Profiled:
    """Distances that the slopes give, where none hold."""
    widths = _Profile(problem, point, sensitivity).widths
    return Profiled(point, sensitivity, widths, widths)


def _anew(problem: Problem, point: Array) -> tuple[Array, Array]:
    """Point and sensitivity, once the noise is estimated at another minimum."""
    problem.set_noise(problem.differences(point))
    return point, problem.sensitivity(point)


class _Profile:
    """Cost about a minimum.

    Args:
        problem: its noise stays.
        point: the minimum.
        sensitivity: of the model there.
    """

    def __init__(self, problem: Problem, point: Array, sensitivity: Array) -> None:
        self.problem, self.point, self.sensitivity = problem, point, sensitivity
        self.count = len(problem.parameters)
        self.covariance = problem.covariance(point, sensitivity)
        quantile = stats.t.ppf(0.975, max(problem.count - problem.unknowns, 1))
        self.widths = float(quantile) * np.sqrt(np.diag(self.covariance))[: self.count]
        self.least = problem.cost(point)
        self.expected = float(quantile) ** 2 * problem.unit(problem.residuals(point))

    def sides(self, stop: bool) -> tuple[Array, Array]:
        """Distances to the lower and upper ends of the intervals, (P,) each.

        Args:
            stop: whether to raise _LowerCostError at a point whose cost is lower.
        """
        starts = [self._start(i, sign) for i in range(self.count) for sign in (-1.0, 1.0)]
        self.problem.walk([at for _, at in starts])
        ends = [self._end(distance, at) for distance, at in starts]
        best = min(ends, key=lambda end: end.rise)
        if stop and best.rise < -_LOWER:
            raise _LowerCostError(best.point)
        distances = [self._side(number // 2, (-1.0, 1.0)[number % 2], end, stop)
                     for number, end in enumerate(ends)]  # fmt: skip
        return np.array(distances[::2]), np.array(distances[1::2])

    def _limit(self, i: int, sign: float) -> float:
        """Distance to a parameter's bound."""
        low, high = self.problem.bounds()[:, i]
        return float(max(high - self.point[i] if sign > 0 else self.point[i] - low, 0.0))

    def _start(self, i: int, sign: float) -> tuple[float, Array]:
        """End of an interval as the slopes give it, with all parameters kept in their bounds."""
        distance = float(min(self.widths[i], self._limit(i, sign)))
        along = sign * self.covariance[i] / self.covariance[i, i]
        return distance, np.clip(self.point + distance * along, *self.problem.bounds())

    def _end(self, distance: float, at: Array) -> _End:
        """The cost at parameters, with the zeros fitted to them."""
        at = self.problem.fitted(at, self.sensitivity, fixed=range(self.count))
        rise = (self.problem.cost(at) - self.least) / self.expected
        return _End(distance, rise, at)

    def _fitted_at(self, i: int, sign: float, distance: float, near: _End) -> _End:
        """The cost at a distance, the other unknowns fitted, from a point of the profile on."""
        at = self.point.copy()
        if near.distance:
            at += (near.point - self.point) * distance / near.distance
        at[i] = self.point[i] + sign * distance
        at = self.problem.fitted(at, self.sensitivity, fixed=[i], tries=_TRIES)
        return _End(distance, (self.problem.cost(at) - self.least) / self.expected, at)

    def _side(self, i: int, sign: float, end: _End, stop: bool) -> float:
        """Distance at which the cost has risen as expected, infinite if it has not at the bound."""
        limit, width = self._limit(i, sign), self.widths[i]
        low, high = _AS_IT_SHOULD
        if end.distance == width and low < end.rise < high:
            return end.distance / math.sqrt(end.rise)
        if limit < _EDGE:
            return math.inf
        inside, outside = _End(0.0, 0.0, self.point), None
        for _ in range(_POINTS):
            distance = self._next(inside, outside, end, limit)
            point = self._fitted_at(i, sign, distance, inside if inside.distance else end)
            if stop and point.rise < -_LOWER:
                raise _LowerCostError(point.point)
            if point.rise < 1:
                inside = point
                if distance >= limit - _EDGE:
                    return math.inf
            else:
                outside = point
            if outside is not None and outside.distance * (1 - _SHARP) < inside.distance:
                break
        return math.inf if outside is None else _between(inside, outside)

    def _next(self, inside: _End, outside: "_End | None", end: _End, limit: float) -> float:
        """Distance to look at next: farther until the cost has risen, then between."""
        if outside is None:
            first = end.distance / math.sqrt(np.clip(end.rise, *_FIRST_RISES))
            return min(2 * inside.distance or first, limit)
        guess = _between(inside, outside)
        span = outside.distance - inside.distance
        return float(np.clip(guess, inside.distance + 0.1 * span, outside.distance - 0.1 * span))

    def lowest(self, point: Array) -> Array:
        """Point of least cost from a point on, by steps along the axes of the covariance."""
        covariance = self.covariance[: self.count, : self.count]
        values, vectors = np.linalg.eigh(covariance)
        axes = vectors.T * np.sqrt(np.clip(values, 0.0, _LONGEST**2))[:, None]
        low, high = self.problem.bounds()
        best, step = self._end(0.0, point), _FIRST
        while step > _LAST:
            steps = [np.append(sign * step * axis, np.zeros(len(point) - self.count))
                     for axis in axes for sign in (-1.0, 1.0)]  # fmt: skip
            trials = [np.clip(best.point + part, low, high) for part in steps]
            self.problem.walk(trials)
            trial = min((self._end(0.0, at) for at in trials), key=lambda end: end.rise)
            if trial.rise < best.rise - 0.1 * _LOWER:
                best = trial
            else:
                step /= 2
        return best.point


def _between(inside: _End, outside: _End) -> float:
    """Distance between two ends where the root of the rise, which is straight, is 1."""
    first, second = math.sqrt(max(inside.rise, 0.0)), math.sqrt(outside.rise)
    part = (1 - first) / max(second - first, _EDGE)
    return inside.distance + min(part, 1.0) * (outside.distance - inside.distance)
