"""Pictures that tell a walk at once: which way strips went, and four stages of a gait."""

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw

from analytic.locomotion import direction
from mjsim.pictures.frames import HEIGHT, WIDTH
from mjsim.pictures.overlay import BLUE, INK, font
from mjsim.pictures.recording import pictures, written
from mjsim.results.trajectory import Trajectory

_ROWS = slice(382, 602)  # lines of a frame with a strip that lies flat, and the ruler
_HEAD = 46  # lines above each walk for its words
_WORDS = {"none": "stands still", "forward": "walks forward", "backward": "walks back"}
_LARGER = 1.4  # letters of a picture that is shown at half its size
_START = 0.45  # part of the start in the mixture with the end


def poster(walks: Sequence[Trajectory]) -> Image.Image:
    """One band per walk: where the strip lay (pale) and where it lies after the cycles."""
    bands = []
    for walk in walks:
        ends = np.array([0.0, walk.time[-1]])
        start, end = (frame[_ROWS] for frame, _ in pictures(walk, ends))
        mixed = (_START * start + (1 - _START) * end).astype(np.uint8)
        head = np.full((_HEAD, mixed.shape[1], 3), 255, np.uint8)
        picture = Image.fromarray(np.concatenate([head, mixed]))
        pen = ImageDraw.Draw(picture)
        gone = float(walk.line[-1, 0, 0] - walk.line[walk.start, 0, 0])
        part = gone / walk.scene.robot.length
        way = _WORDS[direction(part, 1.0)]
        pen.text((24, 8), f"{walk.scene.ground.name}: {way}", font=font(26), fill=INK)
        pen.text((picture.width - 24, 8), f"{1e3 * gone:+.1f} mm = {part:+.3f} L per cycle",
                 font=font(26), fill=BLUE, anchor="ra")  # fmt: skip
        bands.append(np.asarray(picture))
    return Image.fromarray(np.concatenate(bands))


def stages(walk: Trajectory) -> Image.Image:
    """Four stages of the gait of a robot of limbs, in the order of reading."""
    frames = written(walk, np.cumsum(walk.scene.gait.ramp_times)[:4], _LARGER)
    rows = [np.hstack(frames[i : i + 2]) for i in (0, 2)]
    return Image.fromarray(np.vstack(rows)).resize((WIDTH, HEIGHT))
