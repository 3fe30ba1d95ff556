"""Stability of an equilibrium of the chain: the second variation of its energy."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.linalg.lapack import dpbtrf

from analytic.solvers.elastica.state import ChainState, GroundTraction

Array = NDArray[np.float64]

_PENALTY = 1e7  # stands for a rigid constraint


class Springs(Protocol):
    """Properties of a chain that the test needs; see analytic.solvers.elastica.newton."""

    links: int
    length: Array
    hanging: Array
    clamped: bool

    def hinges(self, theta: Array) -> tuple[Array, Array]:
        """Stiffness and rest angle."""
        ...


def stable(chain: Springs, state: ChainState, traction: GroundTraction | None) -> bool:
    """Tell whether the energy has a minimum, active nodes fixed: a penalised Hessian's test.

    If it has none while contacts were free to slide, those that stick are fixed along x too.
    """
    cosine = chain.length * np.cos(state.theta)
    stiffness = chain.hinges(state.theta)[0]
    band = np.zeros((3, 2 * len(cosine) + 1), order="F")  # upper, unknowns y_0, theta_0, y_1, ...
    band[2, 0::2] = _PENALTY * (2.0 + state.active)
    band[2, [0, -1]] -= _PENALTY
    turning = state.shear * chain.length * np.sin(state.theta)
    turning += (state.tension + chain.hanging + _PENALTY * cosine) * cosine
    turning[:-1] += stiffness
    turning[1:] += stiffness
    band[2, 1::2] = turning
    band[2, 1] += _PENALTY * chain.clamped
    band[1, 1::2] = _PENALTY * cosine  # y_i, theta_i
    band[1, 2::2] = -_PENALTY * cosine  # theta_i, y_{i+1}
    band[0, 2::2] = -_PENALTY  # y_i, y_{i+1}
    band[0, 3::2] = -stiffness  # theta_i, theta_{i+1}
    _, failed = dpbtrf(band)
    if failed:
        return traction is not None and _positive_under(traction.constraints(state), band)
    return True


def _positive_under(constraints: Array, band: Array) -> bool:
    """Tell whether a matrix of upper bands is positive on all directions that constraints allow.

    Args:
        constraints: sums of the links' turns that must vanish, (H, number of links).
        band: (3, M), unknowns y_0, theta_0, y_1, ...
    """
    size = band.shape[1]
    if not len(constraints):
        return False
    matrix = np.diag(band[2])
    for off in (1, 2):
        part = np.diag(band[2 - off, off:], off)
        matrix += part + part.T
    rows = np.zeros((len(constraints), size))
    rows[:, 1::2] = constraints
    allowed = null_space(rows)
    try:
        np.linalg.cholesky(allowed.T @ matrix @ allowed)
    except np.linalg.LinAlgError:
        return False
    return True
