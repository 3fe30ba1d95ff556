"""Robust least squares with estimated noise and 95 % intervals.

Parameters are fitted on a logarithmic scale. Residuals are over the noise of their kind; beyond
Huber's bend they count by their size and no longer by its square (Huber 1964). The noise is
estimated from the residuals (Huber's proposal 2). Intervals are where the cost itself has risen
(mjsim.fitting.profile); they grow with residuals that are alike, and are withheld where these show
that the model misses the data (mjsim.fitting.misfit).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from mjsim.fitting.misfit import Misfit, misfit
from mjsim.fitting.observations import PRESSURE, Series
from mjsim.fitting.parameters import Parameter
from mjsim.fitting.problem import Problem, by_name
from mjsim.fitting.profile import Profiled, by_slopes, lowered, profiled
from mjsim.fitting.walks import Predictor

Array = NDArray[np.float64]


_OPEN = 1.0  # error of a logarithm, beyond which bounds and not data end an interval; chosen


@dataclass(frozen=True)
class Estimate:
    """Fitted values and their uncertainty.

    Attributes:
        parameters: that were free.
        value: of the parameters, (P,).
        error: standard error of their logarithms, (P,): relative; as the interval is wide.
        low, high: of the 95 % intervals, (P,): 0 or infinite where the data set no limit, NaN where
            the model misses the data so that no interval holds.
        covariance: of the logarithms, by the slopes at the fit, (P, P).
        sensitivity: of residuals over noise to the logarithms, (n, P).
        noise: standard deviation by kind [m, rad or m/s].
        offset: zeros, by number [m, rad or Pa].
        offset_error: standard errors of them.
        series: measurements.
        model: prediction of each series, offsets included.
        count: numbers that were fitted.
        misfit: structure of the residuals.
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
    offset_error: dict[int, float]
    series: tuple[Series, ...]
    model: tuple[Array, ...]
    count: int
    misfit: Misfit

    @property
    def values(self) -> dict[str, float]:
        """Values by name of the parameter."""
        return by_name(self.parameters, np.log(self.value))

    @property
    def pressure_zeros(self) -> dict[int, float]:
        """Pressures that sensors show where there is none, by offset [Pa]."""
        return {s.offset: self.offset[s.offset] for s in self.series
                if s.zero == PRESSURE and s.offset is not None}  # fmt: skip

    def level(self, series: Series) -> float:
        """Zero of the values of a series, 0 if it has none [m or rad]."""
        if series.offset is None or series.zero == PRESSURE:
            return 0.0
        return self.offset[series.offset]

    def residuals(self) -> list[Array]:
        """Residuals, data less model, of each series."""
        return [s.value - model for s, model in zip(self.series, self.model, strict=True)]

    @property
    def correlation(self) -> Array:
        """Correlation of the logarithms, (P, P)."""
        errors = np.sqrt(np.diag(self.covariance))
        return np.asarray(self.covariance / np.outer(errors, errors))


def estimate(
    predictor: Predictor,
    parameters: Sequence[Parameter],
    refined: Predictor | None = None,
) -> Estimate:
    """Fit the parameters to the predictor's series.

    Args:
        predictor: model that walks often.
        parameters: free ones.
        refined: finer model in which the fit ends; its sensitivities and the shapes of its
            intervals are taken to be the same.

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
        reasons = "".join(f" ({reason})" for reason in predictor.refused.values())
        raise ValueError(
            f"the walk at the start fails in {', '.join(failed)}{reasons}: give another --start"
        )
    problem.set_noise(differences, spread=True)
    point, sensitivity = problem.settle(point)
    structure = _structure(problem, point)
    if structure.withheld:  # or the search has ended beside the minimum
        point, sensitivity = lowered(problem, point, sensitivity)
        structure = _structure(problem, point)
    problem.inflation = structure.inflation
    profile = (by_slopes if structure.withheld else profiled)(problem, point, sensitivity)
    point, widths = profile.point, _widths(problem, profile)
    if refined is not None:
        problem.predictor = refined
        point, _ = problem.settle(point, profile.sensitivity)
    return _judged(problem, point, profile.sensitivity, widths)


def _structure(problem: Problem, point: Array) -> Misfit:
    """Structure of the residuals at a point."""
    residuals = problem.split(-problem.differences(point))
    return misfit(problem.series, residuals, problem.noise_by_kind())


def _widths(problem: Problem, profile: Profiled) -> Array:
    """Distances to the ends of the intervals over standard errors by the slopes, (2, P)."""
    count = len(problem.parameters)
    covariance = problem.covariance(profile.point, profile.sensitivity)
    errors = np.sqrt(np.diag(covariance))[:count]
    return np.stack([profile.below, profile.above]) / errors


def _judged(problem: Problem, point: Array, sensitivity: Array, widths: Array) -> Estimate:
    """Estimate with its errors.

    Args:
        problem: at its final noise.
        point: of least cost.
        sensitivity: of the model.
        widths: see _widths.
    """
    count, free = len(problem.parameters), max(problem.count - problem.unknowns, 1)
    structure = _structure(problem, point)
    problem.inflation = structure.inflation
    covariance = problem.covariance(point, sensitivity)
    slopes = np.sqrt(np.diag(covariance))
    ends = widths * slopes[:count]
    quantile = float(stats.t.ppf(0.975, free))
    closed = np.isfinite(ends).all(axis=0) & (slopes[:count] < _OPEN)
    scale = np.where(closed, np.where(closed, widths, 0.0).mean(axis=0) / quantile, 1.0)
    logs = point[:count]
    with np.errstate(over="ignore"):
        low, high = np.exp(logs - ends[0]), np.exp(logs + ends[1])
    lost = np.nan if structure.withheld else 1.0
    zeros = dict(zip(problem.offsets, (point[count:] * problem.scale).tolist(), strict=True))
    unsure = dict(zip(problem.offsets, (slopes[count:] * problem.scale).tolist(), strict=True))
    differences = problem.differences(point)
    return Estimate(
        parameters=problem.parameters,
        value=np.exp(logs),
        error=slopes[:count] * scale,
        low=low * lost,
        high=high * lost,
        covariance=covariance[:count, :count],
        sensitivity=problem.jacobian(sensitivity)[:, :count],
        noise=problem.noise_by_kind(),
        offset=zeros,
        offset_error=unsure,
        series=problem.series,
        model=tuple(problem.split(problem.data + differences)),
        count=problem.count,
        misfit=structure,
    )
