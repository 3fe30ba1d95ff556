"""The rod body: MJCF's `<flexcomp dim="1">`, MuJoCo's discrete elastic rod of point masses.

MuJoCo bends it as an isotropic rod without twist that is straight at rest, with the moment
D/h g(phi), g(phi) = 2 tan(phi/2) / cos(phi/2)^2, at a vertex where it turns by phi. Pressure is put
on top as couples on the edges beside each vertex, D/h g(r): they balance where the rod turns by the
rest angle r. The rigidity is divided by g'(r), so that the stiffness about that angle is the
pneu-net's. Edges are held by equality constraints: a strain-limiting layer does not stretch.

A rod has no width to stand on. The couples are in the x-z plane whatever the rod does, and so hold
it upright.
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

_RADIUS = 1e-3  # of the section MuJoCo thinks of, whose rigidity is overwritten [m]
_PER_VERTEX = 4  # numbers of flex_bending a vertex, after the count: three vertices and a rigidity


def strip(scene: Scene, numerics: Numerics) -> mjcf.RootElement:
    """The flexcomp alone, flat along +x, its left end at the origin; `complete` adds the rest."""
    robot, links = scene.robot, numerics.links
    root = template("strip.xml", scene, numerics)
    nodes = node_positions(robot, links)
    point = np.column_stack([nodes, np.zeros((links + 2, 2))]).ravel()
    edges = np.column_stack([np.arange(links + 1), np.arange(1, links + 2)]).ravel()
    rod = root.worldbody.add("flexcomp", name="rod", type="direct", dim=1, point=point,
                             element=edges, radius=_RADIUS, mass=1.0)  # fmt: skip
    rod.edge.equality = "true"
    rod.edge.solref = numerics.edge_time * numerics.timestep, 1.0
    rod.edge.solimp = 0.9999, 0.9999, 0.001, 0.5, 2
    rod.elasticity.young, rod.elasticity.poisson = 1.0, 0.0
    rod.elasticity.damping = numerics.damping_time
    rod.contact.contype, rod.contact.conaffinity, rod.contact.selfcollide = 0, 0, "none"
    return root


def complete(spec: mujoco.MjSpec, scene: Scene, numerics: Numerics) -> None:
    """Give the expanded vertices their masses, pads and friction."""
    robot, links = scene.robot, numerics.links
    half = 0.5 * robot.weight_per_length / scene.gravity * link_lengths(robot, links)
    mass = np.concatenate([[0.0], half]) + np.concatenate([half, [0.0]])
    bodies = [spec.body(f"robot/rod_{i}") for i in range(links + 2)]
    for i, body in enumerate(bodies):
        body.explicitinertial, body.mass = True, mass[i]
        body.inertia = [mass[i] * _RADIUS**2] * 3  # a point does not turn
        add_pads(body, scene, numerics, i, [(0.0, 0.0, 0.0)])
    add_friction_tendons(spec, scene, bodies[0], bodies[-1], (0.0, 0.0, 0.0))


def half_stiffness(model: mujoco.MjModel) -> Array:
    """Half the stiffness of each inner vertex, (N,) [N m/rad], to be written to."""
    return model.flex_bending[_PER_VERTEX::_PER_VERTEX]


def rest_stiffness(model: mujoco.MjModel, scene: Scene, links: int) -> None:
    """Give the vertices the stiffness of a strip without pressure, which compiling does not."""
    stiffness, _ = joint_springs(scene.robot, links, np.zeros((1, len(scene.robot.segments))))
    half_stiffness(model)[:] = 0.5 * stiffness[0]


class Drive:
    """What pressure does to the vertices, step by step; see mjsim.bodies.planar.Drive."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        scene: Scene,
        numerics: Numerics,
        command: Array,
    ) -> None:
        pressure = chamber_pressure(scene, numerics, command)
        links = numerics.links
        nodes, lengths = node_positions(scene.robot, links), link_lengths(scene.robot, links)
        stiffness, rest = joint_springs(scene.robot, links, pressure, scene.chamber)
        tan, cos2 = np.tan(rest / 2), np.cos(rest / 2) ** 2
        stiffness = stiffness * cos2 / (1 + 3 * tan**2)  # over g'(r)
        couple = np.zeros((len(pressure), links + 2))  # none at the two ends
        couple[:, 1:-1] = stiffness * 2 * tan / cos2
        bending = half_stiffness(model)
        qpos, force = data.qpos.reshape(-1, 3), data.qfrc_applied.reshape(-1, 3)

        def set_springs(step: int) -> None:
            bending[:] = 0.5 * stiffness[step]
            edge = np.diff(qpos, axis=0)
            edge[:, 0] += lengths
            turning = -np.diff(couple[step]) / (edge[:, 0] ** 2 + edge[:, 2] ** 2)
            push = np.zeros((links + 2, 2))
            push[1:, 0], push[1:, 1] = -turning * edge[:, 2], turning * edge[:, 0]
            push[:-1] -= push[1:].copy()
            force[:, 0], force[:, 2] = push[:, 0], push[:, 1]

        def slopes() -> tuple[float, float]:
            (x0, _, z0), (x1, _, z1) = qpos[0], qpos[1]
            (x2, _, z2), (x3, _, z3) = qpos[-2], qpos[-1]
            return (z1 - z0) / (x1 - x0 + nodes[1]), (z2 - z3) / (x3 - x2 + lengths[-1])

        def shift(distance: float) -> None:
            qpos[:, 0] -= distance

        self.set: Callable[[int], None] = set_springs
        self.slopes: Callable[[], tuple[float, float]] = slopes
        self.shift: Callable[[float], None] = shift
