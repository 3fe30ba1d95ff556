"""Compressed air that a gait takes: how much, and the work in it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene import pneunet
from analytic.scene.gait import Gait
from analytic.scene.limbs import AnyRobot, chambers_by_limb, limbs_of

ATMOSPHERE = 101_325.0  # Pa, what gauge pressures are counted from


class Air(NamedTuple):
    """Air and work that one cycle takes from the supply.

    Attributes:
        volume: as it is at atmospheric pressure [m^3].
        work: the least that compresses it, at constant temperature [J].
    """

    volume: float
    work: float


def air_per_cycle(robot: AnyRobot, gait: Gait) -> Air:
    """Air of chambers that are filled from a supply and vented to the atmosphere.

    A chamber has the volume (5) of [Majidi13] at its pressure and no moment; what a rise of
    pressure adds comes from the supply, and what a fall lets out is lost.
    """
    every = np.abs(robot.peak_pressure * np.array(gait.stages))
    taken, work = 0.0, 0.0
    for limb, part in zip(limbs_of(robot), chambers_by_limb(robot), strict=True):
        strip, pressure = limb.strip, every[:, part]
        volume = pneunet.filled_volume(strip, pressure) * strip.length * np.diff(strip.borders)
        taken += _rises((ATMOSPHERE + pressure) / ATMOSPHERE * volume)
        work += _rises((ATMOSPHERE + pressure) * volume * np.log1p(pressure / ATMOSPHERE))
    return Air(taken, work)


def _rises(values: NDArray[np.float64]) -> float:
    return float(np.maximum(np.diff(values, axis=0), 0.0).sum())
