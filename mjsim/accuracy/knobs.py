"""One knob at a time, over its range: where does it begin to change the distance?"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from analytic import SURFACES
from mjsim.accuracy import scenes
from mjsim.config import Scene, default_numerics
from mjsim.measures import measure
from mjsim.simulate import simulate

KNOBS = {  # name: least value, greatest, what it is called
    "leg_time": (0.5, 32.0, "time of a leg [s]"),
    "friction_number": (0.03, 30.0, "friction number Φ"),
    "contact_time": (0.3, 30.0, "contact time constant [time steps]"),
    "side_angle": (1e-4, 0.1, "side angle [rad]"),
    "damping_time": (3e-4, 0.3, "joint damping time [s]"),
    "impratio": (1.0, 3000.0, "impratio (Coulomb's law, 16 s a leg)"),
}
_PLACES = 13
_WORK = {"paper": scenes.WALK, "coulomb": scenes.COULOMB}


@dataclass(frozen=True)
class Turned:
    """The default walk with one knob at a value.

    Attributes:
        error: relative on displacement per cycle, signed; NaN where it failed.
        status: of the walk.
        versions, commit: of what it was found with.
    """

    knob: str
    value: float
    ground: str
    error: float = math.nan
    status: str = ""
    versions: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[str, float, str]:
        """What tells this walk from others."""
        return self.knob, self.value, self.ground

    def done(self) -> "Turned":
        """The same with what became of it."""
        law = law_of(self.knob)
        scene, numerics = scene_of(law, self.ground), default_numerics("planar", law)
        turned: dict[str, Any] = {self.knob: self.value}
        if self.knob == "leg_time":
            scene = replace(scene, gait=replace(scene.gait, leg_time=self.value))
        elif hasattr(scene, self.knob):
            scene = replace(scene, **turned)
        else:
            numerics = replace(numerics, **turned)
        walk = simulate(scene, numerics)
        found = measure(walk)
        reference = scenes.exact(_WORK[law], self.ground)
        error = found.displacement / reference - 1 if found else math.nan
        return replace(self, error=error, status=str(walk.status))


def turns(quick: bool = False) -> Iterator[Turned]:
    """Every knob on every ground; Coulomb's law leaves felt undecided."""
    for knob, (low, high, _) in KNOBS.items():
        for value in np.geomspace(low, high, 3 if quick else _PLACES):
            for ground in scenes.GROUNDS[_WORK[law_of(knob)]]:
                yield Turned(knob, float(f"{value:.4g}"), ground)


def law_of(knob: str) -> str:
    """The friction law that a knob belongs to."""
    return "coulomb" if knob == "impratio" else "paper"


def scene_of(law: str, ground: str) -> Scene:
    """The default scene under a law."""
    slow = law == "coulomb"  # so that what an anchor creeps is not inertia
    return scenes.scene_of(scenes.COULOMB, ground) if slow else Scene(surface=SURFACES[ground])
