"""Slopes by least squares with intervals of Student's t, of readings of unknown scatter."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

Array = NDArray[np.float64]

LEVEL = 0.95
_EXACT = 1e-9  # of the values: residuals that are no scatter
_FLOOR = 0.02  # of the largest: least value that scatter is taken in proportion to; chosen
_ROUNDS = 3  # of fits whose weights are of the one before
_LIKELY = 2.0  # of the logarithm of the likelihood: no less likely than that by chance; chosen


class Estimate(NamedTuple):
    """A number and its uncertainty.

    Attributes:
        value: in the unit of the field.
        error: its standard error; NaN of one reading.
        freedom: degrees of freedom of the error.
    """

    value: float
    error: float
    freedom: float

    @property
    def half_width(self) -> float:
        """Half of the 95 % interval, Student's t; NaN of one reading."""
        if math.isnan(self.error):
            return math.nan
        return float(stdtrit(self.freedom, 0.5 * (1 + LEVEL))) * self.error

    @property
    def interval(self) -> tuple[float, float]:
        """95 % interval."""
        return self.value - self.half_width, self.value + self.half_width


def slopes(columns: Array, values: Array) -> tuple[list[Estimate], float]:
    """Least squares without an intercept.

    Args:
        columns: (n, k).
        values: (n,).

    Returns:
        Estimates of k slopes, and the sum of squared residuals.
    """
    estimates, *_ = np.linalg.lstsq(columns, values, rcond=None)
    freedom = len(values) - columns.shape[1]
    rest = float(np.sum((values - columns @ estimates) ** 2))
    variance = rest / freedom if freedom else math.nan
    inverse = np.linalg.inv(columns.T @ columns)
    errors = np.sqrt(variance * np.diag(inverse))
    pairs = zip(estimates.tolist(), errors.tolist(), strict=True)
    return [Estimate(value, error, freedom) for value, error in pairs], rest


def best(columns: Array, values: Array, sizes: Sequence[Array]) -> list[Estimate]:
    """Slopes under the first of sizes of scatter, with the largest error of all of them.

    Args:
        columns: (n, k).
        values: (n,).
        sizes: each (n,).
    """
    fits = [slopes(columns / size[:, None], values / size)[0] for size in sizes]
    errors = [[slope.error for slope in fit] for fit in fits]
    return [
        slope._replace(error=max(each))
        for slope, each in zip(fits[0], zip(*errors, strict=True), strict=True)
    ]


def scatters(columns: Array, values: Array) -> list[Array]:
    """Sizes of the scatter of each value, up to a factor, (n,) each: alike, or as the value.

    The likelier under normal errors first; the other only where it is hardly less likely.

    Args:
        columns: of what the values are a sum of, (n, k).
        values: (n,).
    """
    count = len(values)
    alike = np.ones(count)
    if count <= columns.shape[1] or not values.any():
        return [alike]
    grown = alike
    for _ in range(_ROUNDS):
        estimates, _ = slopes(columns / grown[:, None], values / grown)
        fitted = columns @ [slope.value for slope in estimates]
        grown = np.maximum(fitted, _FLOOR * float(np.abs(fitted).max()))

    def unlikely(size: Array) -> float:
        _, rest = slopes(columns / size[:, None], values / size)
        return 0.5 * count * math.log(max(rest, least(values / size))) + float(np.log(size).sum())

    first, second = sorted((alike, grown), key=unlikely)
    return [first, second] if unlikely(second) < unlikely(first) + _LIKELY else [first]


def least(values: Array) -> float:
    """Sum of squared residuals below which there is no scatter."""
    return len(values) * _EXACT**2 * float(np.mean(values**2))
