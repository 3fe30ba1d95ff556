"""A robot of limbs as MJCF: chains of rigid links in space, pads at both edges, friction's rows.

The links are those of analytic.solvers.limbs: so many hinges a limb between one link more, the
first link of a limb fast to the one that carries it. The trunk's beginning may move along x, y and
z, and yaw, pitch and roll. Friction is carried by fixed tendons over all coordinates: their
coefficients, set at each step, are the Jacobian of the place that is held.
"""

import math

import mujoco
import numpy as np

from analytic.scene import pneunet
from analytic.scene.chain import joint_springs, link_lengths
from analytic.scene.limbs import TreeRobot, rotation
from analytic.solvers.limbs.contacts import ripple
from mjsim.model.builder import TOUCH
from mjsim.model.parts import PREFIX
from mjsim.scene.limbs import TreeNumerics, TreeScene

ROOT = ("x", "y", "z", "yaw", "pitch", "roll")
_THIN = 1e-9  # MuJoCo wants A + B >= C of inertias, of which a plate has A + B = C
_NO_BOUND = 1e-12  # N; without any bound a tendon would get no row to be given one
_TOWARDS = 3.0  # times the centripetal acceleration that contacts yield to; measured
_SOFTEST = 0.1  # beyond, limbs sink in as they walk; chosen
# of softness times gravity times the square of the contacts' time: how deep a robot lies, measured;
# and how much of the height of ripples that may be, which costs 3 % of the distance, measured
_SINKS, _DEEPEST = 0.12, 0.27
_FIRM = (0.001, 1.0), (0.9999, 0.9999, 0.001)  # nearly without creep


def softness(scene: TreeScene, numerics: TreeNumerics) -> float:
    """Part of an acceleration that contacts yield to: 1 - d of MuJoCo's impedance d.

    MuJoCo holds J a at a contact, where the ground stops J a + J' v: a limb that turns about it at
    a rate v / r would leave it by v^2 / r, unless the contact yields by more than that to gravity.
    """
    pressures = scene.robot.peak_pressure * np.array(scene.gait.stages)
    rates = np.abs(np.diff(pressures, axis=0)) / np.array(scene.gait.ramp_times)[:, None]
    swift = 0.0
    for limb, rate in zip(scene.robot.limbs, rates.max(axis=0).tolist(), strict=True):
        length = limb.strip.length
        turning = pneunet.curvature_per_pressure(limb.strip) * length * rate  # of an end [rad/s]
        swift = max(swift, 0.5 * length * float(turning) ** 2)
    return min(numerics.contact_softness + _TOWARDS * swift / scene.gravity,
               max(_SOFTEST, numerics.contact_softness))  # fmt: skip


def longest_step(scene: TreeScene, numerics: TreeNumerics) -> float:
    """Time step beyond which limbs sink in so deep that it matters [s].

    Where that is not small beside the height to which a flat limb ripples between its nodes, the
    ground's forces tell less well how much of it lies flat.
    """
    limbs = scene.robot.limbs
    lowest = min(ripple(limb.strip, numerics.elements) for limb in limbs)
    depth = _SINKS * softness(scene, numerics) * scene.gravity * numerics.contact_time**2
    return math.sqrt(_DEEPEST * lowest / depth)


def limb_body(limb: str, link: int) -> str:
    """Name of a link's body."""
    return f"{PREFIX}{limb}_{link}"


def tree_spec(
    scene: TreeScene, numerics: TreeNumerics, ground: mujoco.MjSpec, held: bool = True
) -> mujoco.MjSpec:
    """The robot put on a ground that is given as MJCF; with friction's rows if `held`."""
    spec = ground
    spec.option.timestep = numerics.timestep
    spec.option.gravity = (0.0, 0.0, -scene.gravity)
    ends: dict[str, dict[str, tuple[mujoco.MjsBody, float]]] = {}
    for i, limb in enumerate(scene.robot.limbs):
        if limb.on is None:
            carrier, along, heading = spec.worldbody, 0.0, 0.0
        else:
            carrier, along = ends[limb.on][limb.at]
            heading = scene.robot.limbs[scene.robot.place(limb.on)].angle
        first, last, length = _chain(scene, numerics, i, carrier, along, limb.angle - heading)
        ends[limb.name] = {"begin": (first, 0.0), "end": (last, length)}
    for number in range(len(scene.robot.limbs) if held else 0):
        for place in range(places_of(scene.robot, number)):
            for direction in (0, 1):
                _add_row(spec, scene, numerics, number, f"{place}_{direction}")
    return spec


def places_of(robot: TreeRobot, limb: int) -> int:
    """How many places of a limb may be held at once.

    Two of a side, for each end that something may touch the ground by, and one between such ends.
    """
    own = robot.limbs[limb]
    free_end_alone = own.on is not None and own.name in robot.outer
    return 2 if free_end_alone else 5


def _chain(
    scene: TreeScene,
    numerics: TreeNumerics,
    limb: int,
    carrier: mujoco.MjsBody,
    along: float,
    angle: float,
) -> tuple[mujoco.MjsBody, mujoco.MjsBody, float]:
    """The links of a limb; its first and last body, and the length of the last."""
    own, elements = scene.robot.limbs[limb], numerics.elements
    lengths = link_lengths(own.strip, elements)
    stiffness, rest = joint_springs(own.strip, elements, np.zeros((1, 1)))
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
        if i == elements:
            _add_pads(body, numerics, firmness, own.name, i + 1, length, width)
        parent = body
    return first, parent, float(lengths[-1])


def _height(scene: TreeScene, numerics: TreeNumerics) -> float:
    """A little in the ground: a contact at 0 is not seen."""
    return numerics.pad_radius - TOUCH * scene.robot.limbs[0].strip.length


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
    numerics: TreeNumerics,
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
    spec: mujoco.MjSpec, scene: TreeScene, numerics: TreeNumerics, limb: int, which: str
) -> None:
    name = f"{PREFIX}{scene.robot.names[limb]}_hold_{which}"
    tendon = spec.add_tendon(name=name, frictionloss=_NO_BOUND)
    tendon.group = 4
    tendon.solref_friction[:], tendon.solimp_friction[:3] = _FIRM
    for joint in joints_to(scene.robot, numerics.elements, limb):
        tendon.wrap_joint(joint, float(joint == PREFIX + ROOT[0]))


def hinge_names(robot: TreeRobot, elements: int) -> list[str]:
    """Of all limbs, in their order."""
    return [f"{PREFIX}{limb}_hinge_{i}" for limb in robot.names for i in range(1, elements + 1)]


def joints_to(robot: TreeRobot, elements: int, limb: int) -> list[str]:
    """Names of the joints that move a limb, its own included."""
    own = robot.limbs[limb]
    before = [*(PREFIX + name for name in ROOT)]
    if own.on is not None:
        carrier = robot.place(own.on)
        before = joints_to(robot, elements, carrier)
        if own.at == "begin":
            before = before[: len(before) - elements]
    return before + [f"{PREFIX}{own.name}_hinge_{i}" for i in range(1, elements + 1)]
