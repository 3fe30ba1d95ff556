"""Quasi-static theory of robots of pneumatic limbs on ground with friction.

The source, cited throughout as [Majidi13] or the paper, with its equation numbers: C. Majidi,
R. F. Shepherd, R. K. Kramer, G. M. Whitesides and R. J. Wood, "Influence of surface traction on
soft robot undulation", Int. J. Robotics Research 32 (2013). SI units throughout; s is arclength
from the left end, y points up, and a positive displacement is towards the right ("forward").

Names are imported when they are first used: the solvers need scipy, plain data does not.
"""

from analytic.lazy import lazily

__getattr__, __dir__, __all__ = lazily(
    __name__,
    {
        "analytic.fitting.actuator": ("fit_actuator",),
        "analytic.fitting.bench": ("Bench",),
        "analytic.friction.laws": ("LAWS", "Friction", "TractionLaw"),
        "analytic.gradient.inputs": ("Derivative",),
        "analytic.locomotion": ("Direction", "Locomotion", "direction", "displacements"),
        "analytic.prediction": ("Prediction", "predict"),
        "analytic.scene.actuator": ("Actuator",),
        "analytic.scene.feet": ("Foot",),
        "analytic.scene.gait": ("GAITS", "Gait"),
        "analytic.scene.ground": ("Patches",),
        "analytic.scene.limbs": ("Limb", "LimbedRobot", "quadruped"),
        "analytic.scene.materials": ("MATERIALS",),
        "analytic.scene.payload": ("Payload",),
        "analytic.scene.quadruped_gaits": ("QUADRUPED_GAITS", "undulation"),
        "analytic.scene.robot": ("Robot",),
        "analytic.scene.surface": ("SURFACES", "Ground", "Surface"),
        "analytic.scene.tether": ("Tether",),
        "analytic.shapes": ("ContactShapes", "Mode", "Shapes", "Flag"),
        "analytic.solvers.elastica": ("solve_elastica",),
        "analytic.solvers.lifted": ("solve_lifted",),
        "analytic.solvers.models": ("REFERENCE", "SOLVERS", "Elastica", "Lifted", "Modes",
                                    "Obstacle", "Solver"),
        "analytic.solvers.modes": ("solve_modes",),
        "analytic.solvers.obstacle": ("solve_obstacle",),
    },
)  # fmt: skip
