"""What is written into a frame: surface, time, segment pressures, displacement so far."""

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from mjsim.bodies.parts import DARK, PALE
from mjsim.simulation.trajectory import Trajectory
from mjsim.video.render import Frame

_INK = (25, 28, 32)
_PALE = tuple(round(255 * c) for c in PALE)
_DARK = tuple(round(255 * c) for c in DARK)


class Overlay:
    """Writes on the frames of one walk.

    Args:
        walk: the walk.
        scale: size of letters, 1 for 720 lines.
    """

    def __init__(self, walk: Trajectory, scale: float) -> None:
        self._walk, self._scale = walk, scale
        self._big = ImageFont.load_default(round(30 * scale))
        self._small = ImageFont.load_default(round(21 * scale))
        self._start = float(walk.position[walk.start, 0, 0])

    def draw(self, frame: Frame, step: int) -> Frame:
        """A copy of the frame with the state after a step written on it."""
        walk, u = self._walk, self._scale
        picture = Image.fromarray(frame)
        pen = ImageDraw.Draw(picture)
        edge, top = 28 * u, 22 * u
        pen.text((edge, top), walk.scene.surface.name, font=self._big, fill=_INK)
        time = max(0.0, float(walk.time[step]))
        pen.text((edge, top + 38 * u), f"gait {walk.scene.gait.name}   t = {time:4.1f} s",
                 font=self._small, fill=_INK)  # fmt: skip
        self._pressures(pen, edge + 310 * u, top, step)
        moved = float(walk.position[step, 0, 0]) - self._start
        right = picture.width - edge
        share = moved / walk.scene.robot.length
        moved = 0.0 if abs(moved) < 5e-5 else moved  # no minus before a zero
        share = 0.0 if abs(share) < 5e-4 else share
        pen.text((right, top), f"displacement {1e3 * moved:+.1f} mm", font=self._big, fill=_INK,
                 anchor="ra")  # fmt: skip
        pen.text((right, top + 38 * u), f"{share:+.3f} L   (left end)", font=self._small,
                 fill=_INK, anchor="ra")  # fmt: skip
        return np.asarray(picture)

    def _pressures(self, pen: ImageDraw.ImageDraw, left: float, top: float, step: int) -> None:
        """A bar a segment, filled as far as it is inflated, in the colour it has there."""
        u, walk = self._scale, self._walk
        width, gap, height = 92 * u, 14 * u, 22 * u
        for i, pressure in enumerate(walk.pressure[step]):
            fraction = float(pressure / walk.scene.robot.peak_pressure)
            x = left + i * (width + gap)
            shade = tuple(round(p + fraction * (d - p)) for p, d in zip(_PALE, _DARK, strict=True))
            pen.rectangle((x, top + 6 * u, x + width, top + 6 * u + height), fill=(250, 250, 248))
            if fraction > 0:
                pen.rectangle((x, top + 6 * u, x + fraction * width, top + 6 * u + height),
                              fill=shade)  # fmt: skip
            pen.rectangle((x, top + 6 * u, x + width, top + 6 * u + height), outline=_INK)
            pen.text((x + width / 2, top + 38 * u), f"{1e-3 * pressure:.0f} kPa",
                     font=self._small, fill=_INK, anchor="ma")  # fmt: skip
