"""Residuals over noise that a fit minimises, at logarithms of the parameters and at zeros.

Zeros are what a camera's x, a protractor's angle or a sensor's pressure read where there is none.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from mjsim.fitting.huber import BEND, SPREAD, inverse, loss, shares
from mjsim.fitting.observations import PRESSURE, Series
from mjsim.fitting.parameters import Parameter
from mjsim.fitting.walks import Predictor

Array = NDArray[np.float64]

STEP = 0.03  # of a parameter's logarithm: displacements scatter by 3e-5 L with links and steps
_LARGEST_STEP = 0.3  # likewise, where one standard error is as large or larger; chosen
_ROUNDS = 6  # of the noise, until it changes by less than 1 %
_SAME = 0.01
_FAILED = 1e3  # deviations of a value from the data where the walk fails
_LEAST = 1e-6  # of the data's range: smallest noise
_NEAR = 1e-3  # of the unknowns: step at which the search ends
_INSIDE = 1e-9  # distance from the bounds at which a search may begin
_NOTHING = 1e-9  # deviations of the data for a unit of a logarithm; fewer are none


def by_name(parameters: Sequence[Parameter], logs: Array) -> dict[str, float]:
    """Values of parameters from their logarithms."""
    return {p.name: float(math.exp(x)) for p, x in zip(parameters, logs, strict=True)}


class Problem:
    """Residuals over noise at a point: logarithms of the parameters, then zeros over their scales.

    Args:
        predictor: the model.
        parameters: free ones.

    Attributes:
        count, unknowns: how many numbers were measured, and how many are to be fitted.
        noise: standard deviation of each number, (count,).
        scale: of the zeros, so that steps are of one size, (zeros,) [m, rad or Pa].
        inflation: factor on the variance of the data's mean, as neighbouring errors are alike.
    """

    def __init__(self, predictor: Predictor, parameters: tuple[Parameter, ...]) -> None:
        self.predictor, self.parameters = predictor, parameters
        self.series = tuple(predictor.series)
        self.data = np.concatenate([series.value for series in self.series])
        self.kinds = np.concatenate([[s.noise] * len(s.value) for s in self.series])
        self.offsets = sorted({s.offset for s in self.series if s.offset is not None})
        rows = [[float(s.offset == offset) for offset in self.offsets] for s in self.series]
        self.shift = np.repeat(rows, [len(s.value) for s in self.series], axis=0)
        self.scale = np.array([_scale(self.series, offset) for offset in self.offsets])
        self.of_pressure = any(s.zero == PRESSURE for s in self.series)
        self.priors = [(i, p.prior) for i, p in enumerate(parameters) if p.prior]
        self.noise = np.ones(len(self.data))
        self.inflation = 1.0

    @property
    def count(self) -> int:
        """Number of measurements."""
        return len(self.data)

    @property
    def unknowns(self) -> int:
        """Number of parameters and zeros."""
        return len(self.parameters) + len(self.offsets)

    def start(self) -> Array:
        """Point at which the search begins."""
        logs = np.log([p.start for p in self.parameters])
        residuals = self.data - self._model(logs, np.zeros(len(self.offsets)))
        levels = [0.0 if self._zero(offset) == PRESSURE else float(np.median(residuals[rows > 0]))
                  for offset, rows in zip(self.offsets, self.shift.T, strict=True)]  # fmt: skip
        return np.concatenate([logs, np.nan_to_num(levels) / self.scale])

    def _zero(self, offset: int) -> str:
        return next(s.zero for s in self.series if s.offset == offset)

    def _model(self, logs: Array, zeros: Array) -> Array:
        """Prediction of all numbers, with zeros over their scales."""
        values, levels = by_name(self.parameters, logs), zeros * self.scale
        pressures = {offset: level for offset, level in zip(self.offsets, levels, strict=True)
                     if self.of_pressure and self._zero(offset) == PRESSURE}  # fmt: skip
        model = np.concatenate(self.predictor(values, pressures))
        others = np.array([offset not in pressures for offset in self.offsets], dtype=bool)
        return np.asarray(model + self.shift @ (levels * others))

    def differences(self, point: Array) -> Array:
        """Model less data, NaN where the walk failed."""
        count = len(self.parameters)
        return self._model(point[:count], point[count:]) - self.data

    def failed(self, differences: Array) -> list[str]:
        """Names of series in which a walk failed."""
        return [s.name for s, part in zip(self.series, self.split(differences), strict=True)
                if not np.isfinite(part).all()]  # fmt: skip

    def split(self, values: Array) -> list[Array]:
        """Split values of all series, (count,), into those of each."""
        return np.split(values, np.cumsum([len(s.value) for s in self.series])[:-1])

    def set_noise(self, differences: Array, spread: bool = False) -> float:
        """Estimate the noise of each kind from the differences.

        Args:
            differences: model less data, (count,).
            spread: whether to take their root mean square, which outliers dominate.

        Returns:
            Largest relative change.
        """
        change = 0.0
        for kind in np.unique(self.kinds):
            rows = self.kinds == kind
            part, data, old = differences[rows], self.data[rows], self.noise[rows][0]
            if spread:
                new = float(np.sqrt(np.mean(part**2)))
            else:
                free = len(part) * max(1 - self.unknowns / self.count, 0.1)
                bent = np.clip(part / old, -BEND, BEND)
                new = old * math.sqrt(float(bent @ bent) / (free * SPREAD))
            new = max(new, _LEAST * float(np.ptp(data) or abs(data).max() or 1.0))
            change = max(change, abs(new / old - 1))
            self.noise[rows] = new
        return change

    def noise_by_kind(self) -> dict[str, float]:
        """Standard deviation of each kind [m, rad or m/s]."""
        return {str(k): float(self.noise[self.kinds == k][0]) for k in np.unique(self.kinds)}

    def residuals(self, point: Array) -> Array:
        """Residuals over the noise, priors last, (n,)."""
        data = np.nan_to_num(self.differences(point) / self.noise, nan=_FAILED)
        prior = [
            (point[i] - math.log(mean)) / (deviation / mean) for i, (mean, deviation) in self.priors
        ]
        return np.concatenate([data, prior])

    def sensitivity(self, point: Array, errors: Array | None = None) -> Array:
        """Derivative of the model, (count, unknowns): exact, or by differences as one batch.

        Args:
            point: where.
            errors: standard errors of the parameters' logarithms if no other changes, (P,): steps
                are as long, in their limits, so that the scatter of the walks does not pass for
                what the data tell.
        """
        count = len(self.parameters)
        values = by_name(self.parameters, point[:count])
        exact = self.predictor.derivatives(values)
        if exact is not None and not self.offsets:
            return exact * list(values.values())
        steps = np.full(count, STEP) if errors is None else np.clip(errors, STEP, _LARGEST_STEP)
        logs, limits = point[:count], self.bounds()[:, :count]
        sides = [np.clip(logs + sign * step, *limits)
                 for step in np.diag(steps) for sign in (-1, 1)]  # fmt: skip
        self.walk([logs, *sides])
        middle, *models = (self._model(at, point[count:]) for at in [logs, *sides])
        columns = []
        for i in range(count):
            low, high = models[2 * i : 2 * i + 2]
            below, above = sides[2 * i][i], sides[2 * i + 1][i]
            low_done, high_done = np.isfinite(low), np.isfinite(high)
            rise = np.where(high_done, high, middle) - np.where(low_done, low, middle)
            width = np.where(high_done, above, logs[i]) - np.where(low_done, below, logs[i])
            columns.append(np.where(width > 0, rise / np.where(width > 0, width, 1.0), 0.0))
        for zero in np.eye(len(self.offsets)):
            rise = self._model(logs, point[count:] + zero) - self._model(logs, point[count:] - zero)
            columns.append(0.5 * rise)
        return np.nan_to_num(np.stack(columns, axis=1))

    def walk(self, points: Iterable[Array]) -> None:
        """Walk at several points, parameters first, as one batch; later calls remember it."""
        count = len(self.parameters)
        self.predictor.all([by_name(self.parameters, point[:count]) for point in points])

    def jacobian(self, sensitivity: Array) -> Array:
        """Derivative of the residuals, (n, unknowns)."""
        rows = np.zeros((len(self.priors), self.unknowns))
        for row, (i, (mean, deviation)) in zip(rows, self.priors, strict=True):
            row[i] = mean / deviation
        return np.vstack([sensitivity / self.noise[:, None], rows])

    def bounds(self) -> Array:
        """Lowest and highest point, (2, unknowns)."""
        limits = np.log([[p.low, p.high] for p in self.parameters]).T
        free = np.full((2, len(self.offsets)), [[-np.inf], [np.inf]])
        return np.hstack([limits, free])

    def cost(self, point: Array) -> float:
        """Loss of the data, and of the priors as they count beside it."""
        residuals = self.residuals(point)
        losses = loss(residuals**2, self.count)[0]
        return float(losses[: self.count].sum() + self.unit(residuals) * losses[self.count :].sum())

    def unit(self, residuals: Array) -> float:
        """Rise of the cost at one standard error of a parameter, the others fitted anew.

        Args:
            residuals: over the noise, at the fit.
        """
        variance, inside = shares(residuals[: self.count], self.unknowns)
        return self.inflation * variance / inside

    def covariance(self, point: Array, sensitivity: Array) -> Array:
        """Covariance of the unknowns, (unknowns, unknowns)."""
        variance, inside = shares(self.residuals(point)[: self.count], self.unknowns)
        jacobian = self.jacobian(sensitivity)
        data, prior = jacobian[: self.count], jacobian[self.count :]
        return inverse(data.T @ data * inside**2 / variance / self.inflation + prior.T @ prior)

    def errors_alone(self, sensitivity: Array) -> Array:
        """Standard errors of the parameters' logarithms if no other unknown changes, (P,)."""
        columns = self.jacobian(sensitivity)[:, : len(self.parameters)]
        return np.asarray(1 / np.maximum(np.sqrt((columns**2).sum(axis=0)), _NOTHING))

    def settle(self, point: Array, sensitivity: Array | None = None) -> tuple[Array, Array]:
        """Fit and estimate the noise in turn until the noise stays.

        Args:
            point: to begin at.
            sensitivity: of all steps; if None that of each step in the first two fits, and that of
                their result after them.

        Returns:
            The point, and the sensitivity of the last steps.
        """
        point = self.fitted(point, sensitivity)
        self.set_noise(self.differences(point))
        if sensitivity is None:
            point = self.fitted(point, None)
            self.set_noise(self.differences(point))
            sensitivity = self.sensitivity(point)
        for _ in range(_ROUNDS):
            point = self.fitted(point, sensitivity)
            if self.set_noise(self.differences(point)) < _SAME:
                break
        return point, sensitivity

    def fitted(
        self, point: Array, sensitivity: Array | None, fixed: Sequence[int] = (), tries: int = 10
    ) -> Array:
        """Point of least cost from a point on.

        Args:
            point: to begin at.
            sensitivity: of all steps; if None that of each.
            fixed: numbers of unknowns that stay as they are.
            tries: number of steps, at most, with a sensitivity that is given.
        """
        low, high = self.bounds()
        point = np.clip(point, low + _INSIDE, high - _INSIDE)
        free = np.setdiff1d(np.arange(self.unknowns), fixed)
        if not len(free):
            return point

        def at(part: Array) -> Array:
            whole = point.copy()
            whole[free] = part
            return whole

        result = optimize.least_squares(
            lambda part: self.residuals(at(part)), point[free],
            jac=lambda part: self.jacobian(
                self.sensitivity(at(part)) if sensitivity is None else sensitivity
            )[:, free],
            bounds=(low[free], high[free]), loss=lambda squares: loss(squares, self.count),
            xtol=_NEAR, ftol=1e-6, gtol=1e-6,
            max_nfev=30 if sensitivity is None else tries,
        )  # fmt: skip
        return at(result.x)


def _scale(series: Sequence[Series], offset: int) -> float:
    """Size of a step of a zero: 1 mm of x, a hundredth of the largest angle or pressure."""
    of_it = [s for s in series if s.offset == offset]
    if not of_it[0].zero:
        return 1e-3
    numbers = [s.at if s.zero == PRESSURE else s.value for s in of_it]
    return 0.01 * max(float(np.abs(part).max()) for part in numbers) or 1.0
