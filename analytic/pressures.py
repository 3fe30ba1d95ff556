"""The check that every solver makes of its pressures."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.robot import SEGMENTS


def check_pressures(pressures_pa: ArrayLike) -> NDArray[np.float64]:
    """Pressures as an array of shape (B, 3) [Pa].

    Raises:
        ValueError: the shape is not (B, 3) or (3,), or a pressure is negative or not finite.
    """
    p = np.atleast_2d(np.asarray(pressures_pa, dtype=float))
    if p.ndim != 2 or p.shape[1] != SEGMENTS:
        raise ValueError(f"pressures_pa must have shape (B, 3), got {np.shape(pressures_pa)}")
    if not (np.isfinite(p) & (p >= 0)).all():
        raise ValueError(f"pressures must be finite and at least 0 Pa, got {p.min()} to {p.max()}")
    return p
