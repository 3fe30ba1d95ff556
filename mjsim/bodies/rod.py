"""The rod body: MJCF's `<flexcomp dim="1">`, MuJoCo's discrete elastic rod of point masses.

MuJoCo bends it as an isotropic rod without twist that is straight at rest, with the moment
D/h g(phi), g(phi) = 2 tan(phi/2) / cos(phi/2)^2, at a vertex where it turns by phi. Pressure is put
on top as couples on the edges beside each vertex, D/h g(r): they balance where the rod turns by the
rest angle r. The rigidity is divided by g'(r), so that the stiffness about that angle is the
pneu-net's. Edges are held by equality constraints: a strain-limiting layer does not stretch.

A rod has no width to stand on. The couples are in the x-z plane whatever the rod does, and so hold
it upright.
"""

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.chain import joint_springs, link_lengths
from mjsim.bodies import parts
from mjsim.bodies.body import Joints
from mjsim.scene import Numerics, Scene

Array = NDArray[np.float64]

_RADIUS = 1e-3  # of the section MuJoCo thinks of, whose rigidity is overwritten [m]
_PER_VERTEX = 4  # numbers of flex_bending a vertex, after the count: three vertices and a rigidity

_FLEXCOMP = """
<mujoco model="robot">
  <compiler angle="radian" autolimits="true"/>
  <default><site size="0.0006" group="4" rgba="0.8 0.2 0.2 1"/></default>
  <worldbody>
    <flexcomp name="rod" type="direct" dim="1" point="{point}" element="{element}"
              radius="{radius}" mass="1">
      <edge equality="true" solref="{edge_time:.17g} 1" solimp="0.9999 0.9999 0.001 0.5 2"/>
      <elasticity young="1" poisson="0" damping="{damping:.17g}"/>
      <contact contype="0" conaffinity="0" selfcollide="none"/>
    </flexcomp>
  </worldbody>
</mujoco>
"""


class Rod:
    """See mjsim.bodies.body.Body."""

    name = "rod"

    def check(self, scene: Scene, numerics: Numerics) -> None:
        """Neither actuators nor sealed chambers."""
        parts.refuse_planar_only(self.name, scene)

    def spec(self, scene: Scene, numerics: Numerics) -> mujoco.MjSpec:
        """The flexcomp, its vertices given their masses, pads and friction."""
        robot, links = scene.robot, numerics.links
        edges = np.column_stack([np.arange(links + 1), np.arange(1, links + 2)]).ravel()
        assert numerics.edge_time is not None
        spec = mujoco.MjSpec.from_string(
            _FLEXCOMP.format(
                point=parts.vertices(scene, numerics),
                element=" ".join(map(str, edges.tolist())),
                radius=_RADIUS,
                edge_time=numerics.edge_time * numerics.timestep,
                damping=numerics.damping_time,
            )
        )
        half = 0.5 * robot.weight_per_length / scene.gravity * link_lengths(robot, links)
        mass = np.concatenate([[0.0], half]) + np.concatenate([half, [0.0]])
        bodies = [spec.body(f"rod_{i}") for i in range(links + 2)]
        for i, body in enumerate(bodies):
            body.explicitinertial, body.mass = True, mass[i]
            body.inertia = [mass[i] * _RADIUS**2] * 3  # a point does not turn
            parts.add_pads(body, scene, numerics, i, [(0.0, 0.0, 0.0)])
        parts.add_ends(spec, scene, [(body, (0.0, 0.0, 0.0)) for body in bodies])
        for i, body in enumerate(bodies):
            # a rod has no width: every vertex is kept in the plane, not its ends alone
            if not body.sites and scene.friction != "coulomb":
                body.add_site(name=f"node_{i}", size=[6e-4] * 3, group=4)
        parts.hold_sideways(spec, scene, numerics)
        return spec

    def bind(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Numerics
    ) -> Joints:
        """The vertices."""
        return _Vertices(model, data, scene, numerics)


def half_stiffness(model: mujoco.MjModel) -> Array:
    """Half the stiffness of each inner vertex, (N,) [N m/rad], to be written to."""
    return model.flex_bending[_PER_VERTEX::_PER_VERTEX]


def rest_stiffness(model: mujoco.MjModel, scene: Scene, links: int) -> None:
    """Give the vertices the stiffness of a strip without pressure, which compiling does not."""
    stiffness, _ = joint_springs(scene.robot, links, np.zeros((1, len(scene.robot.segments))))
    half_stiffness(model)[:] = 0.5 * stiffness[0]


class _Vertices:
    """Stiffness of the vertices and couples on the edges, set at each step."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Numerics
    ) -> None:
        self._scene, self._links = scene, numerics.links
        self._lengths = link_lengths(scene.robot, numerics.links)
        self._bending = half_stiffness(model)
        self._qpos = data.qpos.reshape(-1, 3)
        self._force = data.qfrc_applied.reshape(-1, 3)

    def loads(self, valves: Array, before: Array, pressures: Array) -> Sequence[Any]:
        scene, links = self._scene, self._links
        stiffness, rest = joint_springs(scene.robot, links, pressures, scene.chamber)
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
        first, last = self._lengths[0], self._lengths[-1]
        return (z1 - z0) / (x1 - x0 + first), (z2 - z3) / (x3 - x2 + last)

    def shift(self, distance: float) -> None:
        self._qpos[:, 0] -= distance


BODY = Rod()
