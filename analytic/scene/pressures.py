"""The check that every solver makes of its pressures."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene.robot import Robot


def check_pressures(
    robot: Robot, pressures_pa: ArrayLike, both_ways: bool = False
) -> NDArray[np.float64]:
    """Pressures as an array of shape (B, S) [Pa], S being the number of the robot's segments.

    Args:
        robot: the strip.
        pressures_pa: of its segments, (B, S) or (S,) [Pa].
        both_ways: whether it may be on a segment's other face, below 0.

    Raises:
        ValueError: the shape is not (B, S) or (S,), or a pressure is not finite or, unless it may
            be, negative.
    """
    p = np.atleast_2d(np.asarray(pressures_pa, dtype=float))
    count = len(robot.segments)
    if p.ndim != 2 or p.shape[1] != count:
        raise ValueError(f"pressures_pa must have shape (B, {count}), got {np.shape(pressures_pa)}")
    if not np.isfinite(p).all() or (not both_ways and (p < 0).any()):
        raise ValueError(f"pressures must be finite and at least 0 Pa, got {p.min()} to {p.max()}")
    return p
