"""A small-slope strip lifted between two supports, exactly, for a batch of states.

Everything here is dimensionless: lengths over L, curvature k = kappa L, load g = w L^3 / D. Both
ends of the lifted part [a, b] carry no moment (Appendix A), so it is statically determinate:

    y''(s) = -k(s) + g(s) (s - a)(b - s) / 2,    y(a) = y(b) = 0,

with k and g constant in each segment. Arching is positive k, hence the minus sign with y up. This
is the solution of Appendix A's balance (11) and its joint conditions, without a linear system.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.robot import THREE_EQUAL
from analytic.solvers.modes.cubic import real_cubic_roots

Array = NDArray[np.float64]

SEGMENTS = len(THREE_EQUAL)
EDGES = np.linspace(0.0, 1.0, SEGMENTS + 1)
_GAUSS_X, _GAUSS_W = np.polynomial.legendre.leggauss(4)  # exact to degree 7; (y')^2 has 6


class LiftedPart(NamedTuple):
    """Piecewise quartic of the lifted part; index j runs over the segments it crosses.

    Within piece j, with t = s - start: y = height + slope t + A t^2/2 + B t^3/6 + C t^4/12.

    Attributes:
        start, size: first point and length of each piece (length 0 off the lifted part), (B, 3).
        quadratic: A, B, C stacked, shape (3, B, 3).
        slope, height: y' and y at the start of each piece, shape (B, 3).
        slope_b: y' at b, shape (B,).
    """

    start: Array
    size: Array
    quadratic: Array
    slope: Array
    height: Array
    slope_b: Array


def lift(k: Array, g: Array, a: Array, b: Array) -> LiftedPart:
    """Shape of the strip lifted between a and b (b > a), for k, g of shape (B, 3), a, b (B,)."""
    start = np.clip(EDGES[:-1], a[:, None], b[:, None])
    size = np.clip(EDGES[1:], a[:, None], b[:, None]) - start
    from_a, to_b = start - a[:, None], b[:, None] - start
    quadratic = np.stack([-k + 0.5 * g * from_a * to_b, 0.5 * g * (to_b - from_a), -0.5 * g])
    bend, turn = _integrals(quadratic, size)  # of y'' over a piece: once and twice
    total_turn = (turn + bend * (to_b - size)).sum(axis=1)  # int_a^b (b - u) y'' du
    slope_a = -total_turn / (b - a)
    slope = slope_a[:, None] + before(bend)
    rise = slope * size + turn
    slope_b = slope_a + bend.sum(axis=1)
    return LiftedPart(start, size, quadratic, slope, before(rise), slope_b)


def _integrals(quadratic: Array, t: Array) -> tuple[Array, Array]:
    """First and second integral of A + B t + C t^2 from 0 to t."""
    a, b, c = quadratic
    return t * (a + t * (b / 2 + t * c / 3)), t * t * (a / 2 + t * (b / 6 + t * c / 12))


def before(parts: Array) -> Array:
    """Sum of the pieces before each piece, along the last axis."""
    sums = np.cumsum(parts, axis=-1)
    return np.concatenate([np.zeros_like(sums[..., :1]), sums[..., :-1]], axis=-1)


def shortening(lifted: LiftedPart, s: Array) -> Array:
    """Arclength less horizontal length from the left end to s, int_0^s (y')^2 / 2 (10).

    For material points s of shape (S,), returns shape (B, S).
    """
    size = np.clip(s - lifted.start[..., None], 0.0, lifted.size[..., None])
    quadratic = lifted.quadratic[..., None]
    total = np.zeros((len(lifted.slope_b), len(s)))
    for x, weight in zip(_GAUSS_X, _GAUSS_W, strict=True):
        slope = lifted.slope[..., None] + _integrals(quadratic, 0.5 * size * (1 + x))[0]
        total += (0.25 * weight * size * slope**2).sum(axis=1)
    return total


def extremes(lifted: LiftedPart) -> tuple[Array, Array]:
    """Least and greatest height over the lifted part, each of shape (B,)."""
    a, b, c = lifted.quadratic
    t = real_cubic_roots(c / 3, b / 2, a, lifted.slope)  # y' = 0
    inside = (t > 0) & (t < lifted.size[..., None])
    turning = _height(lifted, np.where(inside, t, 0.0)).reshape(len(lifted.slope_b), -1)
    return np.minimum(turning.min(axis=1), 0.0), np.maximum(turning.max(axis=1), 0.0)


def heights(lifted: LiftedPart, s: Array) -> Array:
    """Height at material points s of shape (S,), 0 off the lifted part, shape (B, S)."""
    t = s - lifted.start[..., None]
    inside = (t >= 0) & (t < lifted.size[..., None])
    return np.where(inside, _height(lifted, t), 0.0).sum(axis=1)


def _height(lifted: LiftedPart, t: Array) -> Array:
    """Height at t of each piece, both of shape (B, 3, T)."""
    turn = _integrals(lifted.quadratic[..., None], t)[1]
    return np.asarray(lifted.height[..., None] + lifted.slope[..., None] * t + turn)
