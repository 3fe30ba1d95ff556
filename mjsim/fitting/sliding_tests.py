"""Readings of tilt and pull tests of a ground, from CSV files or options.

A row is a reading. `angle [deg]` is that of a board at which a sample begins to slide, `force [mN]`
what a level pull is then. `mass [g]` or `load [mN]` is of all that rests on the ground. `width
[mm]` and `length [mm]`, or `area [cm2]`, are of a side that lies flat; `tips` is the number of tips
that a sample stands on instead. `way` is the direction in which it slides (ahead, back or across)
and `state` whether it only begins to or slides on. What all rows share may be options.
"""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from analytic.checks import one_of
from analytic.scene.robot import GRAVITY
from mjsim.files.csv_table import CsvTable, name_of, read_csv
from mjsim.files.units import in_unit

WAYS, STATES, TESTS = ("ahead", "back", "across"), ("begins", "slides"), ("tilt", "pull")
UNITS = {"angle": ("rad", "deg"), "force": ("N", "mN"), "mass": ("kg", "g"), "load": ("N", "mN"),
         "width": ("m", "mm"), "length": ("m", "mm"), "area": ("m^2", "cm2"),
         "tips": ("1", "")}  # fmt: skip
"""Numbers of a reading: SI unit, and one to name in messages."""
SHARED = ("mass", "load", "width", "length", "area", "tips")
_WORDS = {"way": WAYS, "state": STATES}
_OF_A_SIDE = ("width", "length", "area")
_STEEPEST = math.pi / 2


class Reading(NamedTuple):
    """A sample that slides.

    Attributes:
        test: tilt or pull.
        value: angle of the board [rad] or force [N].
        load: weight of all that rests on the ground [N]; NaN if not given.
        size: area of the side [m^2] or number of tips; NaN if not given.
        contact: side or tip.
        way: direction in which it slides.
        state: whether it begins to slide or slides on.
    """

    test: str
    value: float
    load: float
    size: float
    contact: str
    way: str
    state: str

    @property
    def terms(self) -> tuple[float, float, float]:
        """Resistance, size and normal load; of a tilt over the weight, which may be unknown."""
        if self.test == "pull":
            return self.value, self.size, self.load
        return math.sin(self.value), self.size / self.load, math.cos(self.value)

    @property
    def pressed(self) -> float:
        """Normal load over the size: pressure on a side [Pa], force on a tip [N]."""
        level = 1.0 if self.test == "pull" else math.cos(self.value)
        return self.load * level / self.size


class Readings(NamedTuple):
    """Readings of files and options.

    Attributes:
        readings: in their order.
        ignored: heads of columns that are not read.
    """

    readings: tuple[Reading, ...]
    ignored: tuple[str, ...]


def read_tests(
    paths: Sequence[Path], shared: Mapping[str, str], typed: Mapping[str, str]
) -> Readings:
    """Read tests.

    Args:
        paths: of CSV files.
        shared: what rows have that do not say so themselves, SHARED with units, way and state;
            empty where it is not given.
        typed: readings beside those of files: angle and force, with commas between.

    Raises:
        ValueError: a file cannot be read, a row is no reading, or there is none.
    """
    common: dict[str, Any] = {name: _number(name, text) for name, text in shared.items()
                              if text and name not in _WORDS}  # fmt: skip
    for name, valid in _WORDS.items():
        if shared.get(name):
            one_of(name, shared[name], valid)
            common[name] = shared[name]
    readings, ignored = [], []
    for path in paths:
        table = read_csv(path, "data")
        rows, unread = _rows(table)
        ignored += unread
        for (line, _), row in zip(table.rows, rows, strict=True):
            where = f"{table.where}: line {line}: "
            readings.append(_reading(row, common, where))
    for name in ("angle", "force"):
        for text in _listed(typed.get(name, "")):
            readings.append(_reading({name: _number(name, text)}, common, ""))
    if not readings:
        raise ValueError("data must be one CSV file at least, or angle or force, got none")
    return Readings(tuple(readings), tuple(dict.fromkeys(ignored)))


def _rows(table: CsvTable) -> tuple[list[dict[str, Any]], list[str]]:
    """Content of each row, without empty cells, and heads that are not read."""
    rows: list[dict[str, Any]] = [{} for _ in table.rows]
    ignored: list[str] = []
    columns: list[str] = []
    for column, head in enumerate(table.heads):
        name = name_of(head).lower()
        if name in columns:
            raise ValueError(f"{table.where}: column {name!r} stands twice")
        if name in UNITS:
            values = table.numbers(column, *UNITS[name], gaps=True).tolist()
        elif name in _WORDS:
            values = [cells[column].lower() for _, cells in table.rows]
        else:
            ignored.append(head)
            continue
        columns.append(name)
        for row, value in zip(rows, values, strict=True):
            if value != "" and value == value:  # no empty cell, which is NaN among numbers
                row[name] = value
    if not {"angle", "force"} & {*columns}:
        raise ValueError(
            f"{table.where}: needs a column of angles or forces, such as angle [deg] or force "
            f"[mN]; known are {', '.join([*UNITS, *_WORDS])}, got {', '.join(table.heads)}"
        )
    return rows, ignored


def _reading(row: Mapping[str, Any], common: Mapping[str, Any], where: str) -> Reading:
    """The reading of a row, with what all rows share."""
    rivals = {"mass": {"load"}, "load": {"mass"}, "area": {"width", "length", "tips"},
              "width": {"area", "tips"}, "length": {"area", "tips"},
              "tips": {*_OF_A_SIDE}}  # fmt: skip
    cells = {**{name: value for name, value in common.items()
                if not rivals.get(name, set()) & row.keys()}, **row}  # fmt: skip
    kinds = [name for name in ("angle", "force") if name in cells]
    if len(kinds) != 1:
        got = "both" if kinds else "neither"
        raise ValueError(f"{where}a reading must be an angle or a force, got {got}")
    for name in (*kinds, *SHARED):
        if name in cells:
            _check(where, name, cells[name])
    for name, valid in _WORDS.items():
        one_of(f"{where}{name}", cells.get(name, valid[0]), valid)
    contact, size = _size(cells, where)
    if "mass" in cells and "load" in cells:
        raise ValueError(f"{where}mass or load must be given, not both")
    load = cells.get("load", cells.get("mass", math.nan) * GRAVITY)
    (kind,) = kinds
    return Reading(
        "tilt" if kind == "angle" else "pull", cells[kind], load, size, contact,
        cells.get("way", "ahead"), cells.get("state", "begins"),
    )  # fmt: skip


def _size(cells: Mapping[str, Any], where: str) -> tuple[str, float]:
    """Contact and its size."""
    given = [name for name in _OF_A_SIDE if name in cells]
    if "tips" in cells:
        if given:
            raise ValueError(
                f"{where}tips or {given[0]} must be given, not both: a tip has no area"
            )
        return "tip", cells["tips"]
    if "area" in given and len(given) > 1:
        raise ValueError(f"{where}area or {given[0]} must be given, not both")
    if given in (["width"], ["length"]):
        raise ValueError(f"{where}width and length must be given together, got {given[0]} alone")
    if "width" in given:
        return "side", cells["width"] * cells["length"]
    return "side", cells.get("area", math.nan)


def _check(where: str, name: str, value: float) -> None:
    unit = UNITS[name][0]
    if name == "angle":
        if not 0 <= value < _STEEPEST:
            raise ValueError(
                f"{where}angle must be from 0 to below 90 deg, got {math.degrees(value):g} deg"
            )
    elif name == "tips":
        if value < 1 or value != round(value):
            raise ValueError(f"{where}tips must be a whole number of at least 1, got {value:g}")
    elif value < 0 or (value == 0 and name != "force"):
        least = "at least" if name == "force" else "above"
        raise ValueError(f"{where}{name} must be {least} 0 {unit}, got {value:g}")


def _listed(text: str) -> list[str]:
    """Numbers with units from a text with commas between; those without have the last one's."""
    parts = [part.strip() for part in text.split(",") if part.strip()]
    ending = parts[-1].lstrip("+-.0123456789eE") if parts else ""
    return [part if _has_unit(part) else f"{part}{ending}" for part in parts]


def _has_unit(part: str) -> bool:
    try:
        float(part)
    except ValueError:
        return True
    return False


def _number(name: str, text: str) -> float:
    """An option's number in SI; those of a bench have a unit."""
    unit, usual = UNITS[name]
    value = in_unit(name, text, unit)
    if not math.isfinite(value):
        raise ValueError(f"{name} must be a finite number, got {text!r}")
    if usual and not _has_unit(text):
        raise ValueError(f"{name} must be with its unit, as {text}{usual}, got {text!r}")
    return value
