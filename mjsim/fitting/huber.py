"""Huber's robust loss, and the errors of what is fitted by it (Huber, Robust Statistics, 7.6).

Residuals are over their noise; beyond a bend they count by their size and no longer by its square.
"""

import numpy as np
from numpy.typing import NDArray
from scipy import stats

Array = NDArray[np.float64]

BEND = 1.345  # deviations: 95 % as efficient as squares where errors are normal (Huber)
SPREAD = float(
    stats.norm.cdf(BEND) - stats.norm.cdf(-BEND) - 2 * BEND * stats.norm.pdf(BEND)
    + 2 * BEND**2 * stats.norm.sf(BEND)
)  # fmt: skip  # expected square of a bent normal residual
ENDLESS = 1e3  # error of the logarithm of a parameter that the data do not determine at all
_NOTHING = 1e-9  # deviations of the data for a unit of a logarithm, likewise
_LOST = 1e-5  # of the largest information: below it is an error of the sensitivities, 0.1 %


def loss(squares: Array, count: int) -> Array:
    """Loss of the data, the first `count` squares, and squares of the priors.

    Returns:
        Values and two derivatives, (3, n).
    """
    roots = np.sqrt(squares)
    far = roots > BEND
    far[count:] = False
    safe = np.where(far, roots, BEND)
    return np.stack([
        np.where(far, 2 * BEND * safe - BEND**2, squares),
        np.where(far, BEND / safe, 1.0),
        np.where(far, -0.5 * BEND / safe**3, 0.0),
    ])  # fmt: skip


def shares(data: Array, unknowns: int) -> tuple[float, float]:
    """Variance of bent residuals, and the part of the residuals that is not bent.

    Args:
        data: residuals over the noise at the fit, (n,).
        unknowns: number of what was fitted to them.
    """
    free = max(len(data) - unknowns, 1)
    inside = max(float(np.mean(np.abs(data) <= BEND)), 1 / len(data))
    return max(float(np.sum(np.clip(data, -BEND, BEND) ** 2)) / free, _NOTHING), inside


def inverse(information: Array) -> Array:
    """Inverse of a symmetric matrix, nearly infinite along directions that it does not determine.

    It stays so small that the errors of the other directions do not drown in its rounding.
    """
    scale = np.maximum(np.sqrt(np.diag(information)), _NOTHING)
    values, vectors = np.linalg.eigh(information / np.outer(scale, scale))
    directions = vectors / scale[:, None]
    endless = ENDLESS**2 / (directions**2).sum(axis=0)
    kept = values > _LOST
    variances = np.where(kept, 1 / np.where(kept, values, 1.0), endless)
    return np.asarray((directions * variances) @ directions.T)
