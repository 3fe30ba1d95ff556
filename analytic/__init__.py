"""Quasi-static theory of an undulating pneumatic strip on ground with friction.

The source, cited throughout as [Majidi13] or the paper, with its equation numbers: C. Majidi,
R. F. Shepherd, R. K. Kramer, G. M. Whitesides and R. J. Wood, "Influence of surface traction on
soft robot undulation", Int. J. Robotics Research 32 (2013). SI units throughout; s is arclength
from the left end, y points up, and a positive displacement is towards the right ("forward").

Names are imported when they are first used: the solvers need scipy, plain data does not.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from analytic.friction.laws import LAWS, Friction, TractionLaw
    from analytic.locomotion import Direction, Locomotion, direction, displacements
    from analytic.prediction import (
        REFERENCE,
        SOLVERS,
        Elastica,
        Lifted,
        Modes,
        Obstacle,
        Prediction,
        Solver,
        predict,
    )
    from analytic.scene.gait import GAITS, Gait
    from analytic.scene.ground import Patches
    from analytic.scene.robot import Robot
    from analytic.scene.surface import SURFACES, Ground, Surface
    from analytic.shapes import ContactShapes, Mode, Shapes, Status
    from analytic.solvers.elastica import solve_elastica
    from analytic.solvers.lifted import solve_lifted
    from analytic.solvers.modes import solve_modes
    from analytic.solvers.obstacle import solve_obstacle

_HOMES = {
    "solvers.elastica": ("solve_elastica",),
    "shapes": ("ContactShapes", "Mode", "Shapes", "Status"),
    "friction.laws": ("LAWS", "Friction", "TractionLaw"),
    "scene.gait": ("GAITS", "Gait"),
    "scene.ground": ("Patches",),
    "locomotion": ("Direction", "Locomotion", "direction", "displacements"),
    "solvers.modes": ("solve_modes",),
    "solvers.obstacle": ("solve_obstacle",),
    "solvers.lifted": ("solve_lifted",),
    "prediction": ("REFERENCE", "SOLVERS", "Elastica", "Lifted", "Modes", "Obstacle", "Prediction",
                   "Solver", "predict"),
    "scene.robot": ("Robot",),
    "scene.surface": ("SURFACES", "Ground", "Surface"),
}  # fmt: skip
_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}

__all__ = [
    "GAITS",
    "LAWS",
    "REFERENCE",
    "SOLVERS",
    "SURFACES",
    "ContactShapes",
    "Direction",
    "Elastica",
    "Friction",
    "Gait",
    "Ground",
    "Lifted",
    "Locomotion",
    "Mode",
    "Modes",
    "Obstacle",
    "Patches",
    "Prediction",
    "Robot",
    "Shapes",
    "Solver",
    "Status",
    "Surface",
    "TractionLaw",
    "direction",
    "displacements",
    "predict",
    "solve_elastica",
    "solve_lifted",
    "solve_modes",
    "solve_obstacle",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME_OF:
        raise AttributeError(f"module 'analytic' has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(f"analytic.{_HOME_OF[name]}"), name)
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
