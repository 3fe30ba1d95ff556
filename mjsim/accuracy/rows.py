"""Measured rows: one method at one setting on one piece of work, kept as CSV that grows."""

import csv
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
MEASURED = HERE / "rows.csv"  # what `python -m mjsim.chart` measured last, kept with the code


@dataclass(frozen=True)
class Row:
    """One measurement.

    Attributes:
        work: "settle" or "walk".
        scene: of the work: the surface, or "tip".
        method: body or rung, and what of it is not usual.
        integrator: of MuJoCo or of the peer; "" where there is none.
        links: elements.
        timestep: [s]; 0 for a quasi-static method.
        value, reference: displacement per cycle, or distance of the tip from its exact place [L].
        error: relative on displacement, over L for the tip; NaN where it failed.
        cost, median: least and median seconds of one core per simulated second.
        status: "ok", or how it failed.
        machine, versions, commit: where and of what.
    """

    work: str
    scene: str
    method: str
    integrator: str
    links: int
    timestep: float
    value: float
    reference: float
    error: float
    cost: float
    median: float
    status: str
    machine: str = ""
    versions: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[str, str, str, str, int, float]:
        """What tells this measurement from others."""
        return self.work, self.scene, self.method, self.integrator, self.links, self.timestep


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
