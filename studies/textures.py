"""Pictures for the grounds and the ruler, drawn from fixed seeds."""

import itertools
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy.ndimage import gaussian_filter

from studies import Array

SIZE = 320  # pixels, sides of a tile
RULER_LENGTH = 0.26  # m, as the ruler of mjsim/model/appearance/stage.xml
RULER_START = -0.06  # m, x of its left edge there
_FIBRES, _DROPS = 3600, 70
_INK = (30, 30, 30)
_UNIT_AT = 5  # mm of the ruler where its unit stands


def write_textures(folder: Path) -> None:
    """Draw every texture into a folder as PNG."""
    folder.mkdir(parents=True, exist_ok=True)
    for draw in (felt, polyethylene, gelatin, ruler):
        draw().save(folder / f"{draw.__name__}.png", optimize=True)


def _tint(shade: Array, dark: tuple[int, ...], light: tuple[int, ...]) -> Image.Image:
    """Colours between dark and light for a shade in [0, 1]."""
    mix = np.asarray(dark) + shade[..., None] * (np.asarray(light) - np.asarray(dark))
    return Image.fromarray(np.clip(mix, 0, 255).astype(np.uint8))


def _smooth(shade: Array | Image.Image, radius: float) -> Array:
    """Blur that joins across the tile's borders, scaled to [0, 1]."""
    soft = gaussian_filter(np.asarray(shade, dtype=float), radius, mode="wrap")
    return (soft - soft.min()) / (soft.max() - soft.min())


def felt() -> Image.Image:
    """Short fibres in every direction."""
    rng = np.random.default_rng(1)
    tile = Image.new("L", (SIZE, SIZE), 110)
    draw = ImageDraw.Draw(tile)
    starts = rng.uniform(0, SIZE, (2, _FIBRES)).T
    angles, greys = rng.uniform(0, np.pi, _FIBRES), rng.integers(60, 190, _FIBRES)
    for start, angle, grey in zip(starts, angles, greys.tolist(), strict=True):
        end = start + 11 * np.array([np.cos(angle), np.sin(angle)])
        for shift in itertools.product((-SIZE, 0, SIZE), repeat=2):
            draw.line((*(start + shift), *(end + shift)), fill=grey)
    return _tint(_smooth(tile, 0.7), (34, 72, 56), (84, 142, 114))


def polyethylene() -> Image.Image:
    """A smooth sheet with weak streaks along the roll."""
    rng = np.random.default_rng(2)
    streaks = rng.normal(0, 1, (SIZE, 1)) + 0.2 * rng.normal(0, 1, (SIZE, SIZE))
    return _tint(_smooth(streaks, 2.5), (205, 216, 224), (232, 238, 242))


def gelatin() -> Image.Image:
    """Amber with soft swirls and a film of droplets."""
    rng = np.random.default_rng(3)
    shade = 0.55 * _smooth(rng.normal(0, 1, (SIZE, SIZE)), 26.0)
    drops = Image.new("L", (SIZE, SIZE), 0)
    draw = ImageDraw.Draw(drops)
    centres, radii = rng.uniform(12, SIZE - 12, (2, _DROPS)), rng.uniform(2, 7, _DROPS)
    for x, y, r in zip(*centres, radii, strict=True):
        draw.ellipse((x - r, y - r, x + r, y + r), fill=120)
        draw.ellipse((x - 0.5 * r, y - 0.6 * r, x + 0.1 * r, y), fill=255)
    shade += 0.45 * _smooth(drops, 1.2)
    return _tint(shade, (176, 92, 12), (250, 196, 84))


def ruler() -> Image.Image:
    """Centimetres from the start of the left end, with millimetre ticks."""
    width, height = 2080, 166
    per_metre = width / RULER_LENGTH
    picture = Image.new("RGB", (width, height), (246, 240, 222))
    draw, font = ImageDraw.Draw(picture), ImageFont.load_default(66)
    first, last = round(RULER_START * 1000), round((RULER_START + RULER_LENGTH) * 1000)
    for mm in range(first, last + 1):
        x = (mm / 1000 - RULER_START) * per_metre
        reach = 52 if mm % 10 == 0 else 38 if mm % 5 == 0 else 24
        draw.line((x, 0, x, reach), fill=_INK, width=4 if mm % 10 == 0 else 2)
        if mm % 10 == 0 and mm > first:
            draw.text((x, 110), f"{mm // 10}", font=font, fill=_INK, anchor="mm")
        if mm == _UNIT_AT:
            draw.text((x, 118), "cm", font=ImageFont.load_default(30), fill=_INK, anchor="mm")
    return picture


def main(argv: Sequence[str] | None = None) -> int:
    """Draw them into the folder that the command line names."""
    words = sys.argv[1:] if argv is None else list(argv)
    if len(words) != 1 or words[0].startswith("-"):
        print("usage: python -m studies.textures FOLDER", file=sys.stderr)
        return 2
    write_textures(Path(words[0]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
