"""One picture at a time of a strip that goes on: what an environment shows."""

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from mjsim.pictures.look import Look
from mjsim.scene import Scene

_REACH = 10.0  # lengths of ground that are shown; chosen


class Still:
    """A camera that goes with the robot.

    Args:
        scene, links: what is looked at.
        width, height: of the picture [pixels].
        view: a camera of mjsim/model/stage.xml.
    """

    def __init__(
        self, scene: Scene, links: int, width: int = 480, height: int = 240, view: str = "side"
    ) -> None:
        self._look, self._view = Look(scene, links, _REACH * scene.robot.length), view
        self._camera_x = self._look.model.cam_pos[:, 0].copy()
        self._options = mujoco.MjvOption()
        mujoco.mjv_defaultOption(self._options)
        self._options.geomgroup[3] = False  # contact pads
        self._options.flags[mujoco.mjtVisFlag.mjVIS_TENDON] = False
        self._renderer = mujoco.Renderer(self._look.model, height, width)

    def draw(self, nodes: NDArray[np.float64], fractions: ArrayLike) -> NDArray[np.uint8]:
        """The strip through its nodes, (N + 2, 3) [m], chambers filled by fractions of the peak."""
        left = float(nodes[0, 0])
        self._look.model.cam_pos[:, 0] = self._camera_x + left
        self._look.pose(nodes, np.asarray(fractions, dtype=float))
        self._renderer.update_scene(self._look.data, self._view, self._options)
        return np.asarray(self._renderer.render())

    def close(self) -> None:
        """Free the OpenGL context."""
        self._renderer.close()
