"""Scenes as MJCF that walk by themselves: no Python between their steps.

Pressures are the controls of actuators, in Pa, of chambers at constant pressure. Friction is
MuJoCo's own. Constant bounds are carried by shoes, see mjsim.model.standalone.shoes, where these
serve the scene; else friction is by load at the pads. What the loop of mjsim does besides is left
out there: the outermost pads keep the friction of tips while an end lies on its side, and anchors
drift by the integrator's first order.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np

from analytic.scene import pneunet
from analytic.scene.chain import link_lengths, segment_overlap
from analytic.scene.ground import check_round, uniform
from analytic.scene.limbs import limbs_of
from analytic.scene.surface import Surface
from mjsim.files.assets import MODELS
from mjsim.files.files import whole
from mjsim.model.bodies.parts import PALE, PREFIX
from mjsim.model.builder import scene_spec
from mjsim.model.standalone.limbs import allow_rounding, spec_in_space
from mjsim.model.standalone.shoes import add_shoes, refusal
from mjsim.scene import Numerics, Resolved, Scene, resolved

TEXTURES = "textures"
_DARKER = 0.86  # every second segment, so that they can be distinguished


def walking_scene(scene: Scene) -> Scene:
    """Scene with what MuJoCo does alone: friction by load, actuated chambers.

    A surface without coefficients gets those with which a tip resists by its part of the tip force,
    and a side as that of a whole segment or leg does. For a strip an end carries half the weight;
    for a robot of limbs each leg carries as much, and the limbs of an end share a tip force.
    """
    ground = uniform(scene.ground)
    check_round(ground, "a file that walks by itself")
    if any(limb.strip.feet for limb in limbs_of(scene.robot)):
        raise ValueError(
            "a file that walks by itself is for robots without feet; this one has some"
        )
    if scene.in_space and any(limb.strip.tether for limb in limbs_of(scene.robot)):
        raise ValueError(
            "a file that walks by itself is for robots of limbs without tether; this one has one"
        )
    if not ground.friction and not ground.tip_friction:
        legs = [limb.strip for limb in limbs_of(scene.robot)[1:]]
        feet = len(legs) or 2 - scene.in_space
        load = scene.robot.weight / feet
        if scene.in_space:
            area = max((leg.length * leg.width for leg in legs), default=0.0)
        else:
            area = scene.strip.width * scene.strip.length / len(scene.strip.segments)
        ground = Surface(ground.name, ground.tip_force, ground.shear_strength,
                         ground.shear_strength * area / load,
                         2.0 / feet * ground.tip_force / load)  # fmt: skip
    actuated = "actuators" if (scene.body, scene.in_space) == ("chain", False) else scene.actuation
    return replace(scene, ground=ground, friction="coulomb", actuation=actuated,
                   chamber="constant-pressure")  # fmt: skip


def law_of(scene: Scene) -> str:
    """The friction law that the file of a scene has, in one line."""
    reason = refusal(scene)
    if reason is None:
        return ("friction: constant bounds at tips and by area on sides, as [Majidi13] has them, "
                "carried by shoes that springs and chambers press on the ground")  # fmt: skip
    ground = uniform(walking_scene(scene).ground)
    by_load = (f"friction: by load (mu N) at every pad, {ground.tip_friction:.3g} at tips and "
               f"{ground.friction:.3g} on sides, not the constant bounds of [Majidi13]; momentum "
               "has a part in distance and direction")  # fmt: skip
    return by_load if scene.friction == "coulomb" else f"{by_load} ({reason})"


def standalone_spec(scene: Scene, numerics: Numerics | None = None) -> mujoco.MjSpec:
    """The scene to open in MuJoCo's viewer and to drive by its controls.

    Friction is as the scene has it where shoes serve it, else by load: see `law_of`.

    Controls are the pressures of the chambers for strips of body chain and for robots of
    limbs, of the joints for the cable. The rod has none: its pressure is a couple on each edge,
    which only mjsim applies.
    """
    if any(limb.strip.actuator for limb in limbs_of(scene.robot)):
        raise ValueError(
            "actuator must not be given in a scene that is exported: MuJoCo's actuators are by the "
            "affine law; give curvature_per_pressure and rigidity_per_pressure"
        )
    if refusal(scene) is None:
        scene = replace(scene, actuation="actuators", chamber="constant-pressure")
        choice = resolved(scene, numerics)
        spec = _spec_of_strip(scene, choice)
        add_shoes(spec, scene, choice)
    else:
        scene = walking_scene(scene)
        if scene.in_space:
            spec = spec_in_space(scene, numerics)
        else:
            spec = _spec_of_strip(scene, resolved(scene, numerics))
    model = spec.compile()
    spec.add_key(name="flat", qpos=model.qpos0, ctrl=np.zeros(model.nu))
    return spec


def _spec_of_strip(scene: Scene, numerics: Resolved) -> mujoco.MjSpec:
    spec = scene_spec(scene, numerics)
    if scene.body in ("chain", "cable"):
        _show_links(spec, scene, numerics)
    if scene.body == "cable":
        _actuate_balls(spec, scene, numerics)
    for actuator in spec.actuators:
        actuator.ctrllimited = int(mujoco.mjtLimited.mjLIMITED_TRUE)
    for end in ("left", "right"):
        site = f"{PREFIX}end_{end}"
        for name, sensor in (("position", mujoco.mjtSensor.mjSENS_FRAMEPOS),
                           ("velocity", mujoco.mjtSensor.mjSENS_FRAMELINVEL),
                           ("load", mujoco.mjtSensor.mjSENS_TOUCH)):  # fmt: skip
            spec.add_sensor(
                name=f"{end}_{name}", type=sensor, objtype=mujoco.mjtObj.mjOBJ_SITE, objname=site
            )
    return spec


def write(
    scene: Scene, path: Path, numerics: Numerics | None = None, notes: Sequence[str] = ()
) -> None:
    """Write a scene as a file that opens from any folder on any machine, its textures beside it.

    Args:
        scene, numerics: see standalone_spec.
        path: of the file.
        notes: lines of its comment after the one that names its friction law.

    Raises:
        OSError: it cannot be written.
        ValueError: the body cannot do what the scene asks for.
    """
    spec = standalone_spec(scene, numerics)
    lines = [line.replace("--", "-") for line in (law_of(scene), *notes)]
    spec.comment = "\n".join(["", *(f"  {line}" for line in lines), ""])
    text = spec.to_xml().replace(f'texturedir="{spec.texturedir}"', f'texturedir="{TEXTURES}"')
    folder = path.parent / TEXTURES
    folder.mkdir(parents=True, exist_ok=True)
    for texture in spec.textures:
        source = MODELS / TEXTURES / texture.file
        if texture.file and source.resolve() != (folder / texture.file).resolve():
            with whole(folder / texture.file) as part:
                part.write_bytes(source.read_bytes())
    with whole(path) as part:
        part.write_text(text, encoding="utf-8")


def _show_links(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> None:
    """Add one box per link, to look at."""
    robot = scene.strip
    lengths = link_lengths(robot, numerics.links)
    segment = segment_overlap(robot.borders, numerics.links).argmax(axis=1)
    height = robot.flat_height
    for link, length in enumerate(lengths.tolist()):
        shade = _DARKER if segment[max(link - 1, 0)] % 2 else 1.0
        box = spec.body(f"{PREFIX}link_{link}").add_geom(name=f"{PREFIX}look_{link}")
        box.type, box.mass = mujoco.mjtGeom.mjGEOM_BOX, 0.0
        box.size, box.pos = (length / 2, robot.width / 2, height / 2), (length / 2, 0, height / 2)
        box.contype = box.conaffinity = 0
        box.rgba, box.group = (*(shade * part for part in PALE), 1.0), 1


def _actuate_balls(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> None:
    """Add one motor per ball joint, whose control is the pressure of its chamber."""
    robot = scene.strip
    bend = pneunet.curvature_per_pressure(robot) * pneunet.base_rigidity(robot)
    allow_rounding(spec)
    joints = [joint for joint in spec.joints if joint.name.startswith(f"{PREFIX}ball_")]
    for number, joint in enumerate(joints, start=1):
        motor = spec.add_actuator(name=f"{PREFIX}chamber_{number}", target=joint.name)
        motor.trntype, motor.gear[:3] = mujoco.mjtTrn.mjTRN_JOINT, (0.0, 1.0, 0.0)
        motor.gainprm[0], motor.ctrlrange[:] = bend, (0.0, robot.peak_pressure)
