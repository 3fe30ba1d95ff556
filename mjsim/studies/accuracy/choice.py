"""The cheapest body, links and time step that were measured to be accurate enough."""

from collections.abc import Sequence
from typing import NamedTuple

from mjsim.scene import BODIES
from mjsim.studies.accuracy.benchmark_cases import WALK
from mjsim.studies.accuracy.rows import Row, everywhere, read
from mjsim.studies.accuracy.setting import Setting


class Choice(NamedTuple):
    """A setting, its relative error on the worse of felt and gelatin, and its cost [s/s]."""

    setting: Setting
    error: float
    cost: float


def choices(rows: Sequence[Row] | None = None) -> list[Choice]:
    """Every MuJoCo setting that was measured on all grounds and failed on none, cheapest first."""
    groups = everywhere(read() if rows is None else rows, WALK)
    whole = [
        Choice(setting, max(row.error for row in group), max(row.cost for row in group))
        for setting, group in groups.items()
        if setting.method in BODIES and all(row.status == "ok" for row in group)
    ]
    return sorted(whole, key=lambda choice: choice.cost)


def cheapest(tolerance: float, rows: Sequence[Row] | None = None) -> Choice:
    """The cheapest setting within a relative tolerance on displacement.

    Raises:
        ValueError: no setting was measured to be that accurate; the message names the best.
    """
    known = choices(rows)
    for choice in known:
        if choice.error <= tolerance:
            return choice
    best = min((choice.error for choice in known), default=float("nan"))
    raise ValueError(f"tolerance must be at least {best:.2g}, the best measured, got {tolerance!r}")
