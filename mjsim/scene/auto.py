"""Numerics of body auto: links and time steps, each finer than the one before.

Chosen on random robots of 3 to 10 segments, gaits, grounds and ramps of 0.5 to 4 s, of which
`python benchmarks/auto.py design` measures how often each is right and at what speed, and what
answers by two that agree cost. mjsim.simulation.checked walks them, coarsest first, until two in a
row agree closely.
"""

import csv
from pathlib import Path
from typing import NamedTuple

from analytic.checks import is_number

TABLE = Path(__file__).with_name("auto.csv")
_TIGHTEST = 0.005  # tolerance on which it was measured


class Level(NamedTuple):
    """Links and time step.

    Attributes:
        contacts: where friction acts, "ends" or "all".
        links_per_segment, timestep: [1, s].
        steps_per_ramp: that a ramp has at least, however short.
    """

    contacts: str
    links_per_segment: int
    timestep: float
    steps_per_ramp: int


def check_tolerance(tolerance: float) -> None:
    """Raise ValueError for a tolerance that is none, or tighter than what was measured."""
    if not is_number(tolerance) or not _TIGHTEST <= tolerance <= 1:
        raise ValueError(f"tolerance must lie between {_TIGHTEST} and 1, got {tolerance!r}")


def levels(contacts: str) -> list[Level]:
    """Levels to walk, coarsest first.

    Args:
        contacts: "ends" or "all".
    """
    with TABLE.open(newline="", encoding="utf-8") as file:
        return [
            Level(row["contacts"], int(row["links_per_segment"]), float(row["timestep"]),
                  int(row["steps_per_ramp"]))
            for row in csv.DictReader(file) if row["contacts"] == contacts
        ]  # fmt: skip
