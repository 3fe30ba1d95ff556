"""Real roots of many cubics at once, in closed form."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def real_cubic_roots(a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> Array:
    """Real roots of a x^3 + b x^2 + c x + d, a != 0, for coefficients of any one shape (...).

    Returns:
        Shape (..., 3); a lone real root comes first and NaN fills the rest. Roots carry the
        rounding of the closed form (Viete's, or Cardano's in hyperbolic form); polish where full
        precision matters.
    """
    a, b, c, d = (np.asarray(v, dtype=float) for v in np.broadcast_arrays(a, b, c, d))
    shift = b / (3 * a)
    p = c / a - 3 * shift**2
    q = 2 * shift**3 - shift * c / a + d / a
    discriminant = -4 * p**3 - 27 * q**2
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        # three real roots: x_k = 2 r cos(phi - 2 pi k / 3), r = sqrt(-p/3)
        r = np.sqrt(np.maximum(-p, 0) / 3)
        phi = np.arccos(np.clip(-0.5 * q / r**3, -1, 1)) / 3
        three = 2 * r[..., None] * np.cos(phi[..., None] - 2 * np.pi * np.arange(3) / 3)
        # one real root
        root = np.sqrt(np.abs(p) / 3)
        argument = 1.5 * np.abs(q) / (np.abs(p) * root)
        sign = -np.sign(q)
        below = 2 * sign * root * np.cosh(np.arccosh(np.maximum(argument, 1)) / 3)
        above = 2 * sign * root * np.sinh(np.arcsinh(argument) / 3)
        lone = np.where(p < 0, below, np.where(p > 0, above, np.cbrt(-q)))
    single = np.stack([lone, np.full_like(lone, np.nan), np.full_like(lone, np.nan)], axis=-1)
    return np.where((discriminant > 0)[..., None], three, single) - shift[..., None]
