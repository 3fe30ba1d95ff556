"""What is written into a frame: surface, time, pressures, displacement so far and its track."""

from functools import cache
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from mjsim.model.parts import DARK, PALE
from mjsim.pictures.render import Frame, anchored
from mjsim.results.trajectory import Trajectory

INK, _FAINT, BLUE, _GREEN = (25, 28, 32), (160, 165, 170), (26, 77, 191), (10, 130, 50)
_PALE = tuple(round(255 * c) for c in PALE)
_DARK = tuple(round(255 * c) for c in DARK)
_POINTS = 200  # of the track; chosen


@cache
def font(size: int) -> ImageFont.FreeTypeFont:
    """Letters of many alphabets: the font that comes with matplotlib."""
    import matplotlib

    path = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    return ImageFont.truetype(str(path), size)


class Overlay:
    """Writes on the frames of one walk.

    Args:
        walk: the walk.
        scale: size of letters, 1 for 720 lines.
    """

    def __init__(self, walk: Trajectory, scale: float) -> None:
        self._walk, self._scale = walk, scale
        self._big, self._small = font(round(25 * scale)), font(round(17 * scale))
        self._gone = walk.line[:, 0, 0] - walk.line[walk.start, 0, 0]

    def draw(self, frame: Frame, step: int) -> Frame:
        """A copy of the frame with the state after a step written on it."""
        walk, u = self._walk, self._scale
        picture = Image.fromarray(frame)
        pen = ImageDraw.Draw(picture)
        edge, top = 28 * u, 18 * u
        pen.text((edge, top), walk.scene.ground.name, font=self._big, fill=INK)
        time = max(0.0, float(walk.time[step]))
        pen.text((edge, top + 36 * u), f"gait {walk.scene.gait.name}", font=self._small, fill=INK)
        pen.text((edge, top + 60 * u), f"t = {time:4.1f} s", font=self._small, fill=INK)
        self._anchor(pen, edge + 110 * u, top + 60 * u, step)
        self._pressures(pen, edge + 320 * u, top, step)
        self._displacement(pen, picture.width - edge, top, step)
        self._track(pen, picture.width - edge - 500 * u, top, step)
        return np.asarray(picture)

    def _anchor(self, pen: ImageDraw.ImageDraw, left: float, top: float, step: int) -> None:
        end = anchored(self._walk, step)
        if end is not None:
            words = f"{'left' if end == 0 else 'right'} end holds"
            pen.text((left, top), words, font=self._small, fill=_GREEN)

    def _displacement(self, pen: ImageDraw.ImageDraw, right: float, top: float, step: int) -> None:
        moved = float(self._gone[step])
        part = moved / self._walk.scene.robot.length
        moved = 0.0 if abs(moved) < 5e-5 else moved  # no minus before a zero
        part = 0.0 if abs(part) < 5e-4 else part
        pen.text((right, top), f"{1e3 * moved:+.1f} mm", font=self._big, fill=INK, anchor="ra")
        u = self._scale
        pen.text((right, top + 36 * u), f"{part:+.3f} L", font=self._small, fill=INK, anchor="ra")
        pen.text((right, top + 60 * u), "left end", font=self._small, fill=BLUE, anchor="ra")

    def _track(self, pen: ImageDraw.ImageDraw, left: float, top: float, step: int) -> None:
        """Displacement of the left end over time, up to now."""
        u, walk = self._scale, self._walk
        width, height = 330 * u, 72 * u
        last = max(float(walk.time[-1]), 1e-9)
        low, high = min(0.0, float(self._gone.min())), max(0.0, float(self._gone.max()))
        span = max(high - low, 0.02 * walk.scene.robot.length)

        def place(time: float, x: float) -> tuple[float, float]:
            return left + width * max(time, 0.0) / last, top + height * (1 - (x - low) / span)

        pen.line([place(0.0, 0.0), place(last, 0.0)], fill=_FAINT, width=max(1, round(u)))
        chosen = np.linspace(walk.start, max(step, walk.start), _POINTS).astype(int)
        line = [place(float(walk.time[i]), float(self._gone[i])) for i in chosen]
        pen.line(line, fill=BLUE, width=max(1, round(2 * u)))
        x, y = line[-1]
        pen.ellipse((x - 3 * u, y - 3 * u, x + 3 * u, y + 3 * u), fill=BLUE)

    def _pressures(self, pen: ImageDraw.ImageDraw, left: float, top: float, step: int) -> None:
        """A bar a segment, filled as far as it is inflated, in the colour it has there."""
        u, walk = self._scale, self._walk
        count = len(walk.pressure[step])
        gap, height = 10 * u, 22 * u
        width = (300 * u + gap) / count - gap
        for i, pressure in enumerate(walk.pressure[step]):
            fraction = min(float(pressure / walk.scene.robot.peak_pressure), 1.0)
            x = left + i * (width + gap)
            shade = tuple(round(p + fraction * (d - p)) for p, d in zip(_PALE, _DARK, strict=True))
            pen.rectangle((x, top + 6 * u, x + width, top + 6 * u + height), fill=(250, 250, 248))
            if fraction > 0:
                pen.rectangle((x, top + 6 * u, x + fraction * width, top + 6 * u + height),
                              fill=shade)  # fmt: skip
            pen.rectangle((x, top + 6 * u, x + width, top + 6 * u + height), outline=INK)
            if count <= 4:
                pen.text((x + width / 2, top + 38 * u), f"{1e-3 * pressure:.0f} kPa",
                         font=self._small, fill=INK, anchor="ma")  # fmt: skip
