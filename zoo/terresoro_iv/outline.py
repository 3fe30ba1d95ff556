"""Where TerreSoRo-IV's flat limbs lie, on photographs.

`python -m zoo.terresoro_iv.outline FOLDER`:

FOLDER is demos/data/visualtracking of clfreeman7/Path_Planning, see `tracks`, which has the first
frame of each tour beside its track. All limbs are flat there and seen from above. Writes the
outline's numbers to outline.csv, means and standard deviations over five tours and four limbs.
"""

import csv
import sys
from functools import cache
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.io import loadmat

from studies import Array
from zoo.terresoro_iv.hub import DATA, LIMBS
from zoo.terresoro_iv.tracks import ORANGE, axes, markers

BRIGHT = 180  # of 765, above which a pixel is the robot's; the mat is black
HUB, FAR = 4.6, 19.0  # cm from the centre, between which pixels are a limb's
NAMES = ("distance of the centre of a limb's area [cm]", "direction of it, of limb 1 [rad]",
         "distance of its tip [cm]", "area of a limb [cm^2]", "width of a limb [cm]")  # fmt: skip


def limbs(picture: Array, centre: Array, angle: float) -> Array:
    """Numbers of the limbs on a picture, see NAMES, (4, 5); directions of each as if it were 1.

    Args:
        picture: colours of the pixels, 0 to 255, (H, W, 3).
        centre: of the hub, its column and row.
        angle: by which the hub's axes are turned on the picture [rad].
    """
    rows, columns = np.nonzero(picture.sum(axis=2) > BRIGHT)
    place = ORANGE.pixel * ((columns - centre[0]) + 1j * (rows - centre[1])) * np.exp(-1j * angle)
    place = place[(np.abs(place) > HUB) & (np.abs(place) < FAR)]
    axis = float(np.angle((place**LIMBS).mean())) / LIMBS
    turn = 0.5 * np.pi
    which = np.round((np.angle(place) - axis) / turn).astype(int) % LIMBS
    found = []
    for limb in range(LIMBS):
        here = place[which == limb] * np.exp(-1j * turn * (limb + 1))
        middle, along = here.mean(), here * np.exp(-1j * (axis - turn))
        length, area = np.ptp(along.real), len(here) * ORANGE.pixel**2
        found.append([abs(middle), np.angle(middle), np.abs(here).max(), area, area / length])
    return np.array(found)


def measured(folder: Path) -> Array:
    """Numbers of all limbs on all first frames, (5, 4, 5)."""
    found = []
    for tour, angle in zip(ORANGE.first, axes(folder), strict=True):
        with Image.open(folder / f"firstframe{tour:02d}.jpg") as image:
            picture = np.asarray(image.convert("RGB"), dtype=float)
        first = loadmat(folder / f"Euler {tour}.mat")["all_pt"][0]
        found.append(limbs(picture, markers(first).mean(axis=0), angle))
    return np.array(found)


@cache
def flat_place() -> tuple[float, float]:
    """Distance from the hub's centre [cm] and direction [rad] of a flat limb 1's middle."""
    with (DATA / "outline.csv").open(encoding="utf-8") as file:
        values = [float(row["mean"]) for row in csv.DictReader(file)]
    return values[0], values[1]


def main(folder: str) -> None:
    """Write and print the numbers."""
    each = measured(Path(folder)).reshape(-1, len(NAMES))
    each[:, 1] %= 2 * np.pi
    with (DATA / "outline.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("quantity", "mean", "sd"))
        for name, mean, sd in zip(NAMES, each.mean(axis=0), each.std(axis=0, ddof=1), strict=True):
            writer.writerow((name, f"{mean:.4g}", f"{sd:.2g}"))
            print(f"{name}: {mean:.4g} ± {sd:.2g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
