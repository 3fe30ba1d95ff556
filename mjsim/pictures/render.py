"""Pictures of a walk: MuJoCo's renderer posed from a trajectory, no simulation in it."""

from types import TracebackType

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from mjsim.pictures.strip_look import StripLook
from mjsim.results.trajectory import Trajectory

Frame = NDArray[np.uint8]

_POINTER = (0.10, 0.30, 0.75, 1.0)  # the left end now, beside the red mark of its start
_ANCHOR = (20, 150, 60)  # the triangle under the end that stays
_FRONT = -0.0225  # y just before the strip, of the stage of the default robot [m]
_MARGIN = 0.25  # of the length that the robot may go before the camera follows


class Camera:
    """Draws one walk, of any body by its trace in the x-z plane.

    Close it, or use it in a `with`, as it holds an OpenGL context.

    Args:
        walk: what to draw.
        width, height: of a frame, even [pixels]; at most 1280 x 720.
        view: a camera of mjsim/model/stage.xml.
    """

    def __init__(self, walk: Trajectory, width: int, height: int, view: str = "side") -> None:
        self._walk, self._view = walk, view
        reach = float(np.abs(walk.line[..., 0]).max()) + 3 * walk.scene.robot.length
        self._look = StripLook(walk.scene, walk.numerics, reach)
        self._model, self._data = self._look.model, self._look.data
        self._camera_x = self._model.cam_pos[:, 0].copy()
        self._renderer = mujoco.Renderer(self._model, height, width)
        self._options = mujoco.MjvOption()
        mujoco.mjv_defaultOption(self._options)
        self._options.geomgroup[3] = False  # contact pads
        self._options.flags[mujoco.mjtVisFlag.mjVIS_TENDON] = False

    def __enter__(self) -> "Camera":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Free the OpenGL context."""
        self._renderer.close()

    def frame(self, step: int) -> Frame:
        """The walk after a step, shape (height, width, 3)."""
        walk = self._walk
        self._model.cam_pos[:, 0] = self._camera_x + self._followed(step)
        fractions = walk.pressure[step] / walk.scene.robot.peak_pressure
        self._look.pose(walk.position[step], walk.coordinates[step], fractions)
        self._renderer.update_scene(self._data, self._view, self._options)
        self._point_at(float(walk.line[step, 0, 0]))
        return self._mark_anchor(self._renderer.render(), step)

    def _followed(self, step: int) -> float:
        """How far the camera has gone with a robot that went far [m]."""
        first, now = self._walk.line[[0, step]][:, [0, -1], 0].mean(axis=1)
        gone = float(now - first)
        margin = _MARGIN * self._walk.scene.robot.length
        return float(np.sign(gone) * max(abs(gone) - margin, 0.0))

    def _point_at(self, x: float) -> None:
        """A thin blue line on the ground under the left end."""
        size = np.array([0.0004, 0.0296, 0.0006]) * self._look.scale
        self._add(mujoco.mjtGeom.mjGEOM_BOX, size, np.array([x, 0.0, size[2]]), _POINTER)

    def _mark_anchor(self, picture: Frame, step: int) -> Frame:
        """A green triangle under the end that stays."""
        end = anchored(self._walk, step)
        if end is None:
            return picture
        x = float(self._walk.line[step, end, 0])
        column, line = self._pixel(np.array([x, _FRONT * self._look.scale, 0.0]))
        image = Image.fromarray(picture)
        size = len(picture) / 720
        apex, low, half = line + 3 * size, line + 27 * size, 14 * size
        ImageDraw.Draw(image).polygon(
            [(column, apex), (column - half, low), (column + half, low)], fill=_ANCHOR,
            outline="white",
        )  # fmt: skip
        return np.array(image)

    def _pixel(self, place: NDArray[np.float64]) -> tuple[float, float]:
        """Column and line where a point of the scene is seen."""
        camera = self._model.camera(self._view).id
        turned = self._data.cam_xmat[camera].reshape(3, 3).T @ (place - self._data.cam_xpos[camera])
        lines, columns = self._renderer.height, self._renderer.width
        reach = 0.5 * lines / np.tan(0.5 * np.deg2rad(self._model.cam_fovy[camera]))
        x, y = turned[:2] / -turned[2] * reach
        return 0.5 * columns + float(x), 0.5 * lines - float(y)

    def _add(
        self,
        kind: mujoco.mjtGeom,
        size: NDArray[np.float64],
        place: NDArray[np.float64],
        colour: tuple[float, ...],
    ) -> None:
        scene = self._renderer.scene
        rgba = np.array(colour, dtype=np.float32)
        mujoco.mjv_initGeom(scene.geoms[scene.ngeom], kind, size, place, np.eye(3).ravel(), rgba)
        scene.ngeom += 1


def anchored(walk: Trajectory, step: int) -> int | None:
    """The end that stays after a step, 0 for the left and -1 for the right; None if neither."""
    if walk.time[step] <= 0 or walk.time[step] >= walk.scene.cycles * walk.scene.gait.period:
        return None
    return {0.0: 0, 1.0: -1}.get(float(walk.left_slip_fraction[step]))
