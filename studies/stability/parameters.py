"""One parameter at a time, over its range: where does it begin to change the distance?"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
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

PARAMETERS = {  # name: least value, greatest, what it is called
    "ramp_time": (0.5, 32.0, "time of a ramp [s]"),
    "friction_number": (0.03, 30.0, "friction number Φ"),
    "contact_time": (0.3, 30.0, "contact time constant [time steps]"),
    "side_angle": (1e-4, 0.1, "side angle [rad]"),
    "damping_time": (3e-4, 0.3, "joint damping time [s]"),
    "impratio": (1.0, 3000.0, "impratio (Coulomb's law, 16 s a ramp)"),
}
_PLACES = 13
_CASE = {"constant": benchmark_cases.WALK, "coulomb": benchmark_cases.COULOMB}


@dataclass(frozen=True)
class Varied:
    """The default walk with one parameter at a value.

    Attributes:
        error: relative on displacement per cycle, signed; NaN where it failed.
        status: of the walk.
        versions, commit: of what it was found with.
    """

    parameter: str
    value: float
    ground: str
    error: float = math.nan
    status: str = ""
    versions: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[str, float, str]:
        """What tells this walk from others."""
        return self.parameter, self.value, self.ground

    def done(self) -> "Varied":
        """The same with what became of it."""
        law = law_of(self.parameter)
        scene, numerics = scene_of(law, self.ground), Numerics().resolved("planar", law)
        varied: dict[str, Any] = {self.parameter: self.value}
        if self.parameter == "ramp_time":
            scene = replace(scene, gait=replace(scene.gait, ramp_time=self.value))
        elif self.parameter == "friction_number":
            scene = replace(scene, ground=as_strong(scene, self.value))
            numerics = replace(numerics, tie_bound=self.value)
        else:
            numerics = replace(numerics, **varied)
        walk = simulate(scene, numerics)
        numbers = measure(walk)
        if self.parameter == "friction_number":  # friction so strong bends the strip
            reference = float(quasi_static(walk).displacement[0])
        else:
            reference = benchmark_cases.exact(_CASE[law], self.ground)
        error = numbers.displacement / reference - 1 if numbers else math.nan
        return replace(self, error=error, status=str(walk.status))


def variations(quick: bool = False) -> Iterator[Varied]:
    """Every parameter on every ground; Coulomb's law leaves felt undecided."""
    for parameter, (low, high, _) in PARAMETERS.items():
        for value in np.geomspace(low, high, 3 if quick else _PLACES):
            for ground in benchmark_cases.GROUNDS[_CASE[law_of(parameter)]]:
                yield Varied(parameter, float(f"{value:.4g}"), ground)


def law_of(parameter: str) -> str:
    """The friction law that a parameter belongs to."""
    return "coulomb" if parameter == "impratio" else "constant"


def scene_of(law: str, ground: str) -> Scene:
    """The benchmark scene under a law: with slow ramps under Coulomb friction.

    What an anchor creeps there is then not inertia.
    """
    scene = benchmark_cases.scene_of(_CASE[law], ground)
    return scene if law == "coulomb" else replace(scene, gait=Scene.gait)


def as_strong(scene: Scene, number: float) -> Surface:
    """The scene's surface with bounds of a friction number Phi = V L^2 / D0."""
    surface = scene.ground.at(0.0)
    rigidity = pneunet.base_rigidity(scene.strip)
    factor = number / friction_number(surface, scene.strip, rigidity)
    return replace(surface, tip_force=factor * surface.tip_force,
                   shear_strength=factor * surface.shear_strength)  # fmt: skip
