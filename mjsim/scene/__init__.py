"""What is simulated (Scene) and how (Numerics); needs no MuJoCo."""

from mjsim.scene.numerics import CONES, INTEGRATORS, Numerics
from mjsim.scene.scene import ACTUATIONS, Scene
from mjsim.scene.valves import Valves

__all__ = ["ACTUATIONS", "CONES", "INTEGRATORS", "Numerics", "Scene", "Valves"]
