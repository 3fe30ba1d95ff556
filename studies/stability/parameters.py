"""One parameter at a time, over its range, to see where it begins to change the distance."""

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from analytic import Surface
from analytic.friction.laws import friction_number
from analytic.scene import pneunet
from mjsim.results.measures import measure
from mjsim.results.record import reference as quasi_static
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate
from studies.accuracy import benchmark_cases
from studies.stability.maps import rounded

PARAMETERS = {  # name: least value, greatest, what it is called
    "ramp_time": (0.5, 32.0, "time of a ramp [s]"),
    "friction_number": (0.03, 30.0, "friction number Φ"),
    "contact_time": (0.3, 30.0, "contact time constant [time steps]"),
    "side_angle": (1e-4, 0.1, "side angle [rad]"),
    "damping_time": (3e-4, 0.3, "joint damping time [s]"),
    "impratio": (1.0, 3000.0, "impratio (Coulomb's law, 16 s per ramp)"),
}
_PLACES = 13
_CASE = {"constant": benchmark_cases.WALK, "coulomb": benchmark_cases.COULOMB}


def varied(parameter: str, value: float, ground: str) -> dict[str, Any]:
    """Walk the default gait with one parameter at a value.

    Returns:
        error: relative on displacement per cycle, signed; NaN where it failed.
        status: of the walk.
    """
    law = law_of(parameter)
    scene, numerics = scene_of(law, ground), Numerics().resolved("chain", law)
    if parameter == "ramp_time":
        scene = replace(scene, gait=replace(scene.gait, ramp_time=value))
    elif parameter == "friction_number":
        scene = replace(scene, ground=with_friction_number(scene, value))
        numerics = replace(numerics, tie_bound=value)
    else:
        change: dict[str, Any] = {parameter: value}
        numerics = replace(numerics, **change)
    walk = simulate(scene, numerics)
    numbers = measure(walk)
    if parameter == "friction_number":  # friction so strong bends the strip
        reference = float(quasi_static(walk).displacement[0])
    else:
        reference = benchmark_cases.exact(_CASE[law], ground)
    error = numbers.displacement / reference - 1 if numbers else math.nan
    return {"error": error, "status": str(walk.status)}


def variations(quick: bool = False) -> Iterator[tuple[str, float, str]]:
    """Every parameter on every ground; Coulomb's law leaves felt undecided."""
    for parameter, (low, high, _) in PARAMETERS.items():
        values = rounded(np.geomspace(low, high, 3 if quick else _PLACES))
        grounds = benchmark_cases.GROUNDS[_CASE[law_of(parameter)]]
        for value, ground in itertools.product(values, grounds):
            yield parameter, value, ground


def default(parameter: str) -> float:
    """Value of a parameter in the default walk."""
    law = law_of(parameter)
    scene, numerics = scene_of(law, "felt"), Numerics().resolved("chain", law)
    if parameter == "friction_number":
        return _friction_number(scene)
    if parameter == "ramp_time":
        return float(scene.gait.ramp_times[0])
    return float(getattr(numerics, parameter))


def law_of(parameter: str) -> str:
    """The friction law that a parameter belongs to."""
    return "coulomb" if parameter == "impratio" else "constant"


def scene_of(law: str, ground: str) -> Scene:
    """The benchmark scene under a law: with slow ramps under Coulomb friction.

    Creep of an anchor is then not inertia.
    """
    scene = benchmark_cases.scene_of(_CASE[law], ground)
    return scene if law == "coulomb" else replace(scene, gait=Scene.gait)


def with_friction_number(scene: Scene, number: float) -> Surface:
    """The scene's surface with friction bounds of a friction number Phi = V L^2 / D0."""
    surface, factor = scene.ground.at(0.0), number / _friction_number(scene)
    return replace(surface, tip_force=factor * surface.tip_force,
                   shear_strength=factor * surface.shear_strength)  # fmt: skip


def _friction_number(scene: Scene) -> float:
    return friction_number(scene.ground.at(0.0), scene.strip, pneunet.base_rigidity(scene.strip))
