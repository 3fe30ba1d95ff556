"""One picture at a time of a robot that goes on: what an environment shows."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mjsim.model.appearance.limb_skins import CAMERA
from mjsim.pictures.camera import View, look
from mjsim.pictures.frames import Frame
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
        self._view = View(self._look, CAMERA if scene.in_space else "side", width, height)

    def draw(
        self, position: NDArray[np.float64], coordinates: NDArray[np.float64], fractions: ArrayLike
    ) -> Frame:
        """The robot as it is, see mjsim.pictures.looks.look.Look.pose."""
        self._look.pose(position, coordinates, np.asarray(fractions, dtype=float))
        self._view.update()
        return self._view.render()

    def close(self) -> None:
        """Free the OpenGL context."""
        self._view.close()
