"""Lift-off points of a strip with its left end flat on the ground (Appendix A, modes i to iii).

With the lifted part [xi, 1] and X = 1 - xi its length, the thirteenth condition y'(xi) = 0 reads

    F(X) = int_0^X v [-k + g v (X - v) / 2] dv = 0,

v measured from the right end: one scalar equation, a quartic in X on each segment. Dimensionless
as in analytic.solvers.modes.beam. The right end follows by mirror symmetry.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.solvers.modes.beam import EDGES, SEGMENTS, before
from analytic.solvers.modes.cubic import real_cubic_roots

Array = NDArray[np.float64]

_MAX_ITERATIONS = 100


class LiftOff(NamedTuple):
    """Attributes: xi, shape (B,), NaN without a root; roots, how many there are, shape (B,)."""

    xi: Array
    roots: NDArray[np.int_]


def lift_off(k: Array, g: Array) -> LiftOff:
    """Lift-off point nearest the left end, for k and g of shape (B, 3), where F(1) > 0.

    F > 0 says that the strip still wants to lie down, so the first root from the left end is the
    first point where it does not: the stable one with the least contact.
    """
    c0, c1, c2, c4 = _coefficients(k, g)
    low, high = EDGES[:-1], EDGES[1:]

    # F' is a depressed cubic, so its roots split each segment into intervals where F is monotone
    turning = real_cubic_roots(4 * c4, 0 * c4, 2 * c2, c1)
    inside = (turning > low[:, None]) & (turning < high[:, None])
    turning = np.sort(np.where(inside, turning, high[:, None]), axis=-1)
    segment = np.repeat(np.arange(SEGMENTS), 4)
    points = np.concatenate([np.broadcast_to(low, k.shape)[..., None], turning], axis=-1)
    points = points.reshape(len(k), len(segment))
    points = np.concatenate([points, np.ones((len(k), 1))], axis=1)
    segment = np.append(segment, SEGMENTS - 1)

    values = _quartic(points, c0[:, segment], c1[:, segment], c2[:, segment], c4[:, segment])
    values[:, 0] = values[:, 1]  # X = 0 is a root of no interest; start with the sign beside it
    crossing = (values[:, 1:] > 0) != (values[:, :-1] > 0)
    count = crossing.sum(axis=1)
    exists = count > 0
    nearest = crossing.shape[1] - 1 - np.argmax(crossing[:, ::-1], axis=1)
    rows = np.flatnonzero(exists)
    at = nearest[rows]
    piece = segment[at]
    roots = _bracketed_newton(
        points[rows, at], points[rows, at + 1], *(c[rows, piece] for c in (c0, c1, c2, c4))
    )
    xi = np.full(len(k), np.nan)
    xi[rows] = 1.0 - roots
    return LiftOff(xi, count)


def _coefficients(k: Array, g: Array) -> tuple[Array, Array, Array, Array]:
    """F = c0 + c1 X + c2 X^2 + c4 X^4 on [m/3, (m+1)/3], m counted from the right; each (B, 3)."""
    k, g = k[:, ::-1], g[:, ::-1]
    low = EDGES[:-1]
    square, cube, fourth = (np.diff(EDGES**n) for n in (2, 3, 4))
    passed = before(np.stack([-0.5 * k * square - g * fourth / 8, g * cube / 6]))
    c0 = passed[0] + 0.5 * k * low**2 + g * low**4 / 8
    c1 = passed[1] - g * low**3 / 6
    return c0, c1, -0.5 * k, g / 24


def _quartic(x: Array, c0: Array, c1: Array, c2: Array, c4: Array) -> Array:
    return c0 + x * (c1 + x * (c2 + x * x * c4))


def _bracketed_newton(low: Array, high: Array, c0: Array, c1: Array, c2: Array, c4: Array) -> Array:
    """Newton's method kept inside a shrinking bracket [low, high] with F(high) > 0 >= F(low)."""
    x = 0.5 * (low + high)
    for _ in range(_MAX_ITERATIONS):
        value = _quartic(x, c0, c1, c2, c4)
        high = np.where(value > 0, x, high)
        low = np.where(value > 0, low, x)
        slope = c1 + x * (2 * c2 + 4 * x * x * c4)
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = x - value / slope
        inside = (newton >= low) & (newton <= high)
        step = np.where(inside, newton, 0.5 * (low + high))
        change = np.abs(step - x)
        x = step
        if (change <= 4e-16).all():
            break
    return x
