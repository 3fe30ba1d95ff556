"""Pictures of a walk of a robot of limbs, with a view from above and what it did in words."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from analytic.scene.limbs import chambers_by_limb, plan, rotation
from mjsim.model.limbs import limbed
from mjsim.model.parts import DARK, PALE
from mjsim.pictures.frames import HEIGHT, WIDTH, Frame
from mjsim.pictures.overlay import BLUE, INK, font
from mjsim.results.trajectory import Trajectory

Array = NDArray[np.float64]

_BAND, _WHITE = 118, 0.75  # lines behind the words, and how white they are
_INSET, _FRAME = (198, 352), 3  # lines and columns of the view from above; lines around it
_DOTS = 160  # of a track at most
_RED, _BLUE = (0.78, 0.12, 0.10, 1.0), (0.10, 0.30, 0.75, 1.0)


def stages(walk: Trajectory) -> Image.Image:
    """A picture of four stages of the gait, in the order of reading."""
    times = np.cumsum(walk.scene.gait.ramp_times)[:4]
    with LimbCamera(walk) as camera:
        frames = [camera.frame(float(time)).copy() for time in times]
    rows = [np.hstack(frames[i : i + 2]) for i in (0, 2)]
    return Image.fromarray(np.vstack(rows)).resize((WIDTH, HEIGHT))


class LimbCamera:
    """Draws one walk; close it, or use it in a `with`, as it holds an OpenGL context.

    Args:
        walk: what to draw.
        faster: that the video is than the walk, which it says.
    """

    def __init__(self, walk: Trajectory, faster: float = 1.0) -> None:
        import mujoco

        from mjsim.model.limb_skins import CAMERA
        from mjsim.pictures.limb_look import OVERHEAD
        from mjsim.pictures.looks import look

        self._walk, self._faster = walk, faster
        reach = float(np.abs(walk.line[:, 0, :2]).max()) + 3 * walk.scene.robot.length
        self._look = look(walk.scene, walk.numerics, reach)
        self._views = {
            CAMERA: mujoco.Renderer(self._look.model, HEIGHT, WIDTH),
            OVERHEAD: mujoco.Renderer(self._look.model, *_INSET),
        }
        self._options, self._track = mujoco.MjvOption(), _track(walk)
        self._options.geomgroup[3] = False  # contact pads
        self._options.flags[mujoco.mjtVisFlag.mjVIS_TENDON] = False
        self._shown, self._frame = -1, np.empty(0, np.uint8)

    def __enter__(self) -> "LimbCamera":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Free the OpenGL contexts."""
        for renderer in self._views.values():
            renderer.close()

    def frame(self, time: float) -> Frame:
        """The walk at a time, shape (height, width, 3)."""
        walk = self._walk
        step = int(np.clip(np.searchsorted(walk.time, time), walk.start, len(walk.time) - 1))
        if step != self._shown:
            peak = walk.scene.robot.peak_pressure
            self._look.pose(walk.position[step], walk.coordinates[step], walk.pressure[step] / peak)
            large, small = (self._view(name, step) for name in self._views)
            frame = _written(walk, large, step, self._faster)
            lines, columns = _INSET
            frame[-lines - 2 * _FRAME :, : columns + 2 * _FRAME] = INK
            frame[-lines - _FRAME : -_FRAME, _FRAME : columns + _FRAME] = small
            self._shown, self._frame = step, frame
        return self._frame

    def _view(self, name: str, step: int) -> Frame:
        renderer = self._views[name]
        renderer.update_scene(self._look.data, name, self._options)
        self._trace(renderer.scene, step)
        return renderer.render().copy()

    def _trace(self, scene: Any, step: int) -> None:
        """Where the ends of the limbs have been, and where they began, as dots on the ground."""
        import mujoco

        size = 0.005 * self._walk.scene.robot.length
        steps, places = self._track
        count = int(np.searchsorted(steps, step, side="right"))
        been = places[1:count].reshape(-1, 2)
        for dots, radius, rgba in ((been, size, _BLUE), (places[0], 1.6 * size, _RED)):
            colour = np.array(rgba, dtype=np.float32)
            for place in dots:
                mujoco.mjv_initGeom(scene.geoms[scene.ngeom], mujoco.mjtGeom.mjGEOM_SPHERE,
                                    np.full(3, radius), np.array([*place, 0.3 * size]),
                                    np.eye(3).ravel(), colour)  # fmt: skip
                scene.ngeom += 1


def _track(walk: Trajectory) -> tuple[Array, Array]:
    """Steps of a walk, (S,), and the ends of its outer limbs in plan at them, (S, E, 2) [m]."""
    robot = limbed(walk.scene)
    outer = [robot.place(name) for name in robot.outer]
    steps = np.unique(np.linspace(walk.start, len(walk.time) - 1, _DOTS).astype(int))
    return steps, walk.position[steps][:, outer, -1, :2]


def _written(walk: Trajectory, frame: Frame, step: int, faster: float) -> Frame:
    """A copy with the state written on it."""
    band = frame.copy()
    band[:_BAND] = (_WHITE * 255 + (1 - _WHITE) * band[:_BAND]).astype(np.uint8)
    picture = Image.fromarray(band)
    pen, big, small = ImageDraw.Draw(picture), font(25), font(17)
    pen.text((28, 18), walk.scene.ground.name, font=big, fill=INK)
    speed = f", {faster:g} times as fast" if faster > 1 else ""
    pen.text((28, 54), f"gait {walk.scene.gait.name}", font=small, fill=INK)
    time = max(0.0, float(walk.time[step]))
    pen.text((28, 78), f"t = {time:4.1f} s{speed}", font=small, fill=INK)
    _plan(pen, walk, step, (520, 62))
    gone = walk.moved(walk.start, step) / walk.scene.robot.length
    ahead, aside = (0.0 if abs(part) < 5e-4 else part for part in gone.tolist())
    turned = float(np.degrees(walk.heading[step] - walk.heading[walk.start]))
    turned = 0.0 if abs(turned) < 5e-2 else turned
    right = picture.width - 28
    for line, (text, letters) in enumerate((
        (f"{ahead:+.3f} L ahead", big),
        (f"{aside:+.3f} L to the left", small),
        (f"turned {turned:+.1f}° to the left", small),
    )):  # fmt: skip
        pen.text((right, 18 + line * 30), text, font=letters, fill=BLUE if line else INK,
                 anchor="ra")  # fmt: skip
    return np.array(picture)


def _plan(pen: ImageDraw.ImageDraw, walk: Trajectory, step: int, centre: tuple[int, int]) -> None:
    """The robot from above, its trunk ahead, each limb in the colour that it has."""
    robot = limbed(walk.scene)
    first = robot.limbs[0].angle
    begins = {name: ends[0] @ rotation(first) for name, ends in plan(robot).items()}
    scale = 190.0 / robot.length
    middle = np.mean(list(begins.values()), axis=0)
    for limb, part in zip(robot.limbs, chambers_by_limb(robot), strict=True):
        pressure = float(np.abs(walk.pressure[step, part]).mean())
        fraction = min(pressure / robot.peak_pressure, 1.0)
        shade = tuple(round(255 * (p + fraction * (d - p)))
                      for p, d in zip(PALE, DARK, strict=True))  # fmt: skip
        start = begins[limb.name] - middle
        along = rotation(limb.angle - first)[:, 0]
        side = 0.5 * limb.strip.width * np.array([-along[1], along[0]])
        corners = [start + side, start + along * limb.strip.length + side,
                   start + along * limb.strip.length - side, start - side]  # fmt: skip
        pen.polygon(
            [(centre[0] + scale * x, centre[1] - scale * y) for x, y in corners],
            fill=shade, outline=INK,
        )  # fmt: skip
