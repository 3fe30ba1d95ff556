"""Whether a gait that was found keeps what it promises: finer, in MuJoCo, and off its mark."""

import itertools
import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from analytic.scene.gait import Gait
from analytic.scene.surface import Surface
from mjsim.optimising.objective import Objective
from mjsim.results.measures import measure
from mjsim.results.prediction import displacement, prediction
from mjsim.scene import Scene
from mjsim.simulation.checked import walk_checked

_PARTS = (0.9, 1.0, 1.1)  # of pressure and of either strength of the ground


class Confirmation(NamedTuple):
    """A gait on one surface; displacements per cycle over L, towards +x.

    Attributes:
        surface: it.
        searched: by the model of the search, what is sure alone.
        elastica: by the reference, which friction bends; NaN if it has none.
        mujoco: by MuJoCo, links and time step checked; NaN if it failed.
        status: of that walk.
        lowest, highest: by the model of the search with pressure and friction 10 % off.
    """

    surface: str
    searched: float
    elastica: float
    mujoco: float
    status: str
    lowest: float
    highest: float


def confirm(objective: Objective, gait: Gait, surface: Surface) -> Confirmation:
    """Predict a gait on a surface by everything there is.

    Args:
        objective: of the search; its model and its scene.
        gait, surface: to be confirmed.
    """
    scene = replace(objective.scene, gait=gait, ground=surface)
    towards = replace(objective, backward=objective.backward)
    sign = -1.0 if objective.backward else 1.0
    searched = sign * towards.sure(scene.strip, gait, [surface])[0]
    try:
        elastica = displacement(scene, prediction(scene))
    except ValueError:
        elastica = math.nan
    mujoco, status = _simulated(scene)
    off = [sign * shift for shift in _off_its_mark(objective, scene, surface)]
    return Confirmation(surface.name, searched, elastica, mujoco, status, min(off), max(off))


def _simulated(scene: Scene) -> tuple[float, str]:
    try:
        found = walk_checked(scene, 0.02)
    except ValueError as error:
        return math.nan, str(error)
    numbers = measure(found.walk)
    if numbers is None:
        return math.nan, str(found.walk.status)
    return numbers.displacement, str(found.walk.status) if found.agreed else "unconverged"


def _off_its_mark(objective: Objective, scene: Scene, surface: Surface) -> list[float]:
    """Sure displacements the right way with pressure, tip and side 10 % off, every combination."""
    grounds = [
        replace(surface, name=f"{surface.name}-off", tip_force=tip * surface.tip_force,
                shear_strength=side * surface.shear_strength)
        for tip, side in itertools.product(_PARTS, _PARTS)
    ]  # fmt: skip
    found: list[float] = []
    for part in _PARTS:
        robot = replace(scene.strip, peak_pressure=part * scene.strip.peak_pressure)
        found += objective.sure(robot, scene.gait, grounds)
    return [value if np.isfinite(value) else math.nan for value in found]
