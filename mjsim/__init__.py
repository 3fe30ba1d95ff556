"""MuJoCo model of an undulating pneumatic strip, checked against `analytic`.

What a user needs, imported when it is first used:

    from mjsim import SURFACES, Scene, measure, predict, simulate

    scene = Scene(ground=SURFACES["gelatin"])
    walk = simulate(scene)
    print(walk.status, measure(walk).displacement)
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from analytic.friction.laws import Friction
    from analytic.prediction import predict
    from analytic.scene.gait import GAITS, Gait
    from analytic.scene.ground import Patches
    from analytic.scene.robot import Robot
    from analytic.scene.surface import SURFACES, Ground, Surface
    from mjsim.results.measures import Measures, measure
    from mjsim.results.status import Status
    from mjsim.results.trajectory import Trajectory, load
    from mjsim.scene import Numerics, Scene
    from mjsim.simulation.batch import rollout, simulate_all
    from mjsim.simulation.simulation import Observation, Policy, Simulation, simulate

_HOMES = {
    "analytic.friction.laws": ("Friction",),
    "analytic.scene.gait": ("GAITS", "Gait"),
    "analytic.scene.ground": ("Patches",),
    "analytic.prediction": ("predict",),
    "analytic.scene.robot": ("Robot",),
    "analytic.scene.surface": ("SURFACES", "Ground", "Surface"),
    "mjsim.scene": ("Numerics", "Scene"),
    "mjsim.simulation.batch": ("rollout", "simulate_all"),
    "mjsim.results.measures": ("Measures", "measure"),
    "mjsim.simulation.simulation": ("Observation", "Policy", "Simulation", "simulate"),
    "mjsim.results.status": ("Status",),
    "mjsim.results.trajectory": ("Trajectory", "load"),
}
_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}

__all__ = [
    "GAITS",
    "SURFACES",
    "Friction",
    "Gait",
    "Ground",
    "Measures",
    "Numerics",
    "Observation",
    "Patches",
    "Policy",
    "Robot",
    "Scene",
    "Simulation",
    "Status",
    "Surface",
    "Trajectory",
    "load",
    "measure",
    "predict",
    "rollout",
    "simulate",
    "simulate_all",
]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("undulator")
    if name not in _HOME_OF:
        raise AttributeError(f"module 'mjsim' has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(_HOME_OF[name]), name)
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
