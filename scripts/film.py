"""Write frames that the live page drew as a picture that moves: `make film`."""

import sys
from pathlib import Path

from PIL import Image

COLOURS, FRAME = 48, 90  # and ms


def main() -> None:
    """Read a folder of PNG files, write a GIF."""
    folder, film = map(Path, sys.argv[1:])
    frames = [Image.open(path).convert("RGB") for path in sorted(folder.glob("*.png"))]
    # one palette for all, else still parts flicker
    palette = frames[len(frames) // 2].quantize(COLOURS, dither=Image.Dither.NONE)
    first, *others = (frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames)
    first.save(film, save_all=True, append_images=others, duration=FRAME, loop=0, optimize=True)


if __name__ == "__main__":
    main()
