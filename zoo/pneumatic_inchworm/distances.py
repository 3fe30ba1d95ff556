"""Distances per cycle that the inchworm's fit reads: `python -m zoo.pneumatic_inchworm.distances`.

Walks that `examples/inchworm_speeds.py` makes, of its gait that fits best, over its grid of loads,
turns and coefficients of friction; five minutes of CPU. Writes distances.csv.
"""

import csv
from pathlib import Path

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from examples import inchworm_speeds as inchworm

GAIT = "full-wave"
FILE = Path(__file__).with_name("distances.csv")
_HEAD = ("Gamma", "friction", "turn [rad]", "distance per cycle over L")


def write() -> None:
    """Walk the grid and write the file."""
    table = inchworm.tables([GAIT])[GAIT]
    with FILE.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(_HEAD)
        for i, load in enumerate(inchworm.LOADS):
            for k, friction in enumerate(inchworm.FRICTIONS):
                for j, turn in enumerate(inchworm.TURNS):
                    far = table.values[i, j, k]
                    writer.writerow(f"{x:.6g}" for x in (load, friction, turn, far))


def read() -> RegularGridInterpolator:
    """The interpolator that `inchworm_speeds.tables` gives, from the file."""
    with FILE.open(encoding="utf-8") as file:
        far = np.array([float(row[_HEAD[-1]]) for row in csv.DictReader(file)])
    axes = np.log(inchworm.LOADS), inchworm.TURNS, np.log(inchworm.FRICTIONS)
    shape = len(axes[0]), len(axes[2]), len(axes[1])
    return RegularGridInterpolator(axes, far.reshape(shape).transpose(0, 2, 1), "linear", False,
                                   None)  # fmt: skip


if __name__ == "__main__":
    write()
