"""The cable body: rigid links in space joined by ball joints, as in MuJoCo 3's composite cable.

Bending is by springs of the ball joints, whose rest follows the pressure. Ball springs are
isotropic, so the strip resists twist and sideways bending as it does bending in its plane. Two rows
of pads, at both edges of the strip's width, keep it from rolling over.
"""

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import joint_springs
from mjsim.model.bodies import parts
from mjsim.model.bodies.body import Joints
from mjsim.model.bodies.links import add_links
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

_FIRST_JOINT = 4  # the joints are x, y, z, the ball of the whole, then those between links
_WHOLE_BALL = 3  # coordinate where the quaternion of the whole begins, after 3 slides
_FIRST_BALL = 7  # coordinate where that of the first joint between links begins


class Cable:
    """See mjsim.model.bodies.body.Body."""

    name = "cable"

    def check(self, scene: Scene, numerics: Resolved) -> None:
        """Refuse actuators and sealed chambers."""
        parts.refuse_chain_only(self.name, scene)

    def spec(self, scene: Scene, numerics: Resolved) -> mujoco.MjSpec:
        """Links that are carried by each other, the first one free in space."""
        strip, spec = scene.strip, parts.template()
        nodes = add_links(spec.worldbody, strip, scene, numerics, ("link_", "ball_"),
                          mujoco.mjtJoint.mjJNT_BALL, strip.width)  # fmt: skip
        _free(nodes[0][0])
        for number, (body, (x, _, _)) in enumerate(nodes):
            edges = [(x, 0.5 * side * strip.width, 0.0) for side in (-1, 1)]
            parts.add_pads(body, scene, numerics, number, edges)
        parts.add_ends(spec, scene, nodes)
        parts.hold_sideways(spec, scene, numerics)
        return spec

    def bind(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Resolved
    ) -> Joints:
        """The ball joints."""
        return _Balls(model, data, scene, numerics)


class _Balls:
    """Springs of the ball joints, set at each step."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Resolved
    ) -> None:
        self._scene, self._links = scene, numerics.links
        self._stiffness = model.jnt_stiffness[_FIRST_JOINT:]
        self._rest = model.qpos_spring[_FIRST_BALL:].reshape(-1, 4)
        self._qpos = data.qpos
        self._balls = data.qpos[_WHOLE_BALL:].reshape(-1, 4)

    def loads(self, valves: Array, before: Array, pressures: Array) -> Sequence[Any]:
        scene = self._scene
        stiffness, rest = joint_springs(scene.strip, self._links, pressures, scene.chamber)
        # a positive angle turns x to z: about -y
        return list(zip(stiffness, np.cos(rest / 2), -np.sin(rest / 2), strict=True))

    def apply(self, load: Any) -> None:
        self._stiffness[:], self._rest[:, 0], self._rest[:, 2] = load

    def slopes(self) -> tuple[float, float]:
        angles = -2.0 * np.arctan2(self._balls[:, 2], self._balls[:, 0])
        return float(angles[0]), -float(angles.sum())

    def shift(self, distance: float) -> None:
        self._qpos[0] -= distance


def _free(body: mujoco.MjsBody) -> None:
    """Let a body move freely; MuJoCo's free joint is for children of the world only."""
    for name, axis in zip("xyz", np.eye(3), strict=True):
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
    body.add_joint(name="turn", type=mujoco.mjtJoint.mjJNT_BALL)


BODY = Cable()
