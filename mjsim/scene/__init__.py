"""What is simulated (Scene) and how (Numerics)."""

from mjsim.scene.scene import (
    ACTUATIONS,
    BODIES,
    CONES,
    INTEGRATORS,
    Numerics,
    Scene,
    check,
    default_numerics,
)

__all__ = [
    "ACTUATIONS",
    "BODIES",
    "CONES",
    "INTEGRATORS",
    "Numerics",
    "Scene",
    "check",
    "default_numerics",
]
