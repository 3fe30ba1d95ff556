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
    from analytic.elastica import solve_elastica
    from analytic.equilibria import ContactShapes, Mode, Shapes, Status
    from analytic.friction import LAWS, Friction, TractionLaw
    from analytic.gait import GAITS, Gait
    from analytic.ground import Patches
    from analytic.lifted import solve_lifted
    from analytic.locomotion import Direction, Locomotion, direction, displacements
    from analytic.modes import solve_modes
    from analytic.obstacle import solve_obstacle
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
    from analytic.robot import Robot
    from analytic.surface import SURFACES, Ground, Surface

_HOMES = {
    "elastica": ("solve_elastica",),
    "equilibria": ("ContactShapes", "Mode", "Shapes", "Status"),
    "friction": ("LAWS", "Friction", "TractionLaw"),
    "gait": ("GAITS", "Gait"),
    "ground": ("Patches",),
    "locomotion": ("Direction", "Locomotion", "direction", "displacements"),
    "modes": ("solve_modes",),
    "obstacle": ("solve_obstacle",),
    "lifted": ("solve_lifted",),
    "prediction": ("REFERENCE", "SOLVERS", "Elastica", "Lifted", "Modes", "Obstacle", "Prediction",
                   "Solver", "predict"),
    "robot": ("Robot",),
    "surface": ("SURFACES", "Ground", "Surface"),
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
