"""Whether an equilibrium of the chain is one that lasts: the second variation of its energy."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky_banded, null_space

from analytic.solvers.elastica.state import ChainState, Grip

Array = NDArray[np.float64]

_PENALTY = 1e7  # stands for a rigid constraint


class Springs(Protocol):
    """What of a chain the test needs; see analytic.solvers.elastica.newton."""

    links: int
    length: Array
    hanging: Array
    clamped: bool

    def hinges(self, theta: Array) -> tuple[Array, Array]:
        """Stiffness and rest angle."""
        ...


def stable(chain: Springs, state: ChainState, grip: Grip | None) -> bool:
    """Whether the energy has a minimum here, on the nodes held: a penalised Hessian's test.

    If it has none while contacts were free to slide, those that stick are held along x too.
    """
    n = chain.links + 1
    cosine = chain.length * np.cos(state.theta)
    bend = np.zeros(n + 1)
    bend[1:-1] = chain.hinges(state.theta)[0]
    band = np.zeros((3, 2 * n + 1))  # upper, unknowns y_0, theta_0, y_1, ...
    band[2, 0::2] = _PENALTY * state.active
    band[2, 0:-1:2] += _PENALTY
    band[2, 2::2] += _PENALTY
    band[2, 1::2] = bend[:-1] + bend[1:] + state.shear * chain.length * np.sin(state.theta)
    band[2, 1::2] += (state.tension + chain.hanging) * cosine + _PENALTY * cosine**2
    band[2, 1] += _PENALTY * chain.clamped
    band[1, 1::2] = _PENALTY * cosine  # y_i, theta_i
    band[1, 2::2] = -_PENALTY * cosine  # theta_i, y_{i+1}
    band[0, 2::2] = -_PENALTY  # y_i, y_{i+1}
    band[0, 3::2] = -bend[1:-1]  # theta_i, theta_{i+1}
    try:
        cholesky_banded(band, check_finite=False)
    except np.linalg.LinAlgError:
        return grip is not None and _positive_where_held(band, grip.holds(state))
    return True


def _positive_where_held(band: Array, held: Array) -> bool:
    """Whether a matrix of upper bands is positive on the directions that the links' holds leave.

    Args:
        band: (3, M), unknowns y_0, theta_0, y_1, ...
        held: (H, number of links): what of their turns must vanish.
    """
    size = band.shape[1]
    if not len(held):
        return False
    matrix = np.diag(band[2])
    for off in (1, 2):
        part = np.diag(band[2 - off, off:], off)
        matrix += part + part.T
    rows = np.zeros((len(held), size))
    rows[:, 1::2] = held
    kept = null_space(rows)
    try:
        np.linalg.cholesky(kept.T @ matrix @ kept)
    except np.linalg.LinAlgError:
        return False
    return True
