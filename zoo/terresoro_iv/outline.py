"""Where TerreSoRo-IV's flat limbs lie, on photographs.

`python -m zoo.terresoro_iv.outline FOLDER`:

FOLDER is demos/data/visualtracking of clfreeman7/Path_Planning, see `tracks`, which has the first
frame of each tour beside its track. All limbs are flat there and seen from above. Writes the
outline's numbers to outline.csv, means and standard deviations over five tours and four limbs, and
mean edges to edges.csv, which a picture shows.
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
STATIONS = range(5, 18)  # along a limb, from the hub's middle [cm]
NAMES = ("distance of the centre of a limb's area [cm]", "direction of it, of limb 1 [rad]",
         "distance of its tip [cm]", "area of a limb [cm^2]", "width of a limb [cm]")  # fmt: skip


def limbs(picture: Array, centre: Array, angle: float) -> list[Array]:
    """Places of the pixels of each limb, as if it were limb 1, complex, x + i y [cm].

    Args:
        picture: colours of the pixels, 0 to 255, (H, W, 3).
        centre: of the hub, its column and row.
        angle: by which the hub's axes are turned on the picture [rad].
    """
    rows, columns = np.nonzero(picture.sum(axis=2) > BRIGHT)
    place = ORANGE.pixel * ((columns - centre[0]) + 1j * (rows - centre[1])) * np.exp(-1j * angle)
    place = place[(np.abs(place) > HUB) & (np.abs(place) < FAR)]
    axis, turn = float(np.angle((place**LIMBS).mean())) / LIMBS, 0.5 * np.pi
    which = np.round((np.angle(place) - axis) / turn).astype(int) % LIMBS
    return [place[which == limb] * np.exp(-1j * turn * (limb + 1)) for limb in range(LIMBS)]


def numbers(limb: Array) -> list[float]:
    """See NAMES."""
    middle, area = limb.mean(), len(limb) * ORANGE.pixel**2
    along = (limb * np.exp(-1j * np.angle(middle))).real
    return [abs(middle), np.angle(middle), np.abs(limb).max(), area, area / np.ptp(along)]


def edges(limb: Array) -> Array:
    """How far the two edges are aside of the line through the middle, at STATIONS, (S, 2) [cm]."""
    along = limb * np.exp(-1j * np.angle(limb.mean()))
    return np.array([
        np.quantile(along.imag[np.abs(along.real - station) < 0.5], (0.02, 0.98))
        for station in STATIONS
    ])  # fmt: skip


def photographed(folder: Path) -> list[Array]:
    """All limbs on all first frames, see `limbs`."""
    found = []
    for tour, angle in zip(ORANGE.first, axes(folder), strict=True):
        with Image.open(folder / f"firstframe{tour:02d}.jpg") as image:
            picture = np.asarray(image.convert("RGB"), dtype=float)
        first = loadmat(folder / f"Euler {tour}.mat")["all_pt"][0]
        found += limbs(picture, markers(first).mean(axis=0), angle)
    return found


@cache
def flat_place() -> tuple[float, float]:
    """Distance from the hub's centre [cm] and direction [rad] of a flat limb 1's middle."""
    with (DATA / "outline.csv").open(encoding="utf-8") as file:
        values = [float(row["mean"]) for row in csv.DictReader(file)]
    return values[0], values[1]


def main(folder: str) -> None:
    """Write and print the numbers."""
    every = photographed(Path(folder))
    each = np.array([numbers(limb) for limb in every])
    each[:, 1] %= 2 * np.pi
    with (DATA / "outline.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("quantity", "mean", "sd"))
        for name, mean, sd in zip(NAMES, each.mean(axis=0), each.std(axis=0, ddof=1), strict=True):
            writer.writerow((name, f"{mean:.4g}", f"{sd:.2g}"))
            print(f"{name}: {mean:.4g} ± {sd:.2g}")
    with (DATA / "edges.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("along [cm]", "edge [cm]", "other edge [cm]"))
        for station, sides in zip(STATIONS, np.mean([edges(limb) for limb in every], axis=0),
                                  strict=True):  # fmt: skip
            writer.writerow((station, *(f"{side:.2f}" for side in sides)))


if __name__ == "__main__":
    main(*sys.argv[1:])
