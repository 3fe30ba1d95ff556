"""What was measured, from CSV files: tracks along time, bending under pressure, runs.

A file is one of three kinds, told by its columns, whose heads name their units:

- `time [s]` and some of `left [mm]`, `right [mm]`, `x@0.25 [mm]`, `z@0.5 [mm]`: places of the ends
  and of points marked at a part of the length, along a walk whose gait begins at time 0. Where the
  camera's x is 0 does not matter.
- `pressure [kPa]` and `angle [deg]`: of a free segment; `length [mm]` if it is not the robot's.
- `displacement [mm]` per cycle, `speed [mm/s]` or `height [mm]`: a row a run.

Any of them may have columns that tell runs apart: `surface`, a name, and fields of the scene such
as `robot.peak_pressure [kPa]` or `gait.ramp_time [s]`. Cells may be empty.
"""

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mjsim.files.csv_table import CsvTable, factor, name_of, number_in, read_csv
from mjsim.fitting.parameters import unit_of

Array = NDArray[np.float64]

_PLACE = re.compile(r"^([xz])@(\d*\.?\d+)$")
_UNITS = {"time": ("s", "s or ms"), "pressure": ("Pa", "kPa or psi"), "angle": ("rad", "deg"),
          "length": ("m", "mm"), "speed": ("m/s", "mm/s"), "displacement": ("m", "mm"),
          "height": ("m", "mm"), "left": ("m", "mm"), "right": ("m", "mm")}  # fmt: skip
_OF_RUNS = ("displacement", "speed", "height")
SURFACE = "surface"
_EMPTY = ("", "nan", "na")


class Run(NamedTuple):
    """What tells a run from others.

    Attributes:
        surface: its name, or None for the scene's ground.
        fields: of the scene that have other values in it, by name.
    """

    surface: str | None = None
    fields: tuple[tuple[str, float], ...] = ()

    def __str__(self) -> str:
        """What is special about it."""
        words = [self.surface] if self.surface else []
        return " ".join([*words, *(f"{name} {value:.4g}" for name, value in self.fields)])


class Series(NamedTuple):
    """Numbers of one kind.

    Attributes:
        name: file and column.
        quantity: left, right, x, z, angle, displacement, speed or height.
        place: of a marked point, over the length; else 0.
        at: times of a track [s], pressures of an angle [Pa]; numbers of rows of runs, (n,).
        value: what was measured, (n,) [m, rad or m/s].
        runs: of each value, or of all of them if it is one.
        length: of the segment that bends [m], 0 for one of the robot's.
        offset: number of the series' datum of x, or None where there is none to be found.
    """

    name: str
    quantity: str
    place: float
    at: Array
    value: Array
    runs: tuple[Run, ...]
    length: float = 0.0
    offset: int | None = None

    @property
    def unit(self) -> str:
        """Of the values."""
        return {"angle": "rad", "speed": "m/s"}.get(self.quantity, "m")

    @property
    def noise(self) -> str:
        """What series with noise of the same size have in common."""
        place = ("left", "right", "x", "z")
        return "position" if self.quantity in place else self.quantity


def read_observations(paths: Sequence[Path]) -> list[Series]:
    """The series of all files.

    Raises:
        ValueError: a file cannot be read, is of none of the three kinds, or holds no number.
    """
    found: list[Series] = []
    offsets = 0
    for path in paths:
        new = _of_file(path, offsets)
        offsets += len({series.offset for series in new if series.offset is not None})
        found += new
    return found


def _of_file(path: Path, offsets: int) -> list[Series]:
    table = read_csv(path, "data")
    names = [name_of(head) for head in table.heads]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{table.where}: column {name!r} stands twice")
    marks = [name for name in names if name == SURFACE or ("." in name and "@" not in name)]
    measured = [name for name in names if name not in marks]
    index = _index(table, names, measured)
    read = {name: _column(table, name, column) for column, name in enumerate(names)}
    runs = [
        Run(
            None if SURFACE not in marks else str(read[SURFACE][row]),
            tuple((name, float(read[name][row])) for name in marks if name != SURFACE),
        )
        for row in range(len(table.rows))
    ]
    series = []
    for run in dict.fromkeys(runs) if index != "run" else [None]:
        rows = np.array([run is None or other == run for other in runs], dtype=bool)
        of_runs = tuple(runs) if run is None else (run,)
        offset = None
        for name in measured:
            if name in (index, "length"):
                continue
            values = np.asarray(read[name])
            kept = rows & np.isfinite(values)
            if not kept.any():
                continue
            place = _PLACE.match(name)
            quantity = place.group(1) if place else name
            if quantity in ("left", "right", "x"):
                offset = offsets if offset is None else offset
            special = f", {run}" if run and str(run) else ""
            series.append(
                Series(
                    f"{path.name}: {name}{special}",
                    quantity,
                    float(place.group(2)) if place else 0.0,
                    _at(read, index, kept),
                    values[kept],
                    tuple(r for r, k in zip(of_runs, kept, strict=True) if k)
                    if run is None else of_runs,
                    _length(table, read.get("length"), kept),
                    offset if quantity in ("left", "right", "x") else None,
                )
            )  # fmt: skip
        offsets += offset is not None
    if not series:
        raise ValueError(f"{table.where}: holds no number to fit")
    return series


def _index(table: CsvTable, names: list[str], measured: list[str]) -> str:
    """The column that the others are a function of: time, pressure, or run where there is none."""
    known = {"time": "left, right, x@0.25, z@0.5", "pressure": "angle",
             "run": ", ".join(_OF_RUNS)}  # fmt: skip
    index = next((name for name in ("time", "pressure") if name in names), "run")
    fits = {"time": ("left", "right"), "pressure": ("angle", "length"), "run": _OF_RUNS}[index]
    others = [name for name in measured if name != index]
    wrong = [
        name for name in others
        if name not in fits and not (index == "time" and _PLACE.match(name))
    ]  # fmt: skip
    beside = "" if index == "run" else f"beside {index} "
    if wrong or not others:
        raise ValueError(
            f"{table.where}: column {wrong[0] if wrong else ''!r} is unknown; known {beside}are "
            f"{known[index]}, surface, and fields such as robot.peak_pressure"
        )
    for name in others:
        place = _PLACE.match(name)
        if place and float(place.group(2)) > 1:
            raise ValueError(f"{table.where}: {name}: a place must be a part of the length, 0 to 1")
    return index


def _column(table: CsvTable, name: str, column: int) -> Any:
    """Numbers of a column in the program's unit, NaN where empty; texts of the surfaces."""
    head = table.heads[column]
    if name == SURFACE:
        return [row[column] for _, row in table.rows]
    if "." in name and "@" not in name:
        try:
            unit = unit_of(name)
        except ValueError as error:
            raise ValueError(f"{table.where}: {error}") from error
        scale = 1.0 if unit == "1" else factor(table, head, unit, unit)
        needed = True
    else:
        unit, known = _UNITS.get(name, ("m", "mm"))
        scale, needed = factor(table, head, unit, known), name in ("time", "pressure", "length")
    return np.array([
        math.nan if row[column].lower() in _EMPTY and not needed
        else scale * number_in(table, line, head, row[column])
        for line, row in table.rows
    ])  # fmt: skip


def _at(read: dict[str, Any], index: str, kept: NDArray[np.bool_]) -> Array:
    if index == "run":
        return np.flatnonzero(kept) + np.float64(1)
    return np.asarray(read[index], dtype=np.float64)[kept]


def _length(table: CsvTable, values: Any, kept: NDArray[np.bool_]) -> float:
    if values is None:
        return 0.0
    found = set(np.asarray(values)[kept].tolist())
    if len(found) > 1 or min(found) <= 0:
        raise ValueError(f"{table.where}: length must be one above 0, got {sorted(found)}")
    return float(found.pop())
