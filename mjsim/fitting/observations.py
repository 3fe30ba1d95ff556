"""Measurements from CSV files: tracks along time, bending under pressure, runs.

A file is one of three kinds, told by its columns, whose heads name their units:

- `time [s]` and some of `left [mm]`, `right [mm]`, `x@0.25 [mm]`, `z@0.5 [mm]`: places of the ends
  and of points marked at a part of the length, along a walk whose gait begins at time 0. Where the
  camera's x is 0 does not matter. With a camera that is known `frame` may stand for time, and
  places may be in `[px]`.
- `pressure [kPa]` and `angle [deg]`: of a free segment; `length [mm]` if it is not the robot's. The
  log of a bench may have `time [s]` too; the segment is taken to be at rest at each sample.
- `displacement [mm]` per cycle, `speed [mm/s]`, `height [mm]` or, of a robot of limbs, `turn [deg]`
  to the left per cycle: a row per run.

Of a robot of limbs left and right are the beginning and the end of the trunk, and points are marked
along it.

Any of them may have columns that tell runs apart: `surface`, a name, and fields of the scene such
as `robot.peak_pressure [kPa]` or `gait.ramp_time [s]`. Cells may be empty. Capitals do not matter,
and columns of other names beside known ones are ignored, which `Series.ignored` tells.
"""

import itertools
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.checks import one_of
from mjsim.files.csv_table import CsvTable, name_of, read_csv
from mjsim.fitting.camera import FRAME, Camera
from mjsim.fitting.parameters import unit_of

Array = NDArray[np.float64]

_PLACE = re.compile(r"([xz])@(\d*\.?\d+)")
_UNITS = {"time": ("s", "s or ms"), "pressure": ("Pa", "kPa or psi"), "angle": ("rad", "deg"),
          "speed": ("m/s", "mm/s"), "turn": ("rad", "deg")}  # fmt: skip
_LENGTH = ("m", "mm")  # of all others
_TIME, PRESSURE, RUN = "time", "pressure", "run"  # abscissas of the other columns
_ANGLE, _SEGMENT = "angle", "length"
ZEROS = (_ANGLE, PRESSURE)  # what a bench may read where there is none
_SHORT = {"t": _TIME, "p": PRESSURE, "theta": _ANGLE}
_ALONG = {
    _TIME: "left, right, x@0.25, z@0.5",
    PRESSURE: "angle, length",
    RUN: "displacement, speed, height, turn",
}
SURFACE = "surface"
_UNKNOWN = Camera()


class Run(NamedTuple):
    """Conditions of a run that differ from the scene's.

    Attributes:
        surface: its name, or None for the scene's ground.
        fields: of the scene that have other values in it, by name.
    """

    surface: str | None = None
    fields: tuple[tuple[str, float], ...] = ()

    def __str__(self) -> str:
        """Conditions in a few words."""
        words = [self.surface] if self.surface else []
        return " ".join([*words, *(f"{name} {value:.4g}" for name, value in self.fields)])


class Series(NamedTuple):
    """Numbers of one kind.

    Attributes:
        name: file and column.
        quantity: left, right, x, z, angle, displacement, speed, height or turn.
        place: of a marked point, over the length; else 0.
        at: times of a track [s], pressures of an angle [Pa]; numbers of rows of runs, (n,).
        value: measurements, (n,) [m, rad or m/s].
        runs: of each value, or of all of them if it is one.
        length: of the segment that bends [m], 0 for one of the robot's.
        offset: number of the series' zero, or None where there is none to be found: the x of the
            camera, or of the quantity that `zero` names.
        zero: angle or pressure, or empty.
        ignored: heads of columns of the file that are not read.
    """

    name: str
    quantity: str
    place: float
    at: Array
    value: Array
    runs: tuple[Run, ...]
    length: float = 0.0
    offset: int | None = None
    zero: str = ""
    ignored: tuple[str, ...] = ()

    @property
    def abscissa(self) -> str:
        """Quantity of `at`: time, pressure or run."""
        if self.quantity == _ANGLE:
            return PRESSURE
        return RUN if self.quantity in _ALONG[RUN].split(", ") else _TIME

    @property
    def unit(self) -> str:
        """Unit of the values."""
        return _UNITS.get(self.quantity, _LENGTH)[0]

    @property
    def noise(self) -> str:
        """Kind of the noise, which has one size in all series of that kind."""
        return "position" if self.abscissa == _TIME else self.quantity


def read_observations(
    paths: Sequence[Path], zero: str = "", camera: Camera = _UNKNOWN
) -> list[Series]:
    """Read the series of all files.

    Args:
        paths: of the files.
        zero: angle or pressure, of which each file of bending has a zero that is to be found; or
            empty.
        camera: of columns in pixels and of numbers of pictures.

    Raises:
        ValueError: a file cannot be read, is of none of the three kinds, or has no number; time
            goes back; there is no file of bending that has a zero; or the camera is not known.
    """
    if zero:
        one_of("zero", zero, ZEROS)
    offsets = itertools.count()
    tables = [read_csv(path, "data") for path in paths]
    camera.check(tables)
    series = [series for path, table in zip(paths, tables, strict=True)
              for series in _of_file(path, table, offsets, zero, camera)]  # fmt: skip
    if zero and not any(each.zero for each in series):
        raise ValueError(f"zero is of files of pressure and angle, got {zero!r} and no such file")
    return series


def _of_file(
    path: Path, table: CsvTable, offsets: Iterator[int], zero: str, camera: Camera
) -> list[Series]:
    names = [_name(head) for head in table.heads]
    if not {_TIME, PRESSURE} & {*names}:
        names = [_TIME if name == FRAME else name for name in names]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{table.where}: column {name!r} stands twice")
    marks = [name for name in names if _is_field(name)]
    abscissa, measured = _columns(table, names, marks)
    used = {abscissa, SURFACE, *marks, *measured}
    read = [head for head, name in zip(table.heads, names, strict=True) if name in used]
    table = table._replace(units=camera.units(table.where, read))
    unread = {*names} - used - ({_TIME} if abscissa == PRESSURE else set())
    ignored = tuple(h for h, name in zip(table.heads, names, strict=True) if name in unread)
    cells = {name: _column(table, name, column) for column, name in enumerate(names)
             if name in used}  # fmt: skip
    runs = [
        Run(surface, tuple((name, float(cells[name][row])) for name in marks))
        for row, surface in enumerate(cells.get(SURFACE, [None] * len(table.rows)))
    ]
    series = []
    of_bench = next(offsets) if zero and abscissa == PRESSURE else None
    for run in [None] if abscissa == RUN else dict.fromkeys(runs):
        rows = np.array([run is None or row_run == run for row_run in runs], dtype=bool)
        offset = next(offsets)
        if abscissa == _TIME:
            _check_clock(table, cells[_TIME], np.flatnonzero(rows))
        for name in measured:
            kept = rows & np.isfinite(cells[name])
            if name == _SEGMENT or not kept.any():
                continue
            match = _PLACE.fullmatch(name)
            quantity, place = match.groups() if match else (name, 0.0)
            numbers = np.flatnonzero(kept)
            series.append(
                Series(
                    f"{path.name}: {name}" + (f", {run}" if run and str(run) else ""),
                    quantity,
                    float(place),
                    numbers + np.float64(1) if abscissa == RUN else cells[abscissa][kept],
                    cells[name][kept],
                    tuple(runs[row] for row in numbers) if run is None else (run,),
                    _length(table, cells[_SEGMENT][kept]) if _SEGMENT in cells else 0.0,
                    offset if quantity in ("left", "right", "x") else of_bench,
                    zero if abscissa == PRESSURE else "",
                    ignored,
                )
            )
    if not series:
        raise ValueError(f"{table.where}: has no number to fit")
    return series


def _check_clock(table: CsvTable, times: Array, rows: NDArray[np.intp]) -> None:
    """Refuse times of a run that go back."""
    back = np.flatnonzero(np.diff(times[rows]) < 0)
    if back.size:
        before, after = rows[back[0]], rows[back[0] + 1]
        raise ValueError(f"{table.where}: line {table.rows[after][0]}: time must not go back, got "
                         f"{times[after]:g} s after {times[before]:g} s")  # fmt: skip


def _name(head: str) -> str:
    """Name of a column, in small letters and spelled out, but for fields of the scene."""
    name = name_of(head)
    return name if _is_field(name) else _SHORT.get(name.lower(), name.lower())


def _is_field(name: str) -> bool:
    """True for a column of a field of the scene, as robot.peak_pressure."""
    return "." in name and "@" not in name


def _columns(table: CsvTable, names: list[str], marks: list[str]) -> tuple[str, list[str]]:
    """Columns to read: what the others are a function of, time, pressure or run; and the others.

    Time stands beside pressure and angle in the log of a bench, whose samples are of rest.
    """
    bench = PRESSURE in names and _ANGLE in names
    abscissa = PRESSURE if bench else next((n for n in (_TIME, PRESSURE) if n in names), RUN)
    heads = _ALONG[abscissa]
    others = [name for name in names if name not in (abscissa, SURFACE, *marks)]
    places = {name: _PLACE.fullmatch(name) if abscissa == _TIME else None for name in others}
    columns = [name for name in others if places[name] or name in heads.split(", ")]
    if not {*columns} - {_SEGMENT}:
        unknown = next((name for name in others if name not in columns), "")
        beside = "" if abscissa == RUN else f"beside {abscissa} "
        raise ValueError(
            f"{table.where}: column {unknown!r} is unknown; known {beside}are {heads}, surface, "
            "and fields such as robot.peak_pressure"
        )
    track = [name for name in others if name in ("left", "right") or _PLACE.fullmatch(name)]
    if bench and track:
        raise ValueError(
            f"{table.where}: {track[0]!r}, of a walk, and angle, of a free segment, must be in "
            "files of their own"
        )
    for name, place in places.items():
        if place and float(place.group(2)) > 1:
            raise ValueError(f"{table.where}: {name}: a place must be a part of the length, 0 to 1")
    return abscissa, columns


def _column(table: CsvTable, name: str, column: int) -> Any:
    """Numbers of a column in SI, NaN where empty; texts of the surfaces."""
    if name == SURFACE:
        return [row[column] for _, row in table.rows]
    if not _is_field(name):
        gaps = name not in (_TIME, PRESSURE, _SEGMENT)
        return table.numbers(column, *_UNITS.get(name, _LENGTH), gaps)
    try:
        unit = unit_of(name)
    except ValueError as error:
        raise ValueError(f"{table.where}: {error}") from error
    return table.numbers(column, unit, unit)


def _length(table: CsvTable, values: Array) -> float:
    lengths = np.unique(values).tolist()
    if len(lengths) > 1 or lengths[0] <= 0:
        raise ValueError(f"{table.where}: length must be one above 0, got {lengths}")
    return float(lengths[0])
