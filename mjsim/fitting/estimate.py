"""Robust least squares with estimated noise and 95 % intervals.

Parameters are fitted on a logarithmic scale. Residuals are over the noise of their kind; beyond
Huber's bend they count by their size and no longer by its square (Huber 1964). The noise is
estimated from the residuals (Huber's proposal 2), and standard errors are those of such an
estimate, of errors that are independent of each other.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from mjsim.fitting.observations import Series
from mjsim.fitting.parameters import Parameter
from mjsim.fitting.problem import BEND, Problem, by_name
from mjsim.fitting.walks import Predictor

Array = NDArray[np.float64]

_LOST = 1e-5  # of the largest information: below it is an error of the sensitivities, 0.1 %
_ENDLESS = 1e3  # error of the logarithm of a parameter that the data do not determine at all
_NOTHING = 1e-9  # deviations of the data for a unit of a logarithm, likewise


@dataclass(frozen=True)
class Estimate:
    """Fitted values and their uncertainty.

    Attributes:
        parameters: that were free.
        value: of the parameters, (P,).
        error: standard error of their logarithms, (P,): relative.
        low, high: of the 95 % intervals, (P,).
        covariance: of the logarithms, (P, P).
        sensitivity: of residuals over noise to the logarithms, (n, P).
        noise: standard deviation by kind [m, rad or m/s].
        offset: data of x, by number [m].
        series: measurements.
        model: prediction of each series, offsets included.
        count: numbers that were fitted.
    """

    parameters: tuple[Parameter, ...]
    value: Array
    error: Array
    low: Array
    high: Array
    covariance: Array
    sensitivity: Array
    noise: dict[str, float]
    offset: dict[int, float]
    series: tuple[Series, ...]
    model: tuple[Array, ...]
    count: int

    @property
    def values(self) -> dict[str, float]:
        """Values by name of the parameter."""
        return by_name(self.parameters, np.log(self.value))

    def residuals(self) -> list[Array]:
        """Residuals, data less model, of each series."""
        return [s.value - model for s, model in zip(self.series, self.model, strict=True)]

    @property
    def correlation(self) -> Array:
        """Correlation of the logarithms, (P, P)."""
        return np.asarray(self.covariance / np.outer(self.error, self.error))

    def autocorrelation(self) -> float:
        """Correlation of residuals along time or pressure, the largest of all series."""
        largest = 0.0
        for series, residual in zip(self.series, self.residuals(), strict=True):
            if len(residual) > 8 and len(series.runs) == 1:
                part = np.clip(residual / self.noise[series.noise], -3, 3)[np.argsort(series.at)]
                largest = max(largest, float(part[1:] @ part[:-1] / (part @ part)))
        return largest


def estimate(
    predictor: Predictor,
    parameters: Sequence[Parameter],
    refined: Predictor | None = None,
) -> Estimate:
    """Fit the parameters to the predictor's series.

    Args:
        predictor: model that walks often.
        parameters: free ones.
        refined: finer model in which the fit ends; its sensitivities are taken to be the same.

    Raises:
        ValueError: there are fewer numbers than unknowns, or the walk at the start fails.
    """
    problem = Problem(predictor, tuple(parameters))
    if problem.count + len(problem.priors) <= problem.unknowns:
        raise ValueError(
            f"data must be more than the {problem.unknowns} unknowns, got {problem.count} numbers"
        )
    point = problem.start()
    differences = problem.differences(point)
    failed = problem.failed(differences)
    if failed:
        raise ValueError(
            f"the walk at the start fails in {', '.join(failed)}: give another --start"
        )
    problem.set_noise(differences, spread=True)
    point = problem.settle(point)
    sensitivity = problem.sensitivity(point)
    if refined is not None:
        problem.predictor = refined
        point = problem.settle(point, sensitivity)
    return _judged(problem, point, sensitivity)


def _judged(problem: Problem, point: Array, sensitivity: Array) -> Estimate:
    """Estimate with the errors of a bent loss (Huber, Robust Statistics, section 7.6)."""
    count, free = len(problem.parameters), max(problem.count - problem.unknowns, 1)
    differences = problem.differences(point)
    deviations = differences / problem.noise
    inside = max(float(np.mean(np.abs(deviations) <= BEND)), 1 / problem.count)
    variance = max(float(np.sum(np.clip(deviations, -BEND, BEND) ** 2)) / free, _NOTHING)
    jacobian = problem.jacobian(sensitivity)
    data, prior = jacobian[: problem.count], jacobian[problem.count :]
    whole = _inverse(data.T @ data * inside**2 / variance + prior.T @ prior)
    covariance = whole[:count, :count]
    error = np.sqrt(np.diag(covariance))
    logs, wide = point[:count], float(stats.t.ppf(0.975, free)) * error
    with np.errstate(over="ignore"):
        low, high = np.exp(logs - wide), np.exp(logs + wide)
    shifts = (point[count:] * problem.scale).tolist()
    return Estimate(
        parameters=problem.parameters,
        value=np.exp(logs),
        error=error,
        low=low,
        high=high,
        covariance=covariance,
        sensitivity=jacobian[:, :count],
        noise=problem.noise_by_kind(),
        offset=dict(zip(problem.offsets, shifts, strict=True)),
        series=problem.series,
        model=tuple(problem.split(problem.data + differences)),
        count=problem.count,
    )


def _inverse(information: Array) -> Array:
    """Inverse of a symmetric matrix, nearly infinite along directions that it does not determine.

    It stays so small that the errors of the other directions do not drown in its rounding.
    """
    scale = np.maximum(np.sqrt(np.diag(information)), _NOTHING)
    values, vectors = np.linalg.eigh(information / np.outer(scale, scale))
    directions = vectors / scale[:, None]
    endless = _ENDLESS**2 / (directions**2).sum(axis=0)
    kept = values > _LOST
    inverse = np.where(kept, 1 / np.where(kept, values, 1.0), endless)
    return np.asarray((directions * inverse) @ directions.T)
