"""A robot of limbs as MJCF: chains of rigid links in space, pads at both edges, friction's rows.

The links are those of analytic.solvers.limbs: so many hinges a limb between one link more, the
first link of a limb fast to the one that carries it. The trunk's beginning may move along x, y and
z, and yaw, pitch and roll. Friction is carried by fixed tendons over all coordinates: their
coefficients, set at each step, are the Jacobian of the place that is held.
"""

import math
from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene import pneunet
from analytic.scene.chain import joint_springs, link_lengths
from analytic.scene.limbs import LimbedRobot, chambers_by_limb, limbs_of, rotation
from analytic.solvers.limbs.contacts import ripple
from mjsim.model.parts import PREFIX, TOUCH
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

ROOT = ("x", "y", "z", "yaw", "pitch", "roll")
_THIN = 1e-9  # MuJoCo wants A + B >= C of inertias, of which a plate has A + B = C
_NO_BOUND = 1e-12  # N; without any bound a tendon would get no row to be given one
_TOWARDS = 3.0  # times the centripetal acceleration that contacts yield to; measured
_SOFTEST = 0.1  # beyond, limbs sink in as they walk; chosen
# of softness times gravity times the square of the contacts' time: how deep a robot lies, measured;
# and how much of the height of ripples that may be, which costs 3 % of the distance, measured
_SINKS, _DEEPEST = 0.12, 0.27
_FIRM = (0.001, 1.0), (0.9999, 0.9999, 0.001)  # nearly without creep


def softness(scene: Scene, numerics: Resolved) -> float:
    """Part of an acceleration that contacts yield to: 1 - d of MuJoCo's impedance d.

    MuJoCo holds J a at a contact, where the ground stops J a + J' v: a limb that turns about it at
    a rate v / r would leave it by v^2 / r, unless the contact yields by more than that to gravity.
    """
    robot, gait = scene.robot, scene.gait
    rates = np.abs(np.diff(robot.peak_pressure * np.array(gait.stages), axis=0))
    rates /= np.array(gait.ramp_times)[:, None]
    swift = 0.0
    for limb, part in zip(limbs_of(robot), chambers_by_limb(robot), strict=True):
        strip = limb.strip
        # how fast its end turns as all its segments change [rad/s]
        change = float((rates[:, part] @ np.diff(strip.borders)).max())
        turning = pneunet.curvature_per_pressure(strip) * strip.length * change
        swift = max(swift, 0.5 * strip.length * float(turning) ** 2)
    return min(numerics.contact_softness + _TOWARDS * swift / scene.gravity,
               max(_SOFTEST, numerics.contact_softness))  # fmt: skip


def longest_step(scene: Scene, numerics: Resolved) -> float:
    """Time step beyond which limbs sink in so deep that it matters [s].

    Where that is not small beside the height to which a flat limb ripples between its nodes, the
    ground's forces tell less well how much of it lies flat.
    """
    lowest = min(ripple(limb.strip, numerics.links) for limb in limbs_of(scene.robot))
    depth = _SINKS * softness(scene, numerics) * scene.gravity * numerics.contact_time**2
    return math.sqrt(_DEEPEST * lowest / depth)


def limbed(scene: Scene) -> LimbedRobot:
    """The robot of a scene in space."""
    assert isinstance(scene.robot, LimbedRobot)
    return scene.robot


def limb_body(limb: str, link: int) -> str:
    """Name of a link's body."""
    return f"{PREFIX}{limb}_{link}"


def tree_spec(
    scene: Scene, numerics: Resolved, ground: mujoco.MjSpec, held: bool = True
) -> mujoco.MjSpec:
    """The robot put on a ground that is given as MJCF; with friction's rows if `held`."""
    spec = ground
    spec.option.timestep = numerics.timestep
    spec.option.gravity = (0.0, 0.0, -scene.gravity)
    ends: dict[str, dict[str, tuple[mujoco.MjsBody, float]]] = {}
    robot = limbed(scene)
    for i, limb in enumerate(robot.limbs):
        if limb.on is None:
            carrier, along, heading = spec.worldbody, 0.0, 0.0
        else:
            carrier, along = ends[limb.on][limb.at]
            heading = robot.limbs[robot.place(limb.on)].angle
        first, last, length = _chain(scene, numerics, i, carrier, along, limb.angle - heading)
        ends[limb.name] = {"begin": (first, 0.0), "end": (last, length)}
    for number in range(len(robot.limbs) if held else 0):
        for place in range(points_of(robot, number)):
            for direction in (0, 1):
                _add_row(spec, robot, numerics, number, f"{place}_{direction}")
    return spec


def points_of(robot: LimbedRobot, limb: int) -> int:
    """How many places of a limb may be held at once.

    Two of a side, for each end that something may touch the ground by, and one between such ends;
    a limb of several segments may touch there too.
    """
    own = robot.limbs[limb]
    free_end_alone = own.on is not None and own.name in robot.outer and len(own.strip.segments) == 1
    return 2 if free_end_alone else 5


def _chain(
    scene: Scene,
    numerics: Resolved,
    limb: int,
    carrier: mujoco.MjsBody,
    along: float,
    angle: float,
) -> tuple[mujoco.MjsBody, mujoco.MjsBody, float]:
    """The links of a limb; its first and last body, and the length of the last."""
    own, links = limbs_of(scene.robot)[limb], numerics.links
    lengths = link_lengths(own.strip, links)
    stiffness, rest = joint_springs(own.strip, links, np.zeros((1, len(own.strip.segments))))
    firmness = 1.0 - softness(scene, numerics)
    parent, first = carrier, carrier
    for i, length in enumerate(lengths.tolist()):
        body = parent.add_body(name=limb_body(own.name, i))
        if i == 0:
            body.pos = (along, own.offset, _height(scene, numerics) if own.on is None else 0.0)
            body.quat = (np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2))
            if own.on is None:
                _add_root(body, angle)
            first = body
        else:
            body.pos = (lengths[i - 1], 0.0, 0.0)
            joint = body.add_joint(name=f"{PREFIX}{own.name}_hinge_{i}", axis=(0, -1, 0))
            joint.springref = rest[0, i - 1]
            joint.stiffness[0] = stiffness[0, i - 1]
            joint.damping[0] = numerics.damping_time * stiffness[0, i - 1]
        width = own.strip.width
        mass = own.strip.weight_per_length / scene.gravity * length
        across, long = mass * width**2 / 12, mass * length**2 / 12
        body.explicitinertial, body.mass, body.ipos = True, mass, (length / 2, 0.0, 0.0)
        body.inertia = (across, long, (across + long) * (1 - _THIN))
        _add_pads(body, numerics, firmness, own.name, i, 0.0, width)
        if i == links:
            _add_pads(body, numerics, firmness, own.name, i + 1, length, width)
        parent = body
    return first, parent, float(lengths[-1])


def _height(scene: Scene, numerics: Resolved) -> float:
    """A little in the ground: a contact at 0 is not seen."""
    return numerics.pad_radius - TOUCH * limbs_of(scene.robot)[0].strip.length


def _add_root(body: mujoco.MjsBody, angle: float) -> None:
    """Joints of the whole: along the ground's axes, pitch and roll about the trunk's own."""
    slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
    axes = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 1), (0, -1, 0), (1, 0, 0))
    for name, axis in zip(ROOT, axes, strict=True):
        kind = slide if name in "xyz" else hinge
        joint = body.add_joint(name=PREFIX + name, type=kind, axis=axis)
        if name in "xy":
            joint.axis[:2] = np.array(axis[:2]) @ rotation(angle)


def _add_pads(
    body: mujoco.MjsBody,
    numerics: Resolved,
    firmness: float,
    limb: str,
    node: int,
    x: float,
    width: float,
) -> None:
    for side, y in (("right", -0.5 * width), ("left", 0.5 * width)):
        pad = body.add_geom(name=f"{PREFIX}{limb}_pad_{node}_{side}")
        pad.type, pad.pos = mujoco.mjtGeom.mjGEOM_SPHERE, (x, y, 0.0)
        pad.size[0], pad.mass, pad.group = numerics.pad_radius, 0.0, 3
        pad.contype, pad.conaffinity, pad.priority, pad.condim = 1, 0, 1, 1
        pad.solref[:] = numerics.contact_time * numerics.timestep, 1.0
        pad.solimp[:3] = firmness, firmness, 0.001


def _add_row(
    spec: mujoco.MjSpec, robot: LimbedRobot, numerics: Resolved, limb: int, which: str
) -> None:
    name = f"{PREFIX}{robot.names[limb]}_friction_{which}"
    tendon = spec.add_tendon(name=name, frictionloss=_NO_BOUND)
    tendon.group = 4
    tendon.solref_friction[:], tendon.solimp_friction[:3] = _FIRM
    for joint in joints_to(robot, numerics.links, limb):
        tendon.wrap_joint(joint, float(joint == PREFIX + ROOT[0]))


class Hinges:
    """Springs of all hinges, set at each step; see mjsim.model.body.Joints.

    Args:
        model, scene, numerics: as compiled, and what it is of.

    Attributes:
        angles: places of the hinges' angles among MuJoCo's coordinates, limb by limb.
    """

    def __init__(self, model: mujoco.MjModel, scene: Scene, numerics: Resolved) -> None:
        self._scene, self._links = scene, numerics.links
        joints = [model.joint(name) for name in hinge_names(limbed(scene), numerics.links)]
        self._hinges = np.array([joint.id for joint in joints])
        self.angles = np.array([int(joint.qposadr[0]) for joint in joints])
        self._stiffness, self._rest = model.jnt_stiffness, model.qpos_spring

    def loads(self, valves: Array, before: Array, pressures: Array) -> Sequence[Any]:
        """Stiffness and rest angle of all hinges at each step."""
        robot, chamber = self._scene.robot, self._scene.chamber
        parts = [
            joint_springs(limb.strip, self._links, pressures[:, chambers], chamber)
            for limb, chambers in zip(limbs_of(robot), chambers_by_limb(robot), strict=True)
        ]
        stiffness, rest = (np.concatenate(part, axis=1) for part in zip(*parts, strict=True))
        return list(zip(stiffness, rest, strict=True))

    def apply(self, load: Any) -> None:
        """Set them for the next step."""
        self._stiffness[self._hinges], self._rest[self.angles] = load


def hinge_names(robot: LimbedRobot, links: int) -> list[str]:
    """Of all limbs, in their order."""
    return [f"{PREFIX}{limb}_hinge_{i}" for limb in robot.names for i in range(1, links + 1)]


def joints_to(robot: LimbedRobot, links: int, limb: int) -> list[str]:
    """Names of the joints that move a limb, its own included."""
    own = robot.limbs[limb]
    before = [*(PREFIX + name for name in ROOT)]
    if own.on is not None:
        carrier = robot.place(own.on)
        before = joints_to(robot, links, carrier)
        if own.at == "begin":
            before = before[: len(before) - links]
    return before + [f"{PREFIX}{own.name}_hinge_{i}" for i in range(1, links + 1)]
