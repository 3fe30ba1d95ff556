"""The cheapest body, links and time step that were measured to be accurate enough."""

from collections.abc import Sequence
from typing import NamedTuple

from mjsim.accuracy.grid import GROUNDS, WORK, Setting
from mjsim.accuracy.rows import Row, read
from mjsim.config import BODIES


class Choice(NamedTuple):
    """A setting, its relative error on the worse of felt and gelatin, and its cost [s/s]."""

    setting: Setting
    error: float
    cost: float


def choices(rows: Sequence[Row] | None = None) -> list[Choice]:
    """Every MuJoCo setting that was measured on all grounds and failed on none, cheapest first."""
    found: dict[Setting, dict[str, Row]] = {}
    for row in read() if rows is None else rows:
        if row.work == WORK and row.method in BODIES and row.status == "ok":
            setting = Setting(row.method, row.links, row.timestep, row.integrator)
            found.setdefault(setting, {})[row.scene] = row
    whole = [
        Choice(setting, max(row.error for row in on.values()), max(row.cost for row in on.values()))
        for setting, on in found.items()
        if len(on) == len(GROUNDS)
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
