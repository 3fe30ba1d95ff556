"""Pictures of a walk: MuJoCo's renderer posed from a trajectory, no simulation in it."""

from dataclasses import replace
from types import TracebackType

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.bodies.parts import DARK, PALE
from mjsim.mjcf.builder import compile_model
from mjsim.simulation.trajectory import Trajectory

Frame = NDArray[np.uint8]

_POINTER = (0.10, 0.30, 0.75, 1.0)  # the left end now, beside the red mark of its start


class Camera:
    """Draws one walk, of any body by its trace in the x-z plane.

    Close it, or use it in a `with`, as it holds an OpenGL context.

    Args:
        walk: what to draw.
        width, height: of a frame, even [pixels]; at most 1280 x 720.
        view: a camera of models/stage.xml, "side" for 16:9 or "band" for a wide strip.
    """

    def __init__(self, walk: Trajectory, width: int, height: int, view: str = "side") -> None:
        self._walk, self._view = walk, view
        drawn_as = replace(walk.scene, body="planar", friction="constant", actuation="rest-angles")
        self._model = compile_model(drawn_as, walk.numerics, skin=True)
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
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_camlight(model, data)
        fraction = walk.pressure[step] / walk.scene.robot.peak_pressure
        pale, dark = np.array([*PALE, 1.0]), np.array([*DARK, 1.0])
        for segment in range(len(fraction)):
            model.skin_rgba[segment] = pale + fraction[segment] * (dark - pale)
        self._renderer.update_scene(data, self._view, self._options)
        self._point_at(float(x))
        return self._renderer.render()

    def _point_at(self, x: float) -> None:
        """A thin blue line on the ground under the left end."""
        scene = self._renderer.scene
        geom = scene.geoms[scene.ngeom]
        mujoco.mjv_initGeom(
            geom,
            mujoco.mjtGeom.mjGEOM_BOX,
            np.array([0.0004, 0.0296, 0.0006]),
            np.array([x, 0.0, 0.0006]),
            np.eye(3).ravel(),
            np.array(_POINTER, dtype=np.float32),
        )
        scene.ngeom += 1
