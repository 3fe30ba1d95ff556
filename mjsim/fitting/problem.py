"""What a fit minimises: residuals over noise, at logarithms of the parameters and data of x."""

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
)  # fmt: skip  # what the square of a bent normal residual is expected to be
_STEP = 0.03  # of a parameter's logarithm: displacements scatter by 3e-5 L with links and steps
_ROUNDS = 6  # of the noise, until it changes by less than 1 %
_SAME = 0.01
_FAILED = 1e3  # deviations that a value is off where the walk fails
_LEAST = 1e-6  # of the data's range: noise below it is none
_NEAR = 1e-3  # of the unknowns: a step that is the last one
_INSIDE = 1e-9  # of bounds, where a search may begin


def by_name(parameters: Sequence[Parameter], logs: Array) -> dict[str, float]:
    """Values of parameters from their logarithms."""
    return {p.name: float(math.exp(x)) for p, x in zip(parameters, logs, strict=True)}


class Problem:
    """Residuals over noise at a point: logarithms of the parameters, then data of x over a scale.

    Args:
        predictor: the model.
        parameters: those that are free.

    Attributes:
        count, unknowns: numbers that were measured, and those to be found.
        noise: standard deviation of each number, (count,).
    """

    def __init__(self, predictor: Predictor, parameters: tuple[Parameter, ...]) -> None:
        self.predictor, self.parameters = predictor, parameters
        self.series = tuple(predictor.series)
        self.data = np.concatenate([series.value for series in self.series])
        self.kinds = np.concatenate([[s.noise] * len(s.value) for s in self.series])
        offsets = sorted({s.offset for s in self.series if s.offset is not None})
        numbers = [np.full(len(s.value), -1 if s.offset is None else s.offset) for s in self.series]
        of_datum = np.concatenate(numbers)
        self.offsets = offsets
        self.shift = np.stack([of_datum == o for o in offsets], axis=1).astype(float) if offsets \
            else np.zeros((len(self.data), 0))  # fmt: skip
        self.priors = [(i, p.prior) for i, p in enumerate(parameters) if p.prior]
        self.noise = np.ones(len(self.data))
        self.scale = 1e-3  # of offsets [m], so that steps are of one size

    @property
    def count(self) -> int:
        """Numbers that were measured."""
        return len(self.data)

    @property
    def unknowns(self) -> int:
        """Parameters and data of x."""
        return len(self.parameters) + len(self.offsets)

    def start(self) -> Array:
        """Where the search begins."""
        logs = np.log([p.start for p in self.parameters])
        missing = self.data - self._model(logs)
        shifts = [float(np.median(missing[column > 0])) for column in self.shift.T]
        return np.concatenate([logs, np.nan_to_num(shifts) / self.scale])

    def _model(self, logs: Array) -> Array:
        return np.concatenate(self.predictor(by_name(self.parameters, logs)))

    def differences(self, point: Array) -> Array:
        """Model less data, NaN where the walk failed."""
        count = len(self.parameters)
        model = self._model(point[:count]) + self.shift @ point[count:] * self.scale
        return np.asarray(model - self.data)

    def failed(self, differences: Array) -> list[str]:
        """Series in which a walk failed."""
        ends = np.cumsum([len(s.value) for s in self.series])[:-1]
        parts = np.split(differences, ends)
        return [s.name for s, part in zip(self.series, parts, strict=True)
                if not np.isfinite(part).all()]  # fmt: skip

    def set_noise(self, differences: Array, spread: bool = False) -> float:
        """Noise of each kind from what is left; returns the largest relative change."""
        change = 0.0
        for kind in np.unique(self.kinds):
            here = self.kinds == kind
            left, old = differences[here], self.noise[here][0]
            if spread:
                new = float(np.sqrt(np.mean(left**2)))
            else:
                free = len(left) * max(1 - self.unknowns / self.count, 0.1)
                bent = np.clip(left / old, -BEND, BEND)
                new = old * math.sqrt(float(bent @ bent) / (free * _SPREAD))
            new = max(new, _LEAST * float(np.ptp(self.data[here]) or abs(self.data[here]).max()))
            change = max(change, abs(new / old - 1))
            self.noise[here] = new
        return change

    def noise_by_kind(self) -> dict[str, float]:
        """Its standard deviation [m, rad or m/s]."""
        return {str(k): float(self.noise[self.kinds == k][0]) for k in np.unique(self.kinds)}

    def residuals(self, point: Array) -> Array:
        """Over the noise, priors last."""
        left = np.nan_to_num(self.differences(point) / self.noise, nan=_FAILED)
        prior = [
            (point[i] - math.log(mean)) / (deviation / mean) for i, (mean, deviation) in self.priors
        ]
        return np.concatenate([left, prior])

    def sensitivity(self, point: Array) -> Array:
        """Of the model to the unknowns, (count, unknowns), by central differences as one batch."""
        count = len(self.parameters)
        logs, limits = point[:count], self.bounds()[:, :count]
        sides = [np.clip(logs + sign * _STEP * row, *limits)
                 for row in np.eye(count) for sign in (-1, 1)]  # fmt: skip
        found = self.predictor.all([by_name(self.parameters, at) for at in [logs, *sides]])
        middle, *models = (np.concatenate(parts) for parts in found)
        columns = []
        for i in range(count):
            low, high = models[2 * i : 2 * i + 2]
            below, above = sides[2 * i][i], sides[2 * i + 1][i]
            low_fine, high_fine = np.isfinite(low), np.isfinite(high)
            rise = np.where(high_fine, high, middle) - np.where(low_fine, low, middle)
            width = np.where(high_fine, above, logs[i]) - np.where(low_fine, below, logs[i])
            columns.append(np.where(width > 0, rise / np.where(width > 0, width, 1.0), 0.0))
        return np.hstack([np.nan_to_num(np.stack(columns, axis=1)), self.shift * self.scale])

    def jacobian(self, sensitivity: Array) -> Array:
        """Of the residuals, (n, unknowns)."""
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
        """Huber's, of the data; a prior's is its square."""
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
        """Fit, find the noise, and again until it stays.

        Args:
            point: where to begin.
            sensitivity: to be used throughout; else it is found anew at each step, but once the
                noise has been found, at the beginning of what follows alone.
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
        found = optimize.least_squares(
            self.residuals, np.clip(point, low + _INSIDE, high - _INSIDE),
            jac=lambda at: self.jacobian(
                self.sensitivity(at) if sensitivity is None else sensitivity
            ),
            bounds=(low, high), loss=self.loss, xtol=_NEAR, ftol=1e-6, gtol=1e-6,
            max_nfev=30 if sensitivity is None else 10,
        )  # fmt: skip
        return np.asarray(found.x)
