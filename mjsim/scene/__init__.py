"""Scenes and their numerics; needs no MuJoCo."""

from mjsim.scene.numerics import CONES, INTEGRATORS, Numerics, Resolved
from mjsim.scene.scene import ACTUATIONS, Scene, resolved
from mjsim.scene.valves import Valves

__all__ = [
    "ACTUATIONS",
    "CONES",
    "INTEGRATORS",
    "Numerics",
    "Resolved",
    "Scene",
    "Valves",
    "resolved",
]
