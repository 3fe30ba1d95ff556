"""Pictures of a strip's walk: MuJoCo's renderer posed from a trajectory, no simulation in it."""

import mujoco
import numpy as np
from PIL import Image, ImageDraw

from mjsim.pictures.camera import WalkCamera
from mjsim.pictures.frames import Frame
from mjsim.pictures.looks.strip_look import scale_of
from mjsim.results.plots import anchored
from mjsim.results.trajectory import Trajectory

_POINTER = (0.10, 0.30, 0.75, 1.0)  # the left end at present, beside the red mark of its start
_POINTER_SIZE = (0.0004, 0.0296, 0.0006)  # half of it, on the stage of the default robot [m]
_ANCHOR = (20, 150, 60)  # the triangle under the end that stays
_FRONT = -0.0225  # y just before the strip, of the stage of the default robot [m]


class Camera(WalkCamera):
    """Draws one walk of a strip, of any body by its trace in the x-z plane; see WalkCamera.

    Args:
        walk: what to draw.
        width, height: of a frame, even [pixels]; at most 1280 x 720.
        view: a camera of mjsim/model/appearance/stage.xml.
    """

    def __init__(self, walk: Trajectory, width: int, height: int, view: str = "side") -> None:
        super().__init__(walk, {view: (width, height)})

    def _picture(self, step: int) -> Frame:
        """A thin blue line on the ground under the left end, and a mark of the anchored end."""
        (view,), scale = self.views, scale_of(self.walk.scene)
        size = scale * np.array(_POINTER_SIZE)
        place = (self.walk.line[step, 0, 0], 0.0, size[2])
        view.add(mujoco.mjtGeom.mjGEOM_BOX, size, place, _POINTER)
        picture, end = view.render(), anchored_end(self.walk, step)
        if end is None:
            return picture
        return _marked(picture, view.pixel((self.walk.line[step, end, 0], _FRONT * scale, 0.0)))


def _marked(picture: Frame, pixel: tuple[float, float]) -> Frame:
    """A copy with a green triangle below a pixel."""
    image = Image.fromarray(picture)
    (column, line), size = pixel, len(picture) / 720
    apex, low, half = line + 3 * size, line + 27 * size, 14 * size
    ImageDraw.Draw(image).polygon(
        [(column, apex), (column - half, low), (column + half, low)], fill=_ANCHOR,
        outline="white",
    )  # fmt: skip
    return np.array(image)


def anchored_end(walk: Trajectory, step: int) -> int | None:
    """The end that stays after a step, 0 for the left and -1 for the right; None if neither."""
    if walk.time[step] <= 0 or walk.time[step] >= walk.scene.cycles * walk.scene.gait.period:
        return None
    return next((end for end in (0, -1) if anchored(walk, end)[step]), None)
