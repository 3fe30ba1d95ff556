"""Confirmation of a gait by finer models, by MuJoCo, and with pressure and friction 10 % off."""

import itertools
import math
from dataclasses import replace
from typing import Any, NamedTuple

from analytic.scene.gait import Gait
from analytic.scene.surface import Surface
from mjsim.optimising.objective import Objective
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.scene import Numerics, Scene
from mjsim.scene.scene import Contacts
from mjsim.simulation.checked import walk_checked

_PARTS = (0.9, 1.0, 1.1)  # of pressure and of either strength of the ground


class Confirmation(NamedTuple):
    """A gait on one surface, friction at some contacts; displacements per cycle over L, to +x.

    Attributes:
        surface: name of the surface.
        contacts: where friction acts, see mjsim.scene.Scene.
        searched: by the model of the search, less the change that rests on flagged states.
        reference: by the quasi-static reference, which friction bends; NaN if it has none.
        mujoco: by MuJoCo, links and time step checked; NaN if it failed.
        status: of the walk in MuJoCo.
        lowest, highest: by the model of the search with pressure and friction 10 % off.
    """

    surface: str
    contacts: Contacts
    searched: float
    reference: float
    mujoco: float
    status: str
    lowest: float
    highest: float


def confirm(objective: Objective, gait: Gait, surface: Surface, contacts: Contacts) -> Confirmation:
    """Predict a gait on a surface by all models.

    Args:
        objective: of the search, with its model and its scene.
        gait, surface, contacts: to be confirmed.
    """
    scene = replace(objective.scene, gait=gait, ground=surface, contacts=contacts)
    searched = objective.sign * objective.sure_at(contacts, scene.robot, gait, [surface])[0]
    try:
        predicted = float(reference(scene, objective.numerics).displacement[0])
    except ValueError:
        predicted = math.nan
    mujoco, status = _simulated(scene, objective.numerics)
    off = [objective.sign * shift for shift in _perturbed(objective, scene, surface)]
    return Confirmation(
        surface.name, contacts, searched, predicted, mujoco, status, min(off), max(off)
    )


def _simulated(scene: Scene, given: Numerics | None) -> tuple[float, str]:
    try:
        check = walk_checked(scene, 0.02, twists=given.twists if given else None)
    except ValueError as error:
        return math.nan, str(error)
    numbers = measure(check.walk)
    if numbers is None:
        return math.nan, str(check.walk.status)
    return numbers.displacement, str(check.walk.status) if check.agreed else "unconverged"


def _perturbed(objective: Objective, scene: Scene, surface: Surface) -> list[float]:
    """Sure displacements the right way with pressure, tip and side 10 % off, all combinations."""
    grounds = [
        replace(surface, name=f"{surface.name}-off", **_times(surface, "tip_force", tip),
                **_times(surface, "shear_strength", side))
        for tip, side in itertools.product(_PARTS, _PARTS)
    ]  # fmt: skip
    shifts: list[float] = []
    for part in _PARTS:
        robot = replace(scene.robot, peak_pressure=part * scene.robot.peak_pressure)
        shifts += objective.sure_at(scene.contacts, robot, scene.gait, grounds)
    return [shift if math.isfinite(shift) else math.nan for shift in shifts]


def _times(surface: Surface, name: str, factor: float) -> dict[str, Any]:
    """Fields of a surface of how it resists, all ways, by a factor."""
    given = {f"{name}{way}": getattr(surface, f"{name}{way}") for way in ("", "_back", "_across")}
    return {key: factor * value for key, value in given.items() if value is not None}
