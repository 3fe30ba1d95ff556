"""The planar body: a chain of rigid links in the x-z plane, joined by hinges with springs.

Its neutral line (the strain-limiting layer) runs through the centres of the contact pads, so that
neither the ground's push nor its friction has a lever arm about the strip: the theory's strip has
no thickness. What shows above and below the line is skin.
"""

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np
from dm_control import mjcf
from numpy.typing import NDArray

from analytic.chain import joint_springs, link_lengths, node_positions, sealed_springs
from mjsim.bodies.parts import FAR, PALE, TENDONS, pad_friction, rounded, template, tendon_bound
from mjsim.bodies.pneumatics import add_actuators, chamber_pressure, controls
from mjsim.scene import Numerics, Scene
from mjsim.video.skin import segment_skin

Array = NDArray[np.float64]


def strip(scene: Scene, numerics: Numerics) -> mjcf.RootElement:
    """The strip alone, flat along +x, its left end at the origin of its neutral line."""
    robot, links = scene.robot, numerics.links
    root = template("strip.xml", scene, numerics)
    lengths = link_lengths(robot, links)
    stiffness, rest = joint_springs(robot, links, np.zeros((1, len(robot.segments))))
    damping = numerics.damping_time * stiffness[0]

    far = root.worldbody.add("site", name="far", pos=(-FAR, 0, 0))
    parent, offset, ends = root.worldbody, 0.0, []
    for i, length in enumerate(lengths):
        body = parent.add("body", name=f"link_{i}", pos=(offset, 0, 0))
        if i == 0:
            body.add("joint", name="x", type="slide", axis=(1, 0, 0))
            body.add("joint", name="z", type="slide", axis=(0, 0, 1))
            body.add("joint", name="pitch")
        else:
            body.add("joint", name=f"hinge_{i}", stiffness=rounded(stiffness[0, i - 1]),
                     damping=rounded(damping[i - 1]), springref=rest[0, i - 1])  # fmt: skip
        mass = robot.weight_per_length / scene.gravity * length
        inertia = mass * length**2 / 12  # a thin rod, as in the theory
        body.add("inertial", pos=(rounded(length / 2), 0, 0), mass=rounded(mass),
                 diaginertia=(rounded(inertia),) * 3)  # fmt: skip
        _add_pad(body, scene, numerics, i)
        if i == 0:
            ends.append(body.add("site", name="end_left"))
        if i == links:
            tip = (rounded(length), 0, 0)
            _add_pad(body, scene, numerics, i + 1, pos=tip)
            ends.append(body.add("site", name="end_right", pos=tip))
        parent, offset = body, rounded(length)

    _add_friction_tendons(root, scene, far, *ends)
    if scene.actuation == "actuators":
        add_actuators(root, scene, numerics)
    return root


def add_skins(root: mjcf.RootElement, scene: Scene, numerics: Numerics) -> None:
    """Give a strip what it looks like, a skin a segment."""
    for segment in range(len(scene.robot.segments)):
        _add_skin(root, scene, numerics, segment)


def _add_pad(body: Any, scene: Scene, numerics: Numerics, node: int, **place: Any) -> None:
    if scene.friction == "coulomb":
        place["friction"] = pad_friction(scene, node in (0, numerics.links + 1))
    body.add("geom", name=f"pad_{node}", size=(numerics.pad_radius,), **place)


def _add_friction_tendons(
    root: mjcf.RootElement, scene: Scene, far: Any, left: Any, right: Any
) -> None:
    for name, ends in zip(TENDONS, ((left,), (right,), (left, right)), strict=True):
        tendon = root.tendon.add("spatial", name=name, frictionloss=tendon_bound(scene))
        for i, end in enumerate(ends):
            if i > 0:
                tendon.add("pulley", divisor=1)
            tendon.add("site", site=far)
            tendon.add("site", site=end)


def _add_skin(root: mjcf.RootElement, scene: Scene, numerics: Numerics, segment: int) -> None:
    skin = segment_skin(scene.robot, numerics.links, segment, numerics.pad_radius)
    nodes = node_positions(scene.robot, numerics.links)
    element = root.deformable.add("skin", name=f"segment_{segment + 1}", rgba=(*PALE, 1),
                                  vertex=np.round(skin.vertex, 7).ravel(),
                                  face=skin.face.ravel())  # fmt: skip
    for link, moved, weight in skin.bones:
        body = root.find("body", f"link_{link}")
        element.add("bone", body=body, bindpos=(rounded(nodes[link]), 0, 0), bindquat=(1, 0, 0, 0),
                    vertid=moved, vertweight=np.round(weight, 6))  # fmt: skip


class Drive:
    """What pressure does to the joints, step by step.

    Args:
        model, data: as compiled.
        scene, numerics: what is simulated.
        command: of the valves at each step, (T, S) [Pa].

    Attributes:
        set: give the joints the springs of a step.
        slopes: of the left and the right end as they are, positive where the strip rises inwards
            [rad].
        shift: move the whole strip by -x [m].
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        scene: Scene,
        numerics: Numerics,
        command: Array,
    ) -> None:
        # the joints are x, z, pitch, then the hinges, each with one coordinate
        robot, links = scene.robot, numerics.links
        spring_k, spring_rest = model.jnt_stiffness[3:], model.qpos_spring[3:]
        qpos, angles, turns = data.qpos, data.qpos[2:], data.qpos[3:]
        add_up = np.ones(links + 1).dot
        control = data.ctrl

        if scene.actuation == "actuators":
            sequence = list(controls(scene, numerics, command))
        elif scene.chamber != "sealed":
            pressure = chamber_pressure(scene, numerics, command)
            springs = list(zip(*joint_springs(robot, links, pressure, scene.chamber), strict=True))
        else:
            pressure = chamber_pressure(scene, numerics, command)

        def set_springs(step: int) -> None:
            spring_k[:], spring_rest[:] = springs[step]

        def set_tangents(step: int) -> None:
            spring_k[:], spring_rest[:] = sealed_springs(robot, links, pressure[step], turns)

        def set_controls(step: int) -> None:
            control[:] = sequence[step]

        def slopes() -> tuple[float, float]:
            return angles.item(0), -add_up(angles)

        def shift(distance: float) -> None:
            qpos[0] -= distance

        self.set: Callable[[int], None] = set_springs
        if scene.actuation == "actuators":
            self.set = set_controls
        elif scene.chamber == "sealed":
            self.set = set_tangents
        self.slopes: Callable[[], tuple[float, float]] = slopes
        self.shift: Callable[[float], None] = shift
