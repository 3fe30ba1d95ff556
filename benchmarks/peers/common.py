"""Parts that the peers' runners share: cases, rest angles at the gait's knots, the stopwatch."""

from typing import NamedTuple

import numpy as np

from mjsim.scene import Scene
from studies.accuracy.heavy_cantilever import DAMPING, DURATION, strip
from studies.accuracy.timing import Spent, repeated, stopwatch

__all__ = ["DAMPING", "DURATION", "GRAVITY", "Walked", "heavy_links", "knots", "repeated",
           "stopwatch", "strip"]  # fmt: skip

GRAVITY = Scene().gravity  # m/s^2


class Walked(NamedTuple):
    """Displacement per cycle and greatest height of an end, over L; NaN where it diverged."""

    displacement: float
    height: float
    spent: Spent


def heavy_links(links):
    """Length of a link of the heavy strip, the first of which is centred on the wall."""
    return strip().length / (links - 0.5)


def knots(scene, rest):
    """Times at which a ramp begins or ends, from the start of the run on, and rest(pressures)."""
    ends = np.arange(scene.gait.ramps + 1) * scene.gait.ramp_times[0]
    times = np.concatenate([[0.0], scene.settle_time + ends])
    stages = np.array([scene.gait.stages[0], *scene.gait.stages])
    return times, rest(scene.robot.peak_pressure * stages)
