"""Looks of any scene, their views as they are rendered, and cameras that draw a walk."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from mjsim.pictures.frames import Frame
from mjsim.pictures.looks.limb_look import LimbLook
from mjsim.pictures.looks.look import Look
from mjsim.pictures.looks.strip_look import StripLook
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene, resolved

Colour = tuple[float, float, float, float]


def look(
    scene: Scene, numerics: Numerics, reach: float,
    more: Callable[[mujoco.MjSpec], None] | None = None,
) -> Look:  # fmt: skip
    """Looks of a scene, by the kind of its robot.

    Args:
        scene, numerics: what was simulated, and with how many links.
        reach: how far from x = 0 it goes [m].
        more: adds to the model before it is compiled.
    """
    kind = LimbLook if scene.in_space else StripLook
    return kind(scene, resolved(scene, numerics), reach, more)


def hide_aids(options: Any) -> None:
    """Hide what belongs to the simulation alone, contact pads and friction tendons."""
    options.geomgroup[3] = 0
    options.flags[mujoco.mjtVisFlag.mjVIS_TENDON] = 0


class View:
    """One camera of a look; close it, as it holds an OpenGL context.

    Args:
        shown: what it sees.
        camera: its name.
        width, height: of a frame [pixels].
    """

    def __init__(self, shown: Look, camera: str, width: int, height: int) -> None:
        self._look, self._camera = shown, camera
        self.renderer = mujoco.Renderer(shown.model, height, width)
        self.close = self.renderer.close
        self._options = mujoco.MjvOption()
        mujoco.mjv_defaultOption(self._options)
        hide_aids(self._options)

    def update(self) -> None:
        """Take over the pose of the robot; what was added is gone."""
        self.renderer.update_scene(self._look.data, self._camera, self._options)

    def add(self, kind: mujoco.mjtGeom, size: ArrayLike, place: ArrayLike, colour: Colour) -> None:
        """Add a geom of half sizes (3,) [m] at a place (3,) [m]."""
        scene = self.renderer.scene
        mujoco.mjv_initGeom(scene.geoms[scene.ngeom], kind, np.asarray(size, float),
                            np.asarray(place, float), np.eye(3).ravel(),
                            np.array(colour, dtype=np.float32))  # fmt: skip
        scene.ngeom += 1

    def render(self) -> Frame:
        """The picture, (height, width, 3)."""
        return np.asarray(self.renderer.render())

    def pixel(self, place: ArrayLike) -> tuple[float, float]:
        """Column and line where a point of the scene, (3,) [m], is seen."""
        model, data = self._look.model, self._look.data
        camera = model.camera(self._camera).id
        turned = data.cam_xmat[camera].reshape(3, 3).T @ (place - data.cam_xpos[camera])
        lines, columns = self.renderer.height, self.renderer.width
        focus = 0.5 * lines / np.tan(0.5 * np.deg2rad(model.cam_fovy[camera]))
        x, y = turned[:2] / -turned[2] * focus
        return 0.5 * columns + float(x), 0.5 * lines - float(y)


class WalkCamera(AbstractContextManager["WalkCamera"], ABC):
    """Draws one walk; close it, or use it in a `with`, as it holds OpenGL contexts.

    Args:
        walk: what to draw.
        sizes: width and height of the frames of each view, by the name of its camera [pixels].
    """

    def __init__(self, walk: Trajectory, sizes: Mapping[str, tuple[int, int]]) -> None:
        self.walk = walk
        reach = float(np.abs(walk.line[..., :2]).max()) + 3 * walk.scene.robot.length
        self.look = look(walk.scene, walk.numerics, reach)
        self.views = [View(self.look, name, *size) for name, size in sizes.items()]

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Free the OpenGL contexts."""
        for view in self.views:
            view.close()

    def frame(self, step: int) -> Frame:
        """The walk after a step, (height, width, 3)."""
        walk = self.walk
        fractions = walk.pressure[step] / walk.scene.robot.peak_pressure
        self.look.pose(walk.position[step], walk.coordinates[step], fractions)
        for view in self.views:
            view.update()
        return self._picture(step)

    @abstractmethod
    def _picture(self, step: int) -> Frame:
        """Render the views, which show the walk after a step."""
