"""What body auto picks from: the settings of MuJoCo's bodies that nothing beats, as a table."""

import csv
from collections.abc import Sequence
from pathlib import Path

from mjsim import registry
from mjsim.io.files import whole
from mjsim.scene.auto import Choice
from mjsim.studies.accuracy.benchmark_cases import WALK
from mjsim.studies.accuracy.rows import Row, everywhere


def choices(rows: Sequence[Row]) -> list[Choice]:
    """Discrete settings that were measured on all grounds, failed on none, and are on the front.

    By the worse of their errors and costs, cheapest first.
    """
    known = [
        Choice(setting.method, setting.links, setting.timestep,
               max(row.error for row in group), max(row.cost for row in group))
        for setting, group in everywhere(rows, WALK).items()
        if setting.method in registry.names() and setting.integrator == "discrete"
        and all(row.status == "ok" for row in group)
    ]  # fmt: skip
    front: list[Choice] = []
    for choice in sorted(known, key=lambda choice: (choice.cost, choice.error)):
        if not front or choice.error < front[-1].error:
            front.append(choice)
    return front


def write_choices(rows: Sequence[Row], path: Path) -> None:
    """Write them as CSV."""
    with whole(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(Choice._fields)
        table.writerows(choices(rows))
