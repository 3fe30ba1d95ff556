"""Measured rows of the accuracy study: one method at one setting on one scene of a case."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from studies import table
from studies.accuracy.setting import Setting, setting_of
from studies.accuracy.timing import Timing

MEASURED = table.DOCS / "accuracy.csv"


@dataclass(frozen=True)
class Row:
    """One measurement.

    Attributes:
        case: "cantilever", "walk" or "coulomb".
        scene: of the case: the surface, or "tip".
        method, integrator, cone, impratio, links, timestep: see Setting.
        value, reference: displacement per cycle, or distance of the tip from its exact place [L].
        error: relative on displacement, over L for the tip; NaN where it failed.
        cost, median, wall: least and median CPU seconds, and least seconds by the clock, per
            simulated second.
        status: "ok", or how it failed.
        machine, versions, commit: where and of what.
    """

    case: str
    scene: str
    method: str
    integrator: str
    cone: str
    impratio: float
    links: int
    timestep: float
    value: float
    reference: float
    error: float
    cost: float
    median: float
    wall: float
    status: str
    machine: str = ""
    versions: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[str, str, Setting]:
        """The case, its scene and the setting."""
        return self.case, self.scene, setting_of(self)


def row(
    case: str, scene: str, setting: Setting, value: float, exact: float, timing: Timing, status: str
) -> Row:
    """The row of a measurement; where it failed it has no error."""
    error = abs(value / exact - 1) if exact else value
    return Row(case, scene, **asdict(setting), value=value, reference=exact,
               error=error if status == "ok" else math.nan, cost=timing.least,
               median=timing.median, wall=timing.wall, status=status)  # fmt: skip


def read(path: Path = MEASURED) -> list[Row]:
    """Rows of a file; none if it is not there.

    Raises:
        ValueError: the file lacks a column.
    """
    return [Row(**values) for values in table.read(path, Row).to_dict("records")]


def append(rows: Iterable[Row], path: Path) -> Iterator[Row]:
    """Write each row to the end of a file as it comes, and yield it."""
    for measured in rows:
        table.append(asdict(measured), path)
        yield measured
