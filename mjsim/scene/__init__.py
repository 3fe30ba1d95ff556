"""What is simulated (Scene) and how (Numerics); needs no MuJoCo."""

from mjsim.scene.numerics import CONES, INTEGRATORS, Numerics
from mjsim.scene.scene import ACTUATIONS, Scene

__all__ = ["ACTUATIONS", "CONES", "INTEGRATORS", "Numerics", "Scene"]
