"""A robot of limbs as MJCF that walks by itself: a control a limb, MuJoCo's own friction.

Friction is by load, at every pad; pressures are the controls, in Pa, of chambers at constant
pressure. An end has pads of its side a little before it and of its tip a little above: the tip
touches where it is steep, the side where it is flat.
"""

import shutil
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np

from analytic.scene import pneunet
from analytic.scene.ground import uniform
from analytic.scene.limbs import TreeRobot
from analytic.scene.surface import Surface
from mjsim.files.assets import MODELS
from mjsim.files.files import whole
from mjsim.model.limb_skins import add_camera, add_skins
from mjsim.model.limbs import limb_body, tree_spec
from mjsim.model.parts import PREFIX
from mjsim.model.stage import stage
from mjsim.model.standalone import TEXTURES
from mjsim.scene.limbs import TreeNumerics, TreeScene

_BEFORE, _STEEP = 0.3, 0.05  # of a link, from an end to its side's pads; rad, of a tip; chosen
_INERTIA = 0.9999  # of a plate about its normal, so that rounded digits still are of a body
_TIMESTEP, _IMPRATIO = 0.005, 100.0  # s; chosen
_RADIUS, _DEPTH = 1e-5, 4e-5  # m; of pads, since friction acts at their lowest point; see Numerics


def walking_scene(scene: TreeScene) -> TreeScene:
    """The same scene with friction by load.

    A surface without coefficients gets those with which a tip that carries a quarter of the weight
    resists by its part of the tip force, and a side likewise by its whole limb.
    """
    ground = uniform(scene.ground)
    if not ground.friction and not ground.tip_friction:
        legs = [limb.strip for limb in scene.robot.limbs[1:]]
        load = scene.robot.weight / max(len(legs), 1)
        area = max((leg.length * leg.width for leg in legs), default=0.0)
        share = 2.0 / max(len(legs), 1)  # of a tip force, which the limbs of an end share
        ground = Surface(ground.name, ground.tip_force, ground.shear_strength,
                         ground.shear_strength * area / load,
                         share * ground.tip_force / load)  # fmt: skip
    return replace(scene, ground=ground, friction="coulomb")


def standalone_spec(scene: TreeScene, numerics: TreeNumerics | None = None) -> mujoco.MjSpec:
    """The scene to open in MuJoCo's viewer and to drive by a slider a limb."""
    scene = walking_scene(scene)
    numerics = replace(numerics or TreeNumerics(), timestep=_TIMESTEP, pad_radius=_RADIUS)
    spec = tree_spec(scene, numerics, stage(scene.ground), held=False)
    spec.modelname = scene.ground.name
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = _IMPRATIO
    surface, time = uniform(scene.ground), _TIMESTEP / 2
    for geom in spec.geoms:
        if "_pad_" in geom.name:
            geom.condim = 3
            geom.friction[:] = surface.friction, 0.0, 0.0
            geom.solref[:] = -0.125 / time**2, -0.5 / time
            geom.solimp[:3] = 0.9, 0.999, _DEPTH
    _add_tips(spec, scene, numerics, float(surface.tip_friction or 0.0))
    for body in spec.bodies:
        if body.explicitinertial:
            body.inertia[2] *= _INERTIA
    _actuate(spec, scene.robot, numerics)
    for name in ("ruler", "start"):
        spec.delete(spec.geom(name))
    add_skins(spec, scene, numerics)
    add_camera(spec, scene)
    model = spec.compile()
    spec.add_key(name="flat", qpos=model.qpos0, ctrl=np.zeros(model.nu))
    return spec


def write(scene: TreeScene, path: Path, numerics: TreeNumerics | None = None) -> None:
    """Write a scene as a file that opens from any folder on any machine, its textures beside it.

    Raises:
        OSError: it cannot be written.
    """
    spec = standalone_spec(scene, numerics)
    text = spec.to_xml().replace(f'texturedir="{spec.texturedir}"', f'texturedir="{TEXTURES}"')
    folder = path.parent / TEXTURES
    folder.mkdir(parents=True, exist_ok=True)
    for texture in spec.textures:
        source = MODELS / TEXTURES / texture.file
        if texture.file and source.resolve() != (folder / texture.file).resolve():
            shutil.copyfile(source, folder / texture.file)
    with whole(path) as part:
        part.write_text(text, encoding="utf-8")


def _add_tips(
    spec: mujoco.MjSpec, scene: TreeScene, numerics: TreeNumerics, friction: float
) -> None:
    robot = scene.robot
    for name in robot.outer:
        back = _BEFORE * robot.limbs[robot.place(name)].strip.length / numerics.elements
        body = spec.body(limb_body(name, numerics.elements))
        for side in ("left", "right"):
            pad = spec.geom(f"{PREFIX}{name}_pad_{numerics.elements + 1}_{side}")
            x, y, z = pad.pos
            tip = body.add_geom(name=f"{PREFIX}{name}_tip_{side}", pos=(x, y, z + _STEEP * back))
            tip.type, tip.mass, tip.group = pad.type, 0.0, pad.group
            tip.size[:], tip.condim, tip.priority = pad.size, 3, 1
            tip.contype, tip.conaffinity = 1, 0
            tip.solref[:], tip.solimp[:] = pad.solref, pad.solimp
            tip.friction[:] = friction, 0.0, 0.0
            pad.pos = (x - back, y, z)


def _actuate(spec: mujoco.MjSpec, robot: TreeRobot, numerics: TreeNumerics) -> None:
    for limb in robot.limbs:
        name = f"{PREFIX}{limb.name}"
        tendon = spec.add_tendon(name=f"{name}_bend", group=4)
        for i in range(1, numerics.elements + 1):
            tendon.wrap_joint(f"{name}_hinge_{i}", 1.0)
        bend = pneunet.curvature_per_pressure(limb.strip) * pneunet.base_rigidity(limb.strip)
        chamber = spec.add_actuator(name=limb.name, target=f"{name}_bend")
        chamber.trntype = mujoco.mjtTrn.mjTRN_TENDON
        chamber.gaintype, chamber.gainprm[0] = mujoco.mjtGain.mjGAIN_FIXED, -bend
        chamber.ctrlrange[:] = 0.0, robot.peak_pressure
        chamber.ctrllimited = int(mujoco.mjtLimited.mjLIMITED_TRUE)
