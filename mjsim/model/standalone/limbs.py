"""Robots of limbs as MJCF that walk by themselves: one control per limb, MuJoCo's friction.

Friction is by load, at every pad; pressures are the controls, in Pa, of chambers at constant
pressure. An end has pads of its side a little before it and of its tip a little above: the tip
touches where it is steep, the side where it is flat. Limbs do not twist unless they are told to: at
the step of these files, by load at edges of limbs that twist, distances are not sure.
"""

from dataclasses import replace

import mujoco

from analytic.scene import pneunet
from analytic.scene.chain import segment_overlap
from analytic.scene.ground import uniform
from analytic.scene.limbs import LimbedRobot, chambers_by_limb
from mjsim.model.appearance.limb_skins import add_camera, add_skins
from mjsim.model.appearance.stage import stage
from mjsim.model.bodies.limbs import hinge_prefix, limbed, link_prefix, tree_spec
from mjsim.model.bodies.parts import PREFIX, softness_with_friction
from mjsim.model.pneumatics import turn_hinges
from mjsim.scene import Numerics, Resolved, Scene, resolved

_BEFORE, _STEEP = 0.3, 0.05  # of a link, from an end to its side's pads; rad, of a tip; chosen
_ROUNDED_INERTIA = 0.9999  # of a plate about its normal; chosen
_TIMESTEP, _IMPRATIO = 0.005, 100.0  # s; chosen
_PER_CELL = 4  # stations of a skin along a cell, which keep files small; chosen
_RADIUS, _DEPTH = 1e-5, 4e-5  # m; of pads, since friction acts at their lowest point; see Numerics


def spec_in_space(scene: Scene, numerics: Numerics | None = None) -> mujoco.MjSpec:
    """The scene, whose friction is by load, to open in MuJoCo's viewer: one slider per chamber."""
    numerics = numerics or Numerics()
    timestep = numerics.timestep or _TIMESTEP
    given = replace(numerics, timestep=timestep, pad_radius=_RADIUS, twists=numerics.twists or 0)
    resolution = resolved(scene, given)
    spec = tree_spec(scene, resolution, stage(scene.ground), with_friction=False)
    spec.modelname = scene.ground.name
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = _IMPRATIO
    surface = uniform(scene.ground)
    for geom in spec.geoms:
        if "_pad_" in geom.name:
            geom.condim = 3
            geom.friction[:] = surface.friction, 0.0, 0.0
            geom.solref[:], geom.solimp[:3] = softness_with_friction(timestep / 2, _DEPTH)
    _add_tips(spec, scene, resolution, float(surface.tip_friction or 0.0))
    allow_rounding(spec)
    _actuate(spec, limbed(scene), resolution)
    for name in ("ruler", "start"):
        spec.delete(spec.geom(name))
    add_skins(spec, scene, resolution, _PER_CELL)
    add_camera(spec, scene)
    return spec


def allow_rounding(spec: mujoco.MjSpec) -> None:
    """Let inertias of plates still be of a body once their digits are rounded in a file."""
    for body in spec.bodies:
        if body.explicitinertial:
            body.inertia[2] *= _ROUNDED_INERTIA


def _add_tips(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved, friction: float) -> None:
    robot = limbed(scene)
    for name in robot.outer:
        back = _BEFORE * robot.limbs[robot.place(name)].strip.length / numerics.links
        body = spec.body(f"{link_prefix(name)}{numerics.links}")
        for side in ("left", "right"):
            pad = spec.geom(f"{PREFIX}{name}_pad_{numerics.links + 1}_{side}")
            x, y, z = pad.pos
            tip = body.add_geom(name=f"{PREFIX}{name}_tip_{side}", pos=(x, y, z + _STEEP * back))
            tip.type, tip.mass, tip.group = pad.type, 0.0, pad.group
            tip.size[:], tip.condim, tip.priority = pad.size, 3, 1
            tip.contype, tip.conaffinity = 1, 0
            tip.solref[:], tip.solimp[:] = pad.solref, pad.solimp
            tip.friction[:] = friction, 0.0, 0.0
            pad.pos = (x - back, y, z)


def _actuate(spec: mujoco.MjSpec, robot: LimbedRobot, numerics: Resolved) -> None:
    for limb, part in zip(robot.limbs, chambers_by_limb(robot), strict=True):
        bend = pneunet.curvature_per_pressure(limb.strip) * pneunet.base_rigidity(limb.strip)
        overlap = segment_overlap(limb.strip.borders, numerics.links).T
        for chamber, inside in zip(robot.chambers[part], overlap, strict=True):
            actuator = spec.add_actuator(name=chamber)
            turn_hinges(spec, actuator, f"{PREFIX}{chamber}_bend", hinge_prefix(limb.name), inside,
                        -bend)  # fmt: skip
            actuator.ctrlrange[:] = 0.0, robot.peak_pressure
            actuator.ctrllimited = int(mujoco.mjtLimited.mjLIMITED_TRUE)
