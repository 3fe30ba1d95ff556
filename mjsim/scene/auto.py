"""The cheapest body, links and time step that were measured to be accurate enough.

Measured on the benchmark scene of mjsim.studies.accuracy, under constant bounds. On other scenes it
is where mjsim.simulation.checked begins.
"""

import csv
from pathlib import Path
from typing import NamedTuple

from analytic.checks import is_number

TABLE = Path(__file__).with_name("auto.csv")  # written by `python -m mjsim.studies.accuracy`


class Choice(NamedTuple):
    """A body and its numerics, their relative error on the worse of felt and gelatin, their cost.

    Attributes:
        body, links, timestep: see mjsim.Scene and mjsim.Numerics.
        error: of the displacement per cycle, relative.
        cost: CPU seconds per simulated second.
    """

    body: str
    links: int
    timestep: float
    error: float
    cost: float


def choices(path: Path = TABLE) -> list[Choice]:
    """What was measured, cheapest first."""
    with path.open(newline="", encoding="utf-8") as file:
        rows = [
            Choice(row["body"], int(row["links"]), float(row["timestep"]), float(row["error"]),
                   float(row["cost"]))
            for row in csv.DictReader(file)
        ]  # fmt: skip
    return sorted(rows, key=lambda choice: choice.cost)


def cheapest(tolerance: float, known: list[Choice] | None = None) -> Choice:
    """The cheapest choice within a relative tolerance on displacement.

    Raises:
        ValueError: nothing was measured to be that accurate; the message names the best.
    """
    known = choices() if known is None else known
    for choice in known:
        if is_number(tolerance) and choice.error <= tolerance:
            return choice
    best = min((choice.error for choice in known), default=float("nan"))
    raise ValueError(f"tolerance must be at least {best:.2g}, the best measured, got {tolerance!r}")
