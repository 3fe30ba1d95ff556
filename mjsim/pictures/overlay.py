"""Words and charts on the frames of a walk: ground, gait, time and displacement so far."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from mjsim.pictures.frames import Frame
from mjsim.pictures.render import anchored_end
from mjsim.results.shades import shade_of_pixels
from mjsim.results.trajectory import Trajectory

INK, _FAINT, BLUE, _GREEN = (25, 28, 32), (160, 165, 170), (26, 77, 191), (10, 130, 50)
_EDGE, _TOP, _LINES = 28, 18, (0, 36, 60)  # of the words in the corners, of 720 lines
_POINTS = 200  # of the track; chosen

Colour = tuple[int, int, int]
Pen = ImageDraw.ImageDraw


@cache
def font(size: int) -> ImageFont.FreeTypeFont:
    """Letters of many alphabets: the font that comes with matplotlib."""
    import matplotlib

    path = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    return ImageFont.truetype(str(path), size)


class Overlay(ABC):
    """Writes on the frames of one walk.

    Args:
        walk: the walk.
        scale: size of letters, 1 for 720 lines.
        faster: how many times as fast as the walk the video is, which it says.
        gaits: names of the gaits played after each step, (T,); the scene's if None.
    """

    def __init__(
        self, walk: Trajectory, scale: float = 1.0, faster: float = 1.0,
        gaits: Sequence[str] | None = None,
    ) -> None:  # fmt: skip
        self.walk, self.scale, self._faster, self._gaits = walk, scale, faster, gaits
        self.big, self.small = font(round(25 * scale)), font(round(17 * scale))

    def draw(self, frame: Frame, step: int) -> Frame:
        """A copy of the frame with the state after a step written on it."""
        picture = Image.fromarray(frame)
        pen, walk, edge = ImageDraw.Draw(picture), self.walk, _EDGE * self.scale
        words = (walk.scene.ground.name, self._gait(step), self._time(step))
        self._write(pen, edge, [(text, INK) for text in words], "la")
        self._write(pen, picture.width - edge, self._displacement(step), "ra")
        self._draw_state(pen, picture.width, step)
        return np.array(picture)

    def _gait(self, step: int) -> str:
        name = self._gaits[step] if self._gaits else self.walk.scene.gait.name
        ceiling = self.walk.scene.ceiling
        return f"gait {name}" + ("" if ceiling is None else f", below {1e3 * ceiling:g} mm")

    def _time(self, step: int) -> str:
        faster = f", {self._faster:g} times as fast" if self._faster > 1 else ""
        return f"t = {max(0.0, float(self.walk.time[step])):4.1f} s{faster}"

    def _write(
        self, pen: Pen, at: float, texts: Sequence[tuple[str, Colour]], anchor: str
    ) -> None:  # fmt: skip
        """Lines from the top in a corner, the first one in large letters."""
        for line, (text, colour) in zip(_LINES, texts, strict=True):
            pen.text((at, (_TOP + line) * self.scale), text, fill=colour, anchor=anchor,
                     font=self.small if line else self.big)  # fmt: skip

    @abstractmethod
    def _displacement(self, step: int) -> Sequence[tuple[str, Colour]]:
        """Three lines on the displacement so far, with their colours."""

    @abstractmethod
    def _draw_state(self, pen: Pen, width: int, step: int) -> None:
        """Draw pressures and the like between the corners of a frame so wide [pixels]."""


def without_minus_zero(value: float, least: float) -> float:
    """The value, or 0 if it is too small to be seen: no minus before a zero."""
    return 0.0 if abs(value) < least else value


class StripOverlay(Overlay):
    """Overlay of a strip: pressures of its segments, track and the anchored end."""

    def __init__(
        self, walk: Trajectory, scale: float = 1.0, faster: float = 1.0,
        gaits: Sequence[str] | None = None,
    ) -> None:  # fmt: skip
        super().__init__(walk, scale, faster, gaits)
        self._gone = walk.line[:, 0, 0] - walk.line[walk.start, 0, 0]  # of the left end [m]

    def _displacement(self, step: int) -> Sequence[tuple[str, Colour]]:
        gone = float(self._gone[step])
        millimetres = without_minus_zero(1e3 * gone, 5e-2)
        part = without_minus_zero(gone / self.walk.scene.robot.length, 5e-4)
        return (f"{millimetres:+.1f} mm", INK), (f"{part:+.3f} L", INK), ("left end", BLUE)

    def _draw_state(self, pen: Pen, width: int, step: int) -> None:
        u = self.scale
        edge, top = _EDGE * u, _TOP * u
        after = edge + max(110 * u, self.small.getlength(self._time(step)) + 20 * u)
        self._anchor(pen, after, top + 60 * u, step)
        self._pressures(pen, edge + 320 * u, top, step)
        self._track(pen, width - edge - 460 * u, top, step)

    def _anchor(self, pen: Pen, left: float, top: float, step: int) -> None:
        end = anchored_end(self.walk, step)
        if end is not None:
            words = f"{'left' if end == 0 else 'right'} end sticks"
            pen.text((left, top), words, font=self.small, fill=_GREEN)

    def _track(self, pen: Pen, left: float, top: float, step: int) -> None:
        """Displacement of the left end over time, up to this step."""
        u, walk, gone = self.scale, self.walk, self._gone
        width, height = 290 * u, 72 * u
        duration = max(float(walk.time[-1]), 1e-9)
        low, high = min(0.0, float(gone.min())), max(0.0, float(gone.max()))
        span = max(high - low, 0.02 * walk.scene.robot.length)

        def place(time: float, x: float) -> tuple[float, float]:
            return left + width * max(time, 0.0) / duration, top + height * (1 - (x - low) / span)

        axis = [place(0.0, 0.0), place(duration, 0.0)]
        pen.line(axis, fill=_FAINT, width=max(1, round(u)))
        chosen = np.linspace(walk.start, max(step, walk.start), _POINTS).astype(int)
        line = [place(float(walk.time[i]), float(gone[i])) for i in chosen]
        pen.line(line, fill=BLUE, width=max(1, round(2 * u)))
        x, y = line[-1]
        pen.ellipse((x - 3 * u, y - 3 * u, x + 3 * u, y + 3 * u), fill=BLUE)

    def _pressures(self, pen: Pen, left: float, top: float, step: int) -> None:
        """One bar per segment, filled as far as it is inflated, in the colour it has there."""
        u, walk = self.scale, self.walk
        count = len(walk.pressure[step])
        gap, upper, lower = 10 * u, top + 6 * u, top + 28 * u
        width = (300 * u + gap) / count - gap
        for i, pressure in enumerate(walk.pressure[step]):
            fraction = min(float(pressure / walk.scene.robot.peak_pressure), 1.0)
            x = left + i * (width + gap)
            pen.rectangle((x, upper, x + width, lower), fill=(250, 250, 248))
            if fraction > 0:
                pen.rectangle((x, upper, x + fraction * width, lower),
                              fill=shade_of_pixels(fraction))  # fmt: skip
            pen.rectangle((x, upper, x + width, lower), outline=INK)
            if count <= 4:
                pen.text((x + width / 2, top + 38 * u), f"{1e-3 * pressure:.0f} kPa",
                         font=self.small, fill=INK, anchor="ma")  # fmt: skip
