"""Compressed air that a gait takes: how much, and the work in it."""

from typing import NamedTuple

import numpy as np

from analytic.scene import pneunet
from analytic.scene.gait import Gait
from analytic.scene.robot import Robot

ATMOSPHERE = 101_325.0  # Pa, what gauge pressures are counted from


class Air(NamedTuple):
    """Air that one cycle takes from the supply.

    Attributes:
        volume: as it is at atmospheric pressure [m^3].
        work: the least that compresses it, at constant temperature [J].
    """

    volume: float
    work: float


def air_per_cycle(robot: Robot, gait: Gait) -> Air:
    """Air of chambers that are filled from a supply and vented to the atmosphere.

    A chamber has the volume (5) of [Majidi13] at its pressure and no moment; what a rise of
    pressure adds comes from the supply, and what a fall lets out is lost.
    """
    pressure = np.abs(robot.peak_pressure * np.array(gait.stages))
    lengths = robot.length * np.diff(robot.borders)
    volume = pneunet.filled_volume(robot, pressure) * lengths
    inside = (ATMOSPHERE + pressure) / ATMOSPHERE * volume
    work = (ATMOSPHERE + pressure) * volume * np.log1p(pressure / ATMOSPHERE)
    rises = (np.maximum(np.diff(part, axis=0), 0.0).sum() for part in (inside, work))
    return Air(*(float(rise) for rise in rises))
