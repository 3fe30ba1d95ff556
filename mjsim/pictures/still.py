"""One picture at a time of a robot that goes on: what an environment shows."""

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from mjsim.model.limb_skins import CAMERA
from mjsim.pictures.looks import look
from mjsim.scene import Numerics, Scene

_REACH = 10.0  # lengths of ground that are shown; chosen


class Still:
    """A camera that goes with the robot.

    Args:
        scene, numerics: what is looked at.
        width, height: of the picture [pixels].
    """

    def __init__(
        self, scene: Scene, numerics: Numerics, width: int = 480, height: int = 240
    ) -> None:
        self._look = look(scene, numerics, _REACH * scene.robot.length)
        self._view = CAMERA if scene.in_space else "side"
        self._camera_x = self._look.model.cam_pos[:, 0].copy()
        self._options = mujoco.MjvOption()
        mujoco.mjv_defaultOption(self._options)
        self._options.geomgroup[3] = False  # contact pads
        self._options.flags[mujoco.mjtVisFlag.mjVIS_TENDON] = False
        self._renderer = mujoco.Renderer(self._look.model, height, width)

    def draw(
        self, position: NDArray[np.float64], coordinates: NDArray[np.float64], fractions: ArrayLike
    ) -> NDArray[np.uint8]:
        """The robot as it is, see mjsim.pictures.look.Look.pose."""
        self._look.model.cam_pos[:, 0] = self._camera_x + float(position[0, 0, 0])
        self._look.pose(position, coordinates, np.asarray(fractions, dtype=float))
        self._renderer.update_scene(self._look.data, self._view, self._options)
        return np.asarray(self._renderer.render())

    def close(self) -> None:
        """Free the OpenGL context."""
        self._renderer.close()
