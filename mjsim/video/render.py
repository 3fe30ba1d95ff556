"""Pictures of a walk: MuJoCo's renderer posed from a trajectory, no simulation in it."""

from dataclasses import replace
from types import TracebackType

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from analytic.ground import Patches
from analytic.robot import Robot
from analytic.surface import Ground
from mjsim.bodies.parts import DARK, PALE
from mjsim.mjcf.builder import scene_spec
from mjsim.scene import Numerics
from mjsim.simulation.trajectory import Trajectory
from mjsim.video.skin import add_skins

Frame = NDArray[np.uint8]

_POINTER = (0.10, 0.30, 0.75, 1.0)  # the left end now, beside the red mark of its start
_ANCHOR = (20, 150, 60)  # the triangle under the end that stays
_FRONT = -0.0225  # y just before the strip, of the stage of the default robot [m]
_RULED = (0.08, 0.20)  # lengths of robots that the ruler suits [m]
_MARGIN = 0.25  # of the length that the robot may go before the camera follows


class Camera:
    """Draws one walk, of any body by its trace in the x-z plane.

    Close it, or use it in a `with`, as it holds an OpenGL context.

    Args:
        walk: what to draw.
        width, height: of a frame, even [pixels]; at most 1280 x 720.
        view: a camera of mjsim/ground/stage.xml.
    """

    def __init__(self, walk: Trajectory, width: int, height: int, view: str = "side") -> None:
        self._walk, self._view = walk, view
        drawn_as = replace(
            walk.scene, body="planar", friction="constant", actuation="rest-angles",
            chamber="linearized", ground=_visible(walk),
        )  # fmt: skip
        numerics = Numerics(links=walk.numerics.links).resolved("planar", "constant")
        spec = scene_spec(drawn_as, numerics)
        add_skins(spec, walk.scene.robot, numerics)
        self._model = spec.compile()
        self._scale = walk.scene.robot.length / Robot.length
        self._fit()
        self._data = mujoco.MjData(self._model)
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
        walk, model, data = self._walk, self._model, self._data
        x, _, z = walk.position[step, 0]
        slopes = walk.slopes(step)
        data.qpos[:] = (x, z, slopes[0], *np.diff(slopes))
        model.cam_pos[:, 0] = self._camera_x + self._followed(step)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_camlight(model, data)
        fraction = walk.pressure[step] / walk.scene.robot.peak_pressure
        pale, dark = np.array([*PALE, 1.0]), np.array([*DARK, 1.0])
        for segment in range(len(fraction)):
            model.skin_rgba[segment] = pale + min(fraction[segment], 1.0) * (dark - pale)
        self._renderer.update_scene(data, self._view, self._options)
        self._point_at(float(x))
        return self._mark_anchor(self._renderer.render(), step)

    def _fit(self) -> None:
        """Scale the stage to the robot, and stretch the ground to how far it goes."""
        model, scale = self._model, self._scale
        reach = float(np.abs(self._walk.position[..., 0]).max()) + 3 * self._walk.scene.robot.length
        model.stat.extent *= scale
        model.cam_pos[:] *= scale
        patched = isinstance(self._walk.scene.ground, Patches)  # lengths along x are as they are
        grounds = [name for name in (model.geom(i).name for i in range(model.ngeom))
                   if name.startswith("surface")]  # fmt: skip
        for name in (*grounds, "ruler", "start", "table"):
            geom, x = model.geom(name).id, slice(1 if patched and name in grounds else 0, None)
            model.geom_pos[geom, x] *= scale
            model.geom_size[geom, x] *= scale
            if name in grounds and not patched:
                model.geom_size[geom, 0] = max(model.geom_size[geom, 0], reach)
        if not _RULED[0] <= self._walk.scene.robot.length <= _RULED[1]:
            model.geom_rgba[model.geom("ruler").id, 3] = 0.0
        else:  # its ticks are centimetres, whatever the robot's length
            ruler = model.geom("ruler").id
            model.geom_pos[ruler, 0] /= scale
            model.geom_size[ruler, :2] /= scale
        self._camera_x = model.cam_pos[:, 0].copy()

    def _followed(self, step: int) -> float:
        """How far the camera has gone with a robot that went far [m]."""
        first, now = self._walk.position[[0, step]][:, [0, -1], 0].mean(axis=1)
        gone = float(now - first)
        margin = _MARGIN * self._walk.scene.robot.length
        return float(np.sign(gone) * max(abs(gone) - margin, 0.0))

    def _point_at(self, x: float) -> None:
        """A thin blue line on the ground under the left end."""
        size = np.array([0.0004, 0.0296, 0.0006]) * self._scale
        self._add(mujoco.mjtGeom.mjGEOM_BOX, size, np.array([x, 0.0, size[2]]), _POINTER)

    def _mark_anchor(self, picture: Frame, step: int) -> Frame:
        """A green triangle under the end that stays."""
        end = anchored(self._walk, step)
        if end is None:
            return picture
        x = float(self._walk.position[step, end, 0])
        column, line = self._pixel(np.array([x, _FRONT * self._scale, 0.0]))
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


def _visible(walk: Trajectory) -> Ground:
    """A ground that looks the same and that constant bounds can act on."""
    if isinstance(walk.scene.ground, Patches):
        return walk.scene.ground
    surface = walk.scene.ground.at(0.0)
    side = surface.shear_strength or surface.friction
    tip = surface.tip_force or surface.tip_friction or 0.0
    return replace(surface, name=walk.scene.ground.name, tip_force=tip, shear_strength=side)
