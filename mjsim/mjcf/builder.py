"""The robot on its surface as MJCF, assembled with dm_control's mjcf and compiled by mujoco.

The bodies differ in how the strip is made (mjsim.bodies.planar, mjsim.bodies.cable, mjsim.bodies.rod); stage, surface,
contact pads and friction are alike. Under the constant-bound law friction is a bound on the x motion of
the two ends, carried by spatial tendons to a far fixed site: `left` and `right` along each end, and
`both` along their mean; see mjsim.friction.laws. Under Coulomb's it is MuJoCo's own contact friction.
"""

import re
from types import ModuleType
from typing import Any

import mujoco
from dm_control import mjcf

from mjsim.bodies import cable, planar, rod
from mjsim.bodies.parts import DIGITS, rounded, template
from mjsim.io.assets import MODELS
from mjsim.scene import Numerics, Scene

BODY_MODULES: dict[str, ModuleType] = {"planar": planar, "cable": cable, "rod": rod}


def robot_mjcf(scene: Scene, numerics: Numerics, skin: bool = True) -> mjcf.RootElement:
    """The strip alone, flat along +x, its left end at the origin of its neutral line."""
    root: mjcf.RootElement = BODY_MODULES[scene.body].strip(scene, numerics)
    if skin and scene.body == "planar":
        planar.add_skins(root, scene, numerics)
    return root


def scene_mjcf(scene: Scene, numerics: Numerics, skin: bool = True) -> mjcf.RootElement:
    """The strip on its surface, with lights, cameras and ruler; with its skin if it has one."""
    root = template("stage.xml", scene, numerics)
    root.model = scene.surface.name
    for name in ("tip", "area"):
        root.custom.add("numeric", name=name, data=(getattr(scene.surface, name),))
    root.custom.add("numeric", name="force_scale", data=(rounded(scene.force_scale),))
    surface = mjcf.from_path(str(_surface_file(scene)))
    surface.model = "surface"
    root.worldbody.add("site", name="ground", size=(1e-4,), group=4).attach(surface)
    start = root.worldbody.add("site", name="start_of_strip", pos=(0, 0, numerics.pad_radius),
                               size=(1e-4,), group=4)  # fmt: skip
    start.attach(robot_mjcf(scene, numerics, skin))
    return root


def to_xml(root: mjcf.RootElement) -> str:
    """MJCF text whose file references are those of the models folder."""
    text = root.to_xml_string(precision=DIGITS)
    text = re.sub(r'(file="\w+)-[0-9a-f]{40}(\.\w+")', r"\1\2", text)
    return text.replace("<compiler ", '<compiler texturedir="textures" ', 1)


def compile_model(scene: Scene, numerics: Numerics, skin: bool = False) -> mujoco.MjModel:
    """The compiled model of a scene, with a skin to look at if asked.

    Raises:
        ValueError: mujoco refuses the model.
    """
    root = scene_mjcf(scene, numerics, skin)
    text, assets = root.to_xml_string(precision=17), root.get_assets()
    if scene.body == "planar":
        return mujoco.MjModel.from_xml_string(text, assets)
    spec = mujoco.MjSpec.from_string(text, assets=assets)  # composites and flexcomps are expanded
    BODY_MODULES[scene.body].complete(spec, scene, numerics)
    return spec.compile()


def _surface_file(scene: Scene) -> Any:
    """The ground to look at: the surface's own, or for any other pair the nearest of the three."""
    named = MODELS / "surfaces" / f"{scene.surface.name}.xml"
    if named.is_file():
        return named
    look = "gelatin" if scene.surface.area == 0 else "felt" if scene.surface.tip == 0 else None
    return MODELS / "surfaces" / f"{look or 'polyethylene'}.xml"
