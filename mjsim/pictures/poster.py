"""One picture that shows which way each walk went: start and end of the cycle, side by side."""

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw

from analytic.locomotion import direction
from mjsim.pictures.overlay import BLUE, INK, font
from mjsim.pictures.recording import pictures
from mjsim.results.trajectory import Trajectory

_ROWS = (400, 600)  # lines of a frame that hold a strip lying flat, and the ruler
_HEAD = 46  # lines above each walk for its words
_WORDS = {"none": "stands still", "forward": "walks forward", "backward": "walks back"}
_FAINT = 0.45  # how far the start fades into the end


def poster(walks: Sequence[Trajectory]) -> Image.Image:
    """A band a walk: where the strip lay (faint) and where it lies after the cycles."""
    bands = []
    for walk in walks:
        ends = np.array([0.0, walk.time[-1]])
        (start, _), (end, _) = ((frame.copy(), step) for frame, step in pictures(walk, ends))
        mixed = (_FAINT * start[slice(*_ROWS)] + (1 - _FAINT) * end[slice(*_ROWS)]).astype(np.uint8)
        head = np.full((_HEAD, mixed.shape[1], 3), 255, np.uint8)
        picture = Image.fromarray(np.concatenate([head, mixed]))
        pen = ImageDraw.Draw(picture)
        gone = float(walk.line[-1, 0, 0] - walk.line[walk.start, 0, 0])
        part = gone / walk.scene.robot.length
        way = _WORDS[direction(part, 1.0)]
        pen.text((24, 8), f"{walk.scene.ground.name}: {way}", font=font(26), fill=INK)
        pen.text((picture.width - 24, 8), f"{1e3 * gone:+.1f} mm = {part:+.3f} L a cycle",
                 font=font(26), fill=BLUE, anchor="ra")  # fmt: skip
        bands.append(np.asarray(picture))
    return Image.fromarray(np.concatenate(bands))
