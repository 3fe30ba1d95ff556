"""Frames of videos: their size, their rate, and when they are taken."""

import numpy as np
from numpy.typing import NDArray

Times = NDArray[np.float64]
Frame = NDArray[np.uint8]

WIDTH, HEIGHT, FPS = 1280, 720, 30
LEAD, TAIL = 0.5, 1.0  # s of stillness before and after the walk
_LONGEST = 10.0  # s of a walk in a video; slower walks are shown faster


def frame_times(end: float, faster: float = 1.0) -> Times:
    """Times [s] of the frames, (F,), of a walk that ends at a time, so many times as fast."""
    return faster * np.arange(-LEAD, end / faster + TAIL, 1 / FPS)


def how_much_faster(end: float) -> float:
    """Speed of the video over that of a walk which ends at a time [s], so that it is short."""
    return max(1.0, float(np.ceil(end / _LONGEST)))
