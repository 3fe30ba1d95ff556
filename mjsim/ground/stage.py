"""The ground to stand on and to look at, with lights, cameras, ruler and the mark of the start."""

from pathlib import Path

import mujoco

from analytic.surface import Ground
from mjsim.io.assets import MODELS

HERE = Path(__file__).parent
LOOKS = HERE / "looks"


def stage(ground: Ground) -> mujoco.MjSpec:
    """The scene without the robot."""
    spec = mujoco.MjSpec.from_file(str(HERE / "stage.xml"))
    spec.texturedir = str(MODELS / "textures")
    look = mujoco.MjSpec.from_file(str(look_of(ground)))
    look.texturedir = str(MODELS / "textures")
    spec.attach(look, prefix="surface_", frame=spec.worldbody.add_frame())
    return spec


def look_of(ground: Ground) -> Path:
    """What the ground looks like: its own, or the nearest of the three named surfaces."""
    named = LOOKS / f"{ground.name}.xml"
    if named.is_file():
        return named
    surface = ground.at(0.0)
    side = surface.shear_strength or surface.friction
    tip = surface.tip_force or surface.tip_friction
    look = "gelatin" if not side else "felt" if not tip else "polyethylene"
    return LOOKS / f"{look}.xml"
