"""Numerics of body auto: links and time steps, each finer than the one before, as measured.

Measured on random robots of 3 to 10 segments, gaits, grounds and ramps of 0.5 to 4 s, by
`python benchmarks/auto.py design`: on how many of them the displacement per cycle is within a
tolerance, or 0.001 L, of that of 16 links a segment (32 with contacts between the ends) at 2 ms.
mjsim.simulation.checked walks them, coarsest first, until two in a row agree closely.
"""

import csv
from pathlib import Path
from typing import NamedTuple

from analytic.checks import is_number

TABLE = Path(__file__).with_name("auto.csv")
_TIGHTEST = 0.005  # tolerance that was measured


class Level(NamedTuple):
    """Links and time step, with their measured accuracy and speed.

    Attributes:
        contacts: where friction acts, "ends" or "all".
        links_per_segment, timestep: [1, s].
        steps_per_ramp: that a ramp has at least, however short.
        scenes: number of scenes on which it was measured.
        within_10, within_2, within_half: part of them within 10 %, 2 % and 0.5 %.
        realtime: median of simulated time over CPU time.
    """

    contacts: str
    links_per_segment: int
    timestep: float
    steps_per_ramp: int
    scenes: int
    within_10: float
    within_2: float
    within_half: float
    realtime: float


def check_tolerance(tolerance: float) -> None:
    """Raise ValueError for a tolerance that is none, or tighter than what was measured."""
    if not is_number(tolerance) or not _TIGHTEST <= tolerance <= 1:
        raise ValueError(f"tolerance must lie between {_TIGHTEST} and 1, got {tolerance!r}")


def levels(contacts: str, path: Path = TABLE) -> list[Level]:
    """Levels to walk, coarsest first.

    Args:
        contacts: "ends" or "all".
        path: of the table.
    """
    with path.open(newline="", encoding="utf-8") as file:
        return [
            Level(row["contacts"], int(row["links_per_segment"]), float(row["timestep"]),
                 int(row["steps_per_ramp"]), int(row["scenes"]),
                 *(float(row[name]) for name in Level._fields[5:]))
            for row in csv.DictReader(file) if row["contacts"] == contacts
        ]  # fmt: skip
