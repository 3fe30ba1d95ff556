"""Solutions of the equations of balance, whose matrix is banded but for its last two unknowns."""

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_banded

Array = NDArray[np.float64]

_BANDS = 3  # on either side, see analytic.solvers.elastica.newton
_BORDER = 2


@cache
def _order(size: int) -> NDArray[np.int_]:
    """Places of y_0, theta_0, V_0, y_1, ... among all y, all theta and all V."""
    links = (size - 1) // 3
    triples = np.arange(links)[:, None] + [0, links + 1, 2 * links + 1]
    return np.append(triples.ravel(), links)


def solve_bordered(matrix: Array, right: Array) -> Array:
    """Solution of a system by block elimination.

    Args:
        matrix: of unknowns as in analytic.gradient.equilibrium, or transposed, (M, M).
        right: right sides, (M,) or (M, K).

    Raises:
        LinAlgError: it has none.
    """
    size = len(matrix) - _BORDER
    order = _order(size)
    sides = right.reshape(len(matrix), -1)
    inner = matrix[np.ix_(order, order)]
    band = np.zeros((2 * _BANDS + 1, size))
    for off in range(-_BANDS, _BANDS + 1):
        diagonal = np.diagonal(inner, off)
        begin = max(off, 0)
        band[_BANDS - off, begin : begin + len(diagonal)] = diagonal
    both = np.concatenate([sides[order], matrix[order, size:]], axis=1)
    columns = solve_banded((_BANDS, _BANDS), band, both, check_finite=False)
    count = sides.shape[1]
    below = matrix[size:, order]
    reduced = matrix[size:, size:] - below @ columns[:, count:]
    border = np.linalg.solve(reduced, sides[size:] - below @ columns[:, :count])
    result = np.zeros_like(sides, dtype=float)
    result[order] = columns[:, :count] - columns[:, count:] @ border
    result[size:] = border
    return result.reshape(right.shape)
