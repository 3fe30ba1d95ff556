"""The robots of this folder in a scene of one's own, in plain MuJoCo: one call.

    scene = mujoco.MjSpec.from_file("arena.xml")
    attach(scene, "models/gelatin.xml", pos=(0.2, 0, 0))
    model = scene.compile()

The robot comes alone: floor, ruler, lights and camera of its file stay behind. The scene takes the
time step, integrator, cone, impratio and flags of the file, without which its friction does not act
as it should, and keeps gravity and all else. Needs mujoco from 3.13 on.

In dm_control, whose arenas are no MjSpec:

    arena = composer.Arena()
    attach_to_arena(arena.mjcf_model, "models/gelatin.xml")

On a height field nothing falls through, but it pushes a pad at several points, and distances are
not those on a plane.
"""

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import mujoco

OPTIONS = ("timestep", "integrator", "cone", "impratio")  # and flags, see attach
PAD_RADIUS = 1e-3  # m; smaller pads fall through a height field


def robot(file: str | Path) -> mujoco.MjSpec:
    """The robot of a file, with its tendons, actuators and sensors, and nothing around it.

    Its pads have a radius of at least PAD_RADIUS; their lowest points stay where they are.
    """
    spec = mujoco.MjSpec.from_file(str(file))
    world = spec.worldbody
    for item in (*world.geoms, *world.lights, *world.cameras, *spec.keys, *spec.materials,
                 *spec.textures):  # fmt: skip
        spec.delete(item)
    for geom in spec.geoms:
        if geom.type == mujoco.mjtGeom.mjGEOM_SPHERE and 0 < geom.size[0] < PAD_RADIUS:
            geom.pos[2] += PAD_RADIUS - geom.size[0]
            geom.size[0] = PAD_RADIUS
    return spec


def attach(
    scene: mujoco.MjSpec, file: str | Path, pos: Sequence[float] = (0.0, 0.0, 0.0),
    quat: Sequence[float] = (1.0, 0.0, 0.0, 0.0), prefix: str = "",
) -> mujoco.MjsFrame:  # fmt: skip
    """Put the robot of a file into a scene, and give the scene the options that it needs.

    Args:
        scene: where it goes; something in it must be there to stand on.
        file: one of this folder, or of `undulator export`.
        pos: of its left end, or of its trunk's beginning, on the ground [m].
        quat: of its frame, whose z is up from the ground.
        prefix: of all its names, which differ from those of another robot by it.

    Returns:
        The frame that it is in.
    """
    child = robot(file)
    for name in OPTIONS:
        setattr(scene.option, name, getattr(child.option, name))
    scene.option.disableflags |= child.option.disableflags
    child.visual.map.znear, child.visual.map.zfar = scene.visual.map.znear, scene.visual.map.zfar
    child.nkey = scene.nkey  # what is unlike would be warned of
    frame = scene.worldbody.add_frame(pos=pos, quat=quat)
    scene.attach(child, prefix=prefix, frame=frame)
    return frame


def attach_to_arena(
    arena: Any, file: str | Path, pos: Sequence[float] = (0.0, 0.0, 0.0), name: str = "undulator"
) -> Any:
    """Put the robot of a file into an arena of dm_control, and give it the options it needs.

    Args:
        arena: a mjcf.RootElement, as `mjcf_model` of a composer.Arena is.
        file, pos: see attach.
        name: of the robot's model, which dm_control puts before all its names.

    Returns:
        The frame that it is in.
    """
    from dm_control import mjcf

    tree = ET.fromstring(robot(file).to_xml())
    tree.set("model", name)
    options = tree.find("option")
    assert options is not None
    for key, value in options.attrib.items():
        if key in OPTIONS:
            setattr(arena.option, key, value if key in ("integrator", "cone") else float(value))
    for flag in options.iter("flag"):
        for key, value in flag.attrib.items():
            setattr(arena.option.flag, key, value)
    for tag in ("option", "visual", "statistic", "size", "keyframe"):
        for element in tree.findall(tag):
            tree.remove(element)
    site = arena.worldbody.add("site", pos=pos)
    return site.attach(mjcf.from_xml_string(ET.tostring(tree, encoding="unicode")))
