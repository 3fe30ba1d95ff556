"""The ground to stand on and to look at, with lights, cameras, ruler and the mark of the start."""

from pathlib import Path

import mujoco

from analytic.scene.ground import Patches
from analytic.scene.surface import Ground, Surface
from mjsim.files.assets import MODELS

HERE = Path(__file__).parent
LOOKS = HERE / "looks"
_INF = float("inf")
_REACH = 1.0  # m; how far the outer ones of several patches are shown beyond seams; chosen


def stage(ground: Ground) -> mujoco.MjSpec:
    """The scene without the robot."""
    spec = mujoco.MjSpec.from_file(str(HERE / "stage.xml"))
    spec.texturedir = str(MODELS / "textures")
    extents = ground.extents() if isinstance(ground, Patches) else [(-_INF, _INF, ground.at(0.0))]
    borders = [end for _, end, _ in extents[:-1]]
    first, last = min([0.0, *borders]) - _REACH, max([0.0, *borders]) + _REACH
    for number, (begin, end, surface) in enumerate(extents):
        look = mujoco.MjSpec.from_file(str(look_of(surface)))
        look.texturedir = str(MODELS / "textures")
        if len(extents) > 1:
            _cut(look, max(begin, first), min(end, last), first=number == 0)
        prefix = f"surface{number + 1 if number else ''}_"
        spec.attach(look, prefix=prefix, frame=spec.worldbody.add_frame())
    return spec


def _cut(look: mujoco.MjSpec, begin: float, end: float, first: bool) -> None:
    """Show a surface between two places [m]; the plane of the first one carries the strip."""
    for name in ("floor", "slab"):
        geom = look.geom(name)
        geom.pos = (0.5 * (begin + end), geom.pos[1], geom.pos[2])
        geom.size = (0.5 * (end - begin), geom.size[1], geom.size[2])
        if name == "floor" and not first:
            geom.conaffinity = 0


def look_of(surface: Surface) -> Path:
    """File of the looks of a surface, or of the nearest of the three named ones."""
    named = LOOKS / f"{surface.name}.xml"
    if named.is_file():
        return named
    side = surface.shear_strength or surface.friction
    tip = surface.tip_force or surface.tip_friction
    look = "gelatin" if not side else "felt" if not tip else "polyethylene"
    return LOOKS / f"{look}.xml"
