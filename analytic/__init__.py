"""Quasi-static theory of an undulating pneumatic strip on ground with friction.

Source of the theory, cited throughout as "the paper" with its equation numbers: C. Majidi,
R. F. Shepherd, R. K. Kramer, G. M. Whitesides and R. J. Wood, "Influence of surface traction on
soft robot undulation", Int. J. Robotics Research 32 (2013). SI units throughout; s is arclength
from the left end, y points up, and a positive displacement is towards the right ("forward").
"""

from analytic.elastica import solve_elastica
from analytic.equilibria import ContactShapes, Mode, Shapes, Status
from analytic.friction import SURFACES, Friction, Surface
from analytic.gait import GAITS, Gait
from analytic.locomotion import Direction, Locomotion, direction, locomotion
from analytic.modes import solve_modes
from analytic.obstacle import solve_obstacle
from analytic.prediction import REFERENCE, SOLVERS, Prediction, predict
from analytic.robot import Robot

__all__ = [
    "GAITS",
    "REFERENCE",
    "SOLVERS",
    "SURFACES",
    "ContactShapes",
    "Direction",
    "Friction",
    "Gait",
    "Locomotion",
    "Mode",
    "Prediction",
    "Robot",
    "Shapes",
    "Status",
    "Surface",
    "direction",
    "locomotion",
    "predict",
    "solve_elastica",
    "solve_modes",
    "solve_obstacle",
]
