"""Robots of limbs as MJCF: chains of rigid links in space, pads at both edges, friction's rows.

The links are those of analytic.solvers.limbs: N hinges between N + 1 links in each limb, whose
first link is rigidly attached to the one that carries it, and joints that twist some of them. The
trunk's beginning may move along x, y and z, and yaw, pitch and roll. Friction is carried by fixed
tendons over all coordinates: their coefficients, set at each step, are the Jacobian of the point
where it acts.
"""

import itertools
import math
from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene import pneunet
from analytic.scene.chain import joint_springs, link_lengths
from analytic.scene.limbs import Limb, LimbedRobot, chambers_by_limb, limbs_of, rotation
from analytic.solvers.limbs.contact_search import parts_of
from analytic.solvers.limbs.resting_limb import ASIDE, ripple
from mjsim.model.bodies import parts
from mjsim.model.bodies.links import UP, add_links
from mjsim.model.bodies.parts import PREFIX, Node
from mjsim.model.ceiling import add_ceiling, add_upper_edge
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

ROOT = ("x", "y", "z", "yaw", "pitch", "roll")
ROWS = 3  # of friction at each point, see mjsim.friction.friction_rows
TIP_POINTS = len(ASIDE)
POINTS = TIP_POINTS + 1  # that a contact has as a tip, and as a side
_THIN = 1e-9  # MuJoCo wants A + B >= C of inertias, of which a plate has A + B = C
_TOWARDS = 3.0  # times the centripetal acceleration that contacts yield to; measured
_STIFFEST = 1e-4  # that MuJoCo takes
_SOFTEST = 0.1  # beyond, limbs sink in as they walk; chosen
# of softness times gravity times the square of the contacts' time: how deep a robot lies, measured;
# and how much of the height of ripples that may be, which costs 3 % of the distance, measured
_SINKS, _DEEPEST = 0.12, 0.27


def softness(scene: Scene, numerics: Resolved) -> float:
    """Part of an acceleration that contacts yield to: 1 - d of MuJoCo's impedance d.

    MuJoCo stops J a at a contact, where the ground stops J a + J' v: a limb that turns about it at
    a rate v / r would leave it by v^2 / r, unless the contact yields by more than that to gravity.
    Adhesion presses besides: contacts yield less, so that a robot lies no deeper.
    """
    robot, gait = scene.robot, scene.gait
    rates = np.abs(np.diff(robot.peak_pressure * np.array(gait.stages), axis=0))
    rates /= np.array(gait.ramp_times)[:, None]
    swift = 0.0
    for limb, part in zip(limbs_of(robot), chambers_by_limb(robot), strict=True):
        strip = limb.strip
        # how fast its end turns as all its segments change [rad/s]
        change = float((rates[:, part] @ np.diff(strip.borders)).max())
        turning = pneunet.steepest_curvature(strip, robot.peak_pressure) * strip.length * change
        swift = max(swift, 0.5 * strip.length * float(turning) ** 2)
    yields = min(numerics.contact_softness + _TOWARDS * swift / scene.gravity,
                 max(_SOFTEST, numerics.contact_softness))  # fmt: skip
    return max(yields / _pressed(scene), min(yields, _STIFFEST))


def _pressed(scene: Scene) -> float:
    """Weight and adhesion of the limb that sticks most, over its weight [1]."""
    surface = scene.ground.at(0.0)
    strips = [limb.strip for limb in limbs_of(scene.robot)]
    return 1.0 + max(surface.press(strip.width) / strip.weight_per_length for strip in strips)


def longest_step(scene: Scene, numerics: Resolved) -> float:
    """Time step beyond which limbs sink in so deep that it matters [s].

    Where that is not small beside the height to which a flat limb ripples between its nodes, the
    ground's forces tell less well how much of it lies flat.
    """
    lowest = min(ripple(limb.strip, numerics.links) for limb in limbs_of(scene.robot))
    pull = scene.gravity * _pressed(scene)
    depth = _SINKS * softness(scene, numerics) * pull * numerics.contact_time**2
    return math.sqrt(_DEEPEST * lowest / depth)


def limbed(scene: Scene) -> LimbedRobot:
    """The robot of a scene in space."""
    assert isinstance(scene.robot, LimbedRobot)
    return scene.robot


def link_prefix(limb: str) -> str:
    """Names of a limb's links before their numbers from 0."""
    return f"{PREFIX}{limb}_"


def hinge_prefix(limb: str) -> str:
    """Names of a limb's hinges before their numbers from 1."""
    return f"{PREFIX}{limb}_hinge_"


def twist_prefix(limb: str) -> str:
    """Names of the joints that twist a limb before their numbers from 1."""
    return f"{PREFIX}{limb}_twist_"


def tree_spec(
    scene: Scene, numerics: Resolved, ground: mujoco.MjSpec, with_friction: bool = True
) -> mujoco.MjSpec:
    """The robot put on a ground that is given as MJCF.

    Args:
        scene, numerics: the robot, and how it is discretised.
        ground: to which it is added.
        with_friction: whether to add the tendons by which mjsim.friction resists.
    """
    spec = ground
    parts.set_options(spec, scene, numerics)
    robot = limbed(scene)
    chains: dict[str, list[Node]] = {}
    for limb in robot.limbs:
        carrier, along, heading = spec.worldbody, 0.0, 0.0
        if limb.on is not None:
            carrier, (along, _, _) = chains[limb.on][0 if limb.at == "begin" else -1]
            heading = robot.limbs[robot.place(limb.on)].angle
        nodes = _add_limb(carrier, scene, numerics, limb)
        angle, (first, _) = limb.angle - heading, nodes[0]
        height = parts.start_height(limb.strip.length, numerics) if limb.on is None else 0.0
        first.pos = (along, limb.offset, height)
        first.quat = (np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2))
        if limb.on is None:
            _add_root(first, angle)
        chains[limb.name] = nodes
    if with_friction:
        _add_friction(spec, scene, numerics)
    add_ceiling(spec, scene, numerics)
    return spec


def _add_limb(carrier: mujoco.MjsBody, scene: Scene, numerics: Resolved, limb: Limb) -> list[Node]:
    """Links of a limb with pads at both edges."""
    width, impedance = limb.strip.width, 1.0 - softness(scene, numerics)
    names = link_prefix(limb.name), hinge_prefix(limb.name)
    nodes = add_links(carrier, limb.strip, scene, numerics, names, width=width,
                      twists=twist_prefix(limb.name))  # fmt: skip
    for body, _ in nodes[:-1]:
        body.inertia[2] *= 1 - _THIN
    lengths = link_lengths(limb.strip, numerics.links).tolist()
    for number, (body, (x, _, _)) in enumerate(nodes):
        for side, y in (("right", -0.5 * width), ("left", 0.5 * width)):
            name = f"{PREFIX}{limb.name}_pad_{number}_{side}"
            pad = parts.add_pad(body, name, (x, y, 0.0), numerics)
            pad.solref[:] = numerics.contact_time * numerics.timestep, 1.0
            pad.solimp[:3] = impedance, impedance, 0.001
            parts.stick(pad, scene, numerics, limb.strip, number, 2)
            if scene.ceiling is not None and number < len(lengths):
                edge = f"{PREFIX}{limb.name}_top_{number}_{side}"
                add_upper_edge(body, edge, limb.strip, lengths[number], y,
                               (pad.solref, pad.solimp[:3]), scene.ceiling_friction)  # fmt: skip
    return nodes


def _add_root(body: mujoco.MjsBody, angle: float) -> None:
    """Add joints of the whole: along the ground's axes, pitch and roll about the trunk's."""
    slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
    axes = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 1), UP, (1, 0, 0))
    for name, axis in zip(ROOT, axes, strict=True):
        joint_type = slide if name in "xyz" else hinge
        joint = body.add_joint(name=PREFIX + name, type=joint_type, axis=axis)
        if name in "xy":
            joint.axis[:2] = np.array(axis[:2]) @ rotation(angle)


def point_names(limb: str, part: str) -> list[str]:
    """Names of friction at the points of a contact, see analytic.solvers.limbs.contacts."""
    return [f"{PREFIX}{limb}_friction_{part}_{point}" for point in range(POINTS)]


def _add_friction(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> None:
    """Add a tendon for each point and row of mjsim.friction.friction_rows."""
    robot = limbed(scene)
    for number, limb in enumerate(robot.limbs):
        joints = joints_to(robot, numerics.links, number, numerics.twists)
        names = [name for part in parts_of(limb, robot) for name in point_names(limb.name, part)]
        for name, row in itertools.product(names, range(ROWS)):
            tendon = parts.friction_tendon(spec, f"{name}_{row}", parts.NO_BOUND)
            for joint in joints:
                tendon.wrap_joint(joint, float(joint == PREFIX + ROOT[0]))


class Hinges:
    """Springs of all hinges, set at each step; see mjsim.model.bodies.body.Joints.

    Args:
        model, scene, numerics: as compiled, and what it is of.

    Attributes:
        angles: places of the hinges' angles among MuJoCo's coordinates, limb by limb.
    """

    def __init__(self, model: mujoco.MjModel, scene: Scene, numerics: Resolved) -> None:
        self._scene, self._links = scene, numerics.links
        joints = [
            model.joint(name)
            for limb in limbed(scene).names for name in _hinges_of(limb, numerics.links)
        ]  # fmt: skip
        self._hinges = np.array([joint.id for joint in joints])
        self.angles = np.array([int(joint.qposadr[0]) for joint in joints])
        self._stiffness, self._rest = model.jnt_stiffness, model.qpos_spring

    def loads(self, valves: Array, before: Array, pressures: Array) -> Sequence[Any]:
        """Stiffness and rest angle of all hinges at each step."""
        robot, chamber = self._scene.robot, self._scene.chamber
        springs = [
            joint_springs(limb.strip, self._links, pressures[:, chambers], chamber)
            for limb, chambers in zip(limbs_of(robot), chambers_by_limb(robot), strict=True)
        ]
        stiffness, rest = (np.concatenate(part, axis=1) for part in zip(*springs, strict=True))
        return list(zip(stiffness, rest, strict=True))

    def apply(self, load: Any) -> None:
        """Set them for the next step."""
        self._stiffness[self._hinges], self._rest[self.angles] = load


def _hinges_of(limb: str, links: int) -> list[str]:
    return [f"{hinge_prefix(limb)}{i}" for i in range(1, links + 1)]


def joints_to(robot: LimbedRobot, links: int, limb: int, twists: int = 0) -> list[str]:
    """Names of the joints that move a limb, those within it last."""
    name, carrier, end = robot.limbs[limb].name, robot.limbs[limb].on, robot.limbs[limb].at
    before = [PREFIX + root for root in ROOT]
    if carrier is not None:
        before = joints_to(robot, links, robot.place(carrier), twists)
        if end == "begin":
            before = before[: len(before) - links - twists]
    twisting = [f"{twist_prefix(name)}{i}" for i in range(1, twists + 1)]
    return before + _hinges_of(name, links) + twisting
