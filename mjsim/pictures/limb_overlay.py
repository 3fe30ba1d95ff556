"""Words on the frames of a robot of limbs, with the robot from above."""

from collections.abc import Sequence

import numpy as np

from analytic.scene.limbs import chambers_by_limb, plan, rotation
from mjsim.model.bodies.limbs import limbed
from mjsim.pictures.frames import Frame
from mjsim.pictures.overlay import BLUE, INK, Colour, Overlay, Pen
from mjsim.results.shades import shade_of_pixels

_BAND, _WHITE = 118, 0.75  # lines behind the words, and how white they are
# of the robot from above: its middle, its L and the most across it [pixels]
_CENTRE, _LENGTH, _HEIGHT = (520, 62), 190.0, 104.0


class LimbOverlay(Overlay):
    """Overlay of a robot of limbs: pressures in its limbs and which way it turned."""

    def draw(self, frame: Frame, step: int) -> Frame:
        """A copy of the frame with the state written on a white band."""
        picture, lines = frame.copy(), round(_BAND * self.scale)
        picture[:lines] = (_WHITE * 255 + (1 - _WHITE) * picture[:lines]).astype(np.uint8)
        return super().draw(picture, step)

    def _displacement(self, step: int) -> Sequence[tuple[str, Colour]]:
        walk = self.walk
        ahead, aside = walk.moved(walk.start, step).tolist()
        turn = float(np.degrees(walk.heading[step] - walk.heading[walk.start]))
        part = abs(ahead) / walk.scene.robot.length
        return (
            (_told(1e3 * ahead, " mm", "ahead", "back"), INK),
            (f"{part:.3f} L, {_told(1e3 * aside, ' mm', 'to the left', 'to the right')}", BLUE),
            (f"turned {_told(turn, '°', 'to the left', 'to the right')}", BLUE),
        )  # fmt: skip

    def _draw_state(self, pen: Pen, width: int, step: int) -> None:
        """The robot from above, its trunk ahead, each limb in the colour that it has."""
        robot, u = limbed(self.walk.scene), self.scale
        trunk = robot.limbs[0].angle
        begins = {name: ends[0] @ rotation(trunk) for name, ends in plan(robot).items()}
        corners = []
        for limb in robot.limbs:
            along = rotation(limb.angle - trunk)[:, 0]
            side = 0.5 * limb.strip.width * np.array([-along[1], along[0]])
            start = begins[limb.name]
            end = start + along * limb.strip.length
            corners.append([start + side, end + side, end - side, start - side])
        places = np.array(corners)
        low, high = places.min(axis=(0, 1)), places.max(axis=(0, 1))
        scale = u * min(_LENGTH / robot.length, _HEIGHT / float(high[1] - low[1]))
        places = scale * (places - 0.5 * (low + high)) * (1.0, -1.0) + u * np.array(_CENTRE)
        for outline, part in zip(places, chambers_by_limb(robot), strict=True):
            pressure = float(np.abs(self.walk.pressure[step, part]).mean())
            pen.polygon(list(map(tuple, outline.tolist())), outline=INK,
                        fill=shade_of_pixels(pressure / robot.peak_pressure))  # fmt: skip


def _told(value: float, unit: str, positive: str, negative: str) -> str:
    """A size with its unit and its sign in words; without them where it is written as 0."""
    size = f"{abs(value):.1f}"
    way = "" if float(size) == 0 else f" {positive if value > 0 else negative}"
    return f"{size}{unit}{way}"
