"""The rod body: MJCF's `<flex dim="1">`, MuJoCo's discrete elastic rod of point masses.

MuJoCo bends it as an isotropic rod without twist that is straight at rest, with the moment
D/h g(phi), g(phi) = 2 tan(phi/2) / cos(phi/2)^2, at a vertex where it turns by phi. Pressure is put
on top as couples on the edges beside each vertex, D/h g(r): they balance where the rod turns by the
rest angle r. The rigidity is divided by g'(r), so that the stiffness about that angle is the
pneu-net's. Edges are held by equality constraints: a strain-limiting layer does not stretch.

A rod has no width to stand on. The couples are in the x-z plane whatever the rod does, and so keep
it upright. The flex is written out, since MuJoCo 4's `<flexcomp>` adds a joint a twisting edge.
"""

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import joint_springs, link_lengths, node_positions, payload_on_nodes
from mjsim.model.bodies import parts
from mjsim.model.bodies.body import Joints
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

_RIGIDITY = {4: 3, 10: 4}  # where it is in a vertex's numbers of flex_bending, MuJoCo 3's and 4's
_RADIUS = 1e-3  # of the section MuJoCo thinks of, whose rigidity is overwritten [m]


class Rod:
    """See mjsim.model.bodies.body.Body."""

    name = "rod"

    def check(self, scene: Scene, numerics: Resolved) -> None:
        """Refuse actuators and sealed chambers."""
        parts.refuse_chain_only(self.name, scene)

    def spec(self, scene: Scene, numerics: Resolved) -> mujoco.MjSpec:
        """Point masses on slides along each axis, and the flex through them."""
        robot, links = scene.strip, numerics.links
        spec = parts.template()
        half = 0.5 * robot.weight_per_length / scene.gravity * link_lengths(robot, links)
        mass = np.concatenate([[0.0], half]) + np.concatenate([half, [0.0]])
        mass += payload_on_nodes(robot, links) / scene.gravity
        bodies = []
        for i, x in enumerate(node_positions(robot, links).tolist()):
            body = spec.worldbody.add_body(name=f"rod_{i}", pos=(x, 0, 0))
            for axis in np.eye(3):
                body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
            body.explicitinertial, body.mass, body.ipos = True, mass[i], parts.ORIGIN
            body.inertia = [mass[i] * _RADIUS**2] * 3  # a point does not turn
            parts.add_pads(body, scene, numerics, i, [parts.ORIGIN])
            bodies.append(body)
        _join(spec, bodies, numerics)
        parts.add_ends(spec, scene, [(body, parts.ORIGIN) for body in bodies])
        for i, body in enumerate(bodies):
            # a rod has no width: every vertex is kept in the plane, not its ends alone
            if not body.sites and scene.friction != "coulomb":
                body.add_site(name=f"node_{i}", size=[6e-4] * 3, group=4)
        parts.hold_sideways(spec, scene, numerics)
        return spec

    def bind(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Resolved
    ) -> Joints:
        """The vertices."""
        return _Vertices(model, data, scene, numerics)


def _join(spec: mujoco.MjSpec, bodies: Sequence[mujoco.MjsBody], numerics: Resolved) -> None:
    """Let the edges between bodies resist bending, and fix their lengths."""
    flex = spec.add_flex(name="rod", dim=1, radius=_RADIUS, young=1.0)
    flex.damping, flex.contype, flex.conaffinity = numerics.damping_time, 0, 0
    flex.selfcollide = mujoco.mjtFlexSelf.mjFLEXSELF_NONE
    flex.vertbody = [body.name for body in bodies]
    vertices = np.arange(len(bodies))
    flex.elem = np.column_stack([vertices[:-1], vertices[1:]]).ravel()
    lengths = spec.add_equality(type=mujoco.mjtEq.mjEQ_FLEX, name1=flex.name)
    lengths.solref[:] = numerics.edge_time * numerics.timestep, 1.0
    lengths.solimp[:3] = 0.9999, 0.9999, 0.001


def half_stiffness(model: mujoco.MjModel) -> Array:
    """Half the stiffness of each inner vertex, (N,) [N m/rad], to be written to."""
    count = int(model.flex_bending[0])
    records = model.flex_bending[1:].reshape(count, -1)
    return records[:, _RIGIDITY[records.shape[1]]]


def rest_stiffness(model: mujoco.MjModel, scene: Scene, links: int) -> None:
    """Give the vertices the stiffness of a strip without pressure, which compiling does not."""
    stiffness, _ = joint_springs(scene.strip, links, np.zeros((1, len(scene.strip.segments))))
    half_stiffness(model)[:] = 0.5 * stiffness[0]


class _Vertices:
    """Stiffness of the vertices and couples on the edges, set at each step."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Resolved
    ) -> None:
        self._scene, self._links = scene, numerics.links
        self._lengths = link_lengths(scene.strip, numerics.links)
        self._bending = half_stiffness(model)
        self._qpos = data.qpos.reshape(-1, 3)
        self._force = data.qfrc_applied.reshape(-1, 3)

    def loads(self, valves: Array, before: Array, pressures: Array) -> Sequence[Any]:
        scene, links = self._scene, self._links
        stiffness, rest = joint_springs(scene.strip, links, pressures, scene.chamber)
        tan, cos2 = np.tan(rest / 2), np.cos(rest / 2) ** 2
        stiffness = stiffness * cos2 / (1 + 3 * tan**2)  # over g'(r)
        couple = np.zeros((len(pressures), links + 2))  # none at the two ends
        couple[:, 1:-1] = stiffness * 2 * tan / cos2
        return list(zip(0.5 * stiffness, couple, strict=True))

    def apply(self, load: Any) -> None:
        self._bending[:], couple = load
        edge = np.diff(self._qpos, axis=0)
        edge[:, 0] += self._lengths
        turning = -np.diff(couple) / (edge[:, 0] ** 2 + edge[:, 2] ** 2)
        push = np.zeros((self._links + 2, 2))
        push[1:, 0], push[1:, 1] = -turning * edge[:, 2], turning * edge[:, 0]
        push[:-1] -= push[1:].copy()
        self._force[:, 0], self._force[:, 2] = push[:, 0], push[:, 1]

    def slopes(self) -> tuple[float, float]:
        (x0, _, z0), (x1, _, z1) = self._qpos[0], self._qpos[1]
        (x2, _, z2), (x3, _, z3) = self._qpos[-2], self._qpos[-1]
        left, right = self._lengths[0], self._lengths[-1]
        return (z1 - z0) / (x1 - x0 + left), (z2 - z3) / (x3 - x2 + right)

    def shift(self, distance: float) -> None:
        self._qpos[:, 0] -= distance


BODY = Rod()
