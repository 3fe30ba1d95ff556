"""Measured rows: one method at one setting on one piece of case, kept as CSV that grows."""

import csv
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

from studies.accuracy.setting import Setting
from studies.accuracy.timing import Timing

HERE = Path(__file__).resolve().parents[2]
MEASURED = HERE / "docs" / "accuracy.csv"  # what the accuracy study measured last


@dataclass(frozen=True)
class Row:
    """One measurement.

    Attributes:
        case: "settle", "walk" or "coulomb".
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
    def setting(self) -> Setting:
        """The method and its numerics."""
        return Setting(self.method, self.links, self.timestep, self.integrator, self.cone,
                       self.impratio)  # fmt: skip

    @property
    def key(self) -> tuple[str, str, Setting]:
        """What tells this measurement from others."""
        return self.case, self.scene, self.setting


def row(
    case: str,
    scene: str,
    setting: Setting,
    value: float,
    reference: float,
    error: float,
    timing: Timing,
    status: str,
) -> Row:
    """The row of a measurement; where it failed it has no error."""
    return Row(
        case, scene, setting.method, setting.integrator, setting.cone, setting.impratio,
        setting.links, setting.timestep, value, reference,
        error if status == "ok" else math.nan,
        timing.least, timing.median, timing.wall, status,
    )  # fmt: skip


def everywhere(rows: Sequence[Row], case: str) -> dict[Setting, list[Row]]:
    """Rows of each setting that was measured on every scene of a case."""
    groups: dict[Setting, list[Row]] = {}
    for row_ in rows:
        if row_.case == case:
            groups.setdefault(row_.setting, []).append(row_)
    scenes = {row_.scene for row_ in rows if row_.case == case}
    return {key: group for key, group in groups.items() if {row_.scene for row_ in group} == scenes}


def read(path: Path = MEASURED, kind: type[Any] = Row) -> list[Any]:
    """Rows of a file, of one kind of dataclass; none if it is not there.

    Raises:
        ValueError: the file holds something else.
    """
    if not path.is_file():
        return []
    convert = {name: {"int": int, "float": float}.get(_name(of), str)
               for name, of in ((field.name, field.type) for field in fields(kind))}  # fmt: skip
    with path.open(newline="", encoding="utf-8") as file:
        table = csv.DictReader(file)
        if tuple(table.fieldnames or ()) != tuple(convert):
            raise ValueError(f"{path} is no table of rows: its columns are {table.fieldnames}")
        return [
            kind(**{name: convert[name](text) for name, text in line.items()}) for line in table
        ]


def append(rows: Iterable[Any], path: Path) -> Iterator[Any]:
    """Write each row, a dataclass, to the end of a file as it comes, and hand it on.

    A run that is stopped keeps what it had; the next one goes on from there.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    for row in rows:
        values = asdict(row)
        new = not path.is_file()
        with path.open("a", newline="", encoding="utf-8") as file:
            table = csv.DictWriter(file, list(values), lineterminator="\n")
            if new:
                table.writeheader()
            table.writerow(
                {name: f"{v:.6g}" if isinstance(v, float) else v for name, v in values.items()}
            )
        yield row


def _name(of: object) -> str:
    return of.__name__ if isinstance(of, type) else str(of)
