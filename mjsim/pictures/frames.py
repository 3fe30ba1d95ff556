"""Frames of videos: their size, their rate, and when they are taken."""

import numpy as np
from numpy.typing import NDArray

Times = NDArray[np.float64]
Frame = NDArray[np.uint8]

WIDTH, HEIGHT, FPS = 1280, 720, 30
LEAD, TAIL = 0.5, 1.0  # s of stillness before and after the walk
_LONGEST = 10.0  # s of a video of a robot of limbs; slower walks are shown faster


def frame_times(last: float, faster: float = 1.0) -> Times:
    """Times in a walk that ends at `last` of a video's frames, so many times as fast, (F,) [s]."""
    return faster * np.arange(-LEAD, last / faster + TAIL, 1 / FPS)


def how_much_faster(last: float) -> float:
    """Times that a walk which ends at `last` [s] is shown faster than it was, to be short."""
    return max(1.0, float(np.ceil(last / _LONGEST)))
