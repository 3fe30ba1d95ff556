"""The cable body: MJCF's `<composite type="cable">`, rigid links in space joined by ball joints.

Bending is by springs of the ball joints, not by the elasticity plugin: that has the rest curvature
it was compiled with, while a pneu-net's follows the pressure. Ball springs are isotropic, so the
strip resists twist and sideways bending as it does bending in its plane. Two rows of pads, at both
edges of the strip's width, keep it from rolling over.
"""

from collections.abc import Callable

import mujoco
import numpy as np
from dm_control import mjcf
from numpy.typing import NDArray

from analytic.chain import joint_springs, link_lengths, node_positions
from mjsim.bodies.expanded import add_friction_tendons, add_pads
from mjsim.bodies.parts import template
from mjsim.bodies.pneumatics import chamber_pressure
from mjsim.scene import Numerics, Scene

Array = NDArray[np.float64]

_FIRST_SPRING = 7  # coordinate where the first ball joint's quaternion is: after 3 slides and one


def strip(scene: Scene, numerics: Numerics) -> mjcf.RootElement:
    """The composite alone, flat along +x, its left end at the origin; `complete` adds the rest."""
    robot, links = scene.robot, numerics.links
    root = template("strip.xml", scene, numerics)
    nodes = node_positions(robot, links)
    vertex = np.column_stack([nodes, np.zeros((links + 2, 2))]).ravel()
    cable = root.worldbody.add("composite", prefix="cable_", type="cable", initial="none",
                               vertex=vertex)  # fmt: skip
    cable.add("joint", kind="main", stiffness=1.0, damping=1.0)
    cable.geom.type, cable.geom.size = "box", (1e-3, 1e-3, 1e-3)
    return root


def complete(spec: mujoco.MjSpec, scene: Scene, numerics: Numerics) -> None:
    """Give the expanded links their joints, masses, pads and friction."""
    robot, links = scene.robot, numerics.links
    stiffness, _ = joint_springs(robot, links, np.zeros((1, len(robot.segments))))
    names = ["first", *range(1, links), "last"]
    bodies = [spec.body(f"robot/cable_B_{name}") for name in names]
    edges = [(0.5 * side * robot.width, 0.0) for side in (-1, 1)]
    for i, (body, length) in enumerate(zip(bodies, link_lengths(robot, links), strict=True)):
        for geom in list(body.geoms):
            spec.delete(geom)
        mass = robot.weight_per_length / scene.gravity * length
        wide, long = mass * robot.width**2 / 12, mass * length**2 / 12
        body.explicitinertial, body.mass, body.ipos = True, mass, (length / 2, 0.0, 0.0)
        body.inertia = wide, long, wide + long  # a plate without thickness
        places = [(0.0, *edge) for edge in edges]
        add_pads(body, scene, numerics, i, places)
        if i == links:
            add_pads(body, scene, numerics, i + 1, [(length, *edge) for edge in edges])
        if i == 0:
            _free(body)
        else:
            joint = body.joints[0]
            joint.stiffness[0] = stiffness[0, i - 1]
            joint.damping[0] = numerics.damping_time * stiffness[0, i - 1]
    add_friction_tendons(spec, scene, bodies[0], bodies[-1], (length, 0.0, 0.0))


def _free(body: mujoco.MjsBody) -> None:
    """Let a body move freely; MuJoCo's free joint is for children of the world only."""
    for name, axis in zip("xyz", np.eye(3), strict=True):
        body.add_joint(name=f"robot/{name}", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
    body.add_joint(name="robot/turn", type=mujoco.mjtJoint.mjJNT_BALL)


class Drive:
    """What pressure does to the joints, step by step; see mjsim.bodies.planar.Drive."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        scene: Scene,
        numerics: Numerics,
        command: Array,
    ) -> None:
        pressure = chamber_pressure(scene, numerics, command)
        # the joints are x, y, z, the ball of the whole, then those between links
        spring_k = model.jnt_stiffness[4:]
        spring_rest = model.qpos_spring[_FIRST_SPRING:].reshape(-1, 4)
        stiffness, rest = joint_springs(scene.robot, numerics.links, pressure, scene.chamber)
        w, y = np.cos(rest / 2), -np.sin(rest / 2)  # a positive angle turns x to z: about -y
        qpos = data.qpos
        turns = qpos[3:].reshape(-1, 4)

        def set_springs(step: int) -> None:
            spring_k[:] = stiffness[step]
            spring_rest[:, 0], spring_rest[:, 2] = w[step], y[step]

        def slopes() -> tuple[float, float]:
            angles = -2.0 * np.arctan2(turns[:, 2], turns[:, 0])
            return float(angles[0]), -float(angles.sum())

        def shift(distance: float) -> None:
            qpos[0] -= distance

        self.set: Callable[[int], None] = set_springs
        self.slopes: Callable[[], tuple[float, float]] = slopes
        self.shift: Callable[[float], None] = shift
