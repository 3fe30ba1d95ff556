"""Statements of the residuals of a fit about its model: errors that are alike are not noise alone.

Least squares takes errors as independent. Where neighbours are alike, n numbers tell as much as
n / (1 + 2 (r_1 + r_2 + ...)), with r_k the correlation of residuals k apart (Bayley and Hammersley
1946), and intervals grow by the root of that. Where few such pieces are left, the residuals bend
as slowly as the model does; then the parameters have taken up an unknown part of the misfit, and no
interval can be given.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mjsim.fitting.observations import RUN, Series

Array = NDArray[np.float64]

_CHANCE = 0.005  # with which independent errors are called alike, of all orders together; chosen
_SHUFFLES, _SEED = 4000, 1946
_FEW = 4  # residuals of a series, fewer have no order
_SMALL = 60  # residuals up to which the chance is counted by shuffles; chosen
_PIECES = 30.0  # independent ones that a series must be worth; chosen
_EXACT = 1e-4  # of the data's range: residuals below it are of the numerics; chosen
_CLIP = 3.0  # deviations to which outliers are cut


class Misfit(NamedTuple):
    """Structure of the residuals.

    Attributes:
        correlation: of neighbouring residuals, that of the series and order in which it is largest.
        inflation: factor on the variance of what is fitted, at least 1.
        withheld: True if the model misses so much that no interval holds.
    """

    correlation: float
    inflation: float
    withheld: bool


def misfit(series: Sequence[Series], residuals: Sequence[Array], noise: dict[str, float]) -> Misfit:
    """Structure of residuals along time, pressure, the rows of a file, or the size of the runs.

    Args:
        series: measurements.
        residuals: data less model of each.
        noise: of each kind, in the unit of the residuals.
    """
    ordered = []
    for each, residual in zip(series, residuals, strict=True):
        deviations = np.clip(residual / noise[each.noise], -_CLIP, _CLIP)
        if noise[each.noise] < _EXACT * float(np.ptp(each.value) or 1.0):
            continue
        along = each.value - residual if each.abscissa == RUN else each.at
        for order in {tuple(np.argsort(along, kind="stable").tolist()),
                      tuple(range(len(residual)))}:  # fmt: skip
            if len(order) >= _FEW:
                ordered.append(deviations[list(order)])
    largest, inflation, withheld = 0.0, 1.0, False
    for deviations in ordered:
        neighbours = _correlation(deviations, 1)
        largest = max(largest, neighbours)
        if _chance(deviations, neighbours) > _CHANCE / len(ordered):
            continue
        factor = _inflation(deviations)
        inflation = max(inflation, factor)
        withheld = withheld or len(deviations) < _PIECES * factor
    return Misfit(largest, inflation, withheld)


def _correlation(deviations: Array, apart: int) -> float:
    squares = float(deviations @ deviations)
    return float(deviations[apart:] @ deviations[:-apart]) / squares if squares else 0.0


def _chance(deviations: Array, neighbours: float) -> float:
    """Probability that errors without order are as alike."""
    count = len(deviations)
    if count > _SMALL:
        return 0.5 * math.erfc(neighbours * math.sqrt(count / 2))
    shuffled = np.random.default_rng(_SEED).permuted(np.tile(deviations, (_SHUFFLES, 1)), axis=1)
    alike = (shuffled[:, 1:] * shuffled[:, :-1]).sum(axis=1)
    return float(1 + np.sum(alike >= deviations[1:] @ deviations[:-1])) / (1 + _SHUFFLES)


def _inflation(deviations: Array) -> float:
    """1 + 2 (r_1 + r_2 + ...), by pairs up to the first whose sum is not positive (Geyer 1992)."""
    count, total = len(deviations), -1.0
    for apart in range(0, count // 2, 2):
        pair = (_correlation(deviations, apart) if apart else 1.0) + _correlation(
            deviations, apart + 1
        )
        if pair <= 0:
            break
        total += 2 * pair
    return max(total, 1.0)
