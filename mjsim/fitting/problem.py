"""Residuals over noise that a fit minimises, at logarithms of the parameters and data of x."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import optimize, stats

from mjsim.fitting.parameters import Parameter
from mjsim.fitting.walks import Predictor

Array = NDArray[np.float64]

BEND = 1.345  # deviations: 95 % as efficient as squares where errors are normal (Huber)
_SPREAD = float(
    stats.norm.cdf(BEND) - stats.norm.cdf(-BEND) - 2 * BEND * stats.norm.pdf(BEND)
    + 2 * BEND**2 * stats.norm.sf(BEND)
)  # fmt: skip  # expected square of a bent normal residual
_STEP = 0.03  # of a parameter's logarithm: displacements scatter by 3e-5 L with links and steps
_ROUNDS = 6  # of the noise, until it changes by less than 1 %
_SAME = 0.01
_FAILED = 1e3  # deviations of a value from the data where the walk fails
_LEAST = 1e-6  # of the data's range: smallest noise
_NEAR = 1e-3  # of the unknowns: step at which the search ends
_INSIDE = 1e-9  # distance from the bounds at which a search may begin


def by_name(parameters: Sequence[Parameter], logs: Array) -> dict[str, float]:
    """Values of parameters from their logarithms."""
    return {p.name: float(math.exp(x)) for p, x in zip(parameters, logs, strict=True)}


class Problem:
    """Residuals over noise at a point: logarithms of the parameters, then data of x over a scale.

    Args:
        predictor: the model.
        parameters: free ones.

    Attributes:
        count, unknowns: how many numbers were measured, and how many are to be fitted.
        noise: standard deviation of each number, (count,).
    """

    def __init__(self, predictor: Predictor, parameters: tuple[Parameter, ...]) -> None:
        self.predictor, self.parameters = predictor, parameters
        self.series = tuple(predictor.series)
        self.data = np.concatenate([series.value for series in self.series])
        self.kinds = np.concatenate([[s.noise] * len(s.value) for s in self.series])
        self.offsets = sorted({s.offset for s in self.series if s.offset is not None})
        rows = [[float(s.offset == offset) for offset in self.offsets] for s in self.series]
        self.shift = np.repeat(rows, [len(s.value) for s in self.series], axis=0)
        self.priors = [(i, p.prior) for i, p in enumerate(parameters) if p.prior]
        self.noise = np.ones(len(self.data))
        self.scale = 1e-3  # of offsets [m], so that steps are of one size

    @property
    def count(self) -> int:
        """Number of measurements."""
        return len(self.data)

    @property
    def unknowns(self) -> int:
        """Number of parameters and data of x."""
        return len(self.parameters) + len(self.offsets)

    def start(self) -> Array:
        """Point at which the search begins."""
        logs = np.log([p.start for p in self.parameters])
        residuals = self.data - self._model(logs)
        shifts = [float(np.median(residuals[column > 0])) for column in self.shift.T]
        return np.concatenate([logs, np.nan_to_num(shifts) / self.scale])

    def _model(self, logs: Array) -> Array:
        return np.concatenate(self.predictor(by_name(self.parameters, logs)))

    def differences(self, point: Array) -> Array:
        """Model less data, NaN where the walk failed."""
        count = len(self.parameters)
        model = self._model(point[:count]) + self.shift @ point[count:] * self.scale
        return np.asarray(model - self.data)

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
                new = old * math.sqrt(float(bent @ bent) / (free * _SPREAD))
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

    def sensitivity(self, point: Array) -> Array:
        """Derivative of the model, (count, unknowns), by central differences as one batch."""
        count = len(self.parameters)
        logs, limits = point[:count], self.bounds()[:, :count]
        sides = [np.clip(logs + sign * _STEP * row, *limits)
                 for row in np.eye(count) for sign in (-1, 1)]  # fmt: skip
        walks = self.predictor.all([by_name(self.parameters, at) for at in [logs, *sides]])
        middle, *models = (np.concatenate(parts) for parts in walks)
        columns = []
        for i in range(count):
            low, high = models[2 * i : 2 * i + 2]
            below, above = sides[2 * i][i], sides[2 * i + 1][i]
            low_done, high_done = np.isfinite(low), np.isfinite(high)
            rise = np.where(high_done, high, middle) - np.where(low_done, low, middle)
            width = np.where(high_done, above, logs[i]) - np.where(low_done, below, logs[i])
            columns.append(np.where(width > 0, rise / np.where(width > 0, width, 1.0), 0.0))
        return np.hstack([np.nan_to_num(np.stack(columns, axis=1)), self.shift * self.scale])

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

    def loss(self, squares: Array) -> Array:
        """Huber's loss of the data, and squares of the priors, with two derivatives, (3, n)."""
        roots = np.sqrt(squares)
        far = roots > BEND
        far[self.count :] = False
        safe = np.where(far, roots, BEND)
        return np.stack([
            np.where(far, 2 * BEND * safe - BEND**2, squares),
            np.where(far, BEND / safe, 1.0),
            np.where(far, -0.5 * BEND / safe**3, 0.0),
        ])  # fmt: skip

    def settle(self, point: Array, sensitivity: Array | None = None) -> Array:
        """Fit and estimate the noise in turn until the noise stays.

        Args:
            point: to begin at.
            sensitivity: of all steps; if None that of each step in the first two fits, and that of
                their result after them.
        """
        point = self._fitted(point, sensitivity)
        self.set_noise(self.differences(point))
        if sensitivity is None:
            point = self._fitted(point, None)
            self.set_noise(self.differences(point))
            sensitivity = self.sensitivity(point)
        for _ in range(_ROUNDS):
            point = self._fitted(point, sensitivity)
            if self.set_noise(self.differences(point)) < _SAME:
                break
        return point

    def _fitted(self, point: Array, sensitivity: Array | None) -> Array:
        low, high = self.bounds()
        result = optimize.least_squares(
            self.residuals, np.clip(point, low + _INSIDE, high - _INSIDE),
            jac=lambda at: self.jacobian(
                self.sensitivity(at) if sensitivity is None else sensitivity
            ),
            bounds=(low, high), loss=self.loss, xtol=_NEAR, ftol=1e-6, gtol=1e-6,
            max_nfev=30 if sensitivity is None else 10,
        )  # fmt: skip
        return np.asarray(result.x)
