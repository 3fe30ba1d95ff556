"""Pictures of a walk of a robot of limbs, with a view from above in their corner."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.model.appearance.limb_skins import CAMERA
from mjsim.model.bodies.limbs import limbed
from mjsim.pictures.camera import View, WalkCamera
from mjsim.pictures.frames import HEIGHT, WIDTH, Frame
from mjsim.pictures.looks.limb_look import OVERHEAD
from mjsim.pictures.overlay import INK
from mjsim.results.trajectory import Trajectory

Array = NDArray[np.float64]

_INSET, _FRAME = (320, 180), 3  # columns and lines of the view from above; lines around it
_DOTS = 160  # of a track at most
_TALL = 0.15  # L, up to which a robot stays below the title; chosen
_RED, _BLUE = (0.78, 0.12, 0.10, 1.0), (0.10, 0.30, 0.75, 1.0)


class LimbCamera(WalkCamera):
    """Draws one walk of a robot of limbs from its side and from above; see WalkCamera.

    Args:
        walk: what to draw.
    """

    def __init__(self, walk: Trajectory) -> None:
        super().__init__(walk, {CAMERA: (WIDTH, HEIGHT), OVERHEAD: _INSET})
        self._track = _track(walk)
        tall = float(walk.line[..., 2].max()) - _TALL * walk.scene.robot.length
        self.look.model.camera(CAMERA).pos[2] += max(tall, 0.0)

    def _picture(self, step: int) -> Frame:
        """Both views, the one from above with its border in the lower left corner."""
        for view in self.views:
            self._trace(view, step)
        frame, inset = (view.render() for view in self.views)
        columns, lines = _INSET
        frame[-lines - 2 * _FRAME :, : columns + 2 * _FRAME] = INK
        frame[-lines - _FRAME : -_FRAME, _FRAME : columns + _FRAME] = inset
        return frame

    def _trace(self, view: View, step: int) -> None:
        """Dots on the ground where the ends of the limbs have been, and where they began."""
        size = 0.005 * self.walk.scene.robot.length
        steps, places = self._track
        count = int(np.searchsorted(steps, step, side="right"))
        been = places[1:count].reshape(-1, 2)
        for dots, radius, colour in ((been, size, _BLUE), (places[0], 1.6 * size, _RED)):
            for place in dots:
                view.add(mujoco.mjtGeom.mjGEOM_SPHERE, np.full(3, radius), (*place, 0.3 * size),
                         colour)  # fmt: skip


def _track(walk: Trajectory) -> tuple[Array, Array]:
    """Steps of a walk, (S,), and the ends of its outer limbs in plan at them, (S, E, 2) [m]."""
    robot = limbed(walk.scene)
    outer = [robot.place(name) for name in robot.outer]
    steps = np.unique(np.linspace(walk.start, len(walk.time) - 1, _DOTS).astype(int))
    return steps, walk.position[steps][:, outer, -1, :2]
