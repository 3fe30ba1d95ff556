"""One parameter at a time, over its range: where does it begin to change the distance?"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from analytic import SURFACES
from mjsim.scene import Scene, default_numerics
from mjsim.simulation.measures import measure
from mjsim.simulation.simulation import simulate
from mjsim.studies.accuracy import benchmark_cases

PARAMETERS = {  # name: least value, greatest, what it is called
    "ramp_time": (0.5, 32.0, "time of a ramp [s]"),
    "friction_number": (0.03, 30.0, "friction number Φ"),
    "contact_time": (0.3, 30.0, "contact time constant [time steps]"),
    "side_angle": (1e-4, 0.1, "side angle [rad]"),
    "damping_time": (3e-4, 0.3, "joint damping time [s]"),
    "impratio": (1.0, 3000.0, "impratio (Coulomb's law, 16 s a ramp)"),
}
_PLACES = 13
_WORK = {"constant": benchmark_cases.WALK, "coulomb": benchmark_cases.COULOMB}


@dataclass(frozen=True)
class Turned:
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

    def done(self) -> "Turned":
        """The same with what became of it."""
        law = law_of(self.parameter)
        scene, numerics = scene_of(law, self.ground), default_numerics("planar", law)
        turned: dict[str, Any] = {self.parameter: self.value}
        if self.parameter == "ramp_time":
            scene = replace(scene, gait=replace(scene.gait, ramp_time=self.value))
        elif hasattr(scene, self.parameter):
            scene = replace(scene, **turned)
        else:
            numerics = replace(numerics, **turned)
        walk = simulate(scene, numerics)
        found = measure(walk)
        reference = benchmark_cases.exact(_WORK[law], self.ground)
        error = found.displacement / reference - 1 if found else math.nan
        return replace(self, error=error, status=str(walk.status))


def turns(quick: bool = False) -> Iterator[Turned]:
    """Every parameter on every ground; Coulomb's law leaves felt undecided."""
    for parameter, (low, high, _) in PARAMETERS.items():
        for value in np.geomspace(low, high, 3 if quick else _PLACES):
            for ground in benchmark_cases.GROUNDS[_WORK[law_of(parameter)]]:
                yield Turned(parameter, float(f"{value:.4g}"), ground)


def law_of(parameter: str) -> str:
    """The friction law that a parameter belongs to."""
    return "coulomb" if parameter == "impratio" else "constant"


def scene_of(law: str, ground: str) -> Scene:
    """The default scene under a law."""
    slow = law == "coulomb"  # so that what an anchor creeps is not inertia
    return (
        benchmark_cases.scene_of(benchmark_cases.COULOMB, ground)
        if slow
        else Scene(surface=SURFACES[ground])
    )
