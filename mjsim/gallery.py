"""Make the videos and the picture that the README shows: `python -m mjsim.gallery`."""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

from analytic import SURFACES
from mjsim.scene import Scene
from mjsim.video import gl

FOLDER = Path("docs")
MOMENT = 4.0  # s; two segments inflated, the arch at its steepest


def main() -> int:
    """Walk one cycle on each surface and film it."""
    if gl.use_backend() is None:
        print(gl.HELP, file=sys.stderr)
        return 1

    from mjsim.simulation.simulation import simulate
    from mjsim.video.recording import bands, write_video

    FOLDER.mkdir(exist_ok=True)
    walks = [simulate(Scene(surface=surface)) for surface in SURFACES.values()]
    for walk in walks:
        write_video([walk], FOLDER / f"{walk.scene.surface.name}.mp4")
    write_video(walks, FOLDER / "all.mp4")
    picture = Image.fromarray(next(bands(walks, np.array([MOMENT]))))
    picture.save(FOLDER / "surfaces.jpg", quality=88)
    return 0


if __name__ == "__main__":
    sys.exit(main())
