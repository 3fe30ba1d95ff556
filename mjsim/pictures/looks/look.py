"""Looks of a robot on its ground: a skinned model that is posed, and never stepped."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.limbs import limbs_of, rotation
from mjsim.results.shades import shade
from mjsim.scene import Scene

Array = NDArray[np.float64]

RULED = (0.08, 0.20)  # lengths of robots that the ruler suits [m]
_MARGIN = 0.25  # of the length that the robot may go before the cameras follow; chosen


class Look:
    """A scene's looks; its cameras follow a robot that goes far.

    Args:
        spec: of the robot with its skins, one per chamber in a gait's order, on its ground.
        scene: what is shown.

    Attributes:
        model, data: MuJoCo's, of the picture alone.
        grounds: numbers of the geoms that are ground.
        cameras: where the cameras stand beside the robot at rest, (cameras, 2) [m].
    """

    def __init__(self, spec: mujoco.MjSpec, scene: Scene) -> None:
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        names = [self.model.geom(number).name for number in range(self.model.ngeom)]
        self.grounds = [i for i, name in enumerate(names) if name.startswith("surface")]
        self.cameras = self.model.cam_pos[:, :2].copy()
        trunk = limbs_of(scene.robot)[0]
        self._middle = 0.5 * trunk.strip.length * rotation(trunk.angle)[:, 0]  # at rest
        self._margin = _MARGIN * scene.robot.length

    def pose(self, position: Array, coordinates: Array, fractions: Array) -> None:
        """Bend the robot, colour its chambers and let the cameras follow.

        Args:
            position: vertices of its neutral lines, z over flat rest, (L, N + 2, 3) [m].
            coordinates: of MuJoCo as it was simulated, (nq,).
            fractions: of the peak pressure, (S,).
        """
        self._bend(position, coordinates)
        gone = position[0, [0, -1], :2].mean(axis=0) - self._middle
        followed = np.sign(gone) * np.maximum(np.abs(gone) - self._margin, 0.0)
        self.model.cam_pos[:, :2] = self.cameras + followed
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_camlight(self.model, self.data)
        for chamber, fraction in enumerate(fractions):
            self.model.skin_rgba[chamber, :3] = shade(fraction)

    def _bend(self, position: Array, coordinates: Array) -> None:
        self.data.qpos[:] = coordinates
