"""Tables of measured numbers: CSV whose heads name their units, as `time [s]` or `p1_kPa`.

Units may also stand as in `Time (in ms)`, `p1 / kPa`, `p1, psig` or `p1 kgf/cm2`. Columns are
separated by commas, or by semicolons, tabs, bars or blanks, then with decimal commas or points; the
lines of a table in Markdown may be framed by bars. Lines that begin with # are comments, and the
last of them the heads where numbers follow.
"""

import csv
import math
import re
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.checks import missing
from analytic.units import find, split_reference
from mjsim.files.units import in_unit

_BRACKETS = re.compile(r"(.*?)\s*[\[({]\s*(?:in\s+)?(.+?)\s*[\])}]\s*")
_BARE = re.compile(r"(.*?)(?:\s*[,/:]\s*|\s+in\s+|\s+|_)(\S+(?:\s*\(?(?:g|a|gauge|abs)\)?)?)\s*")
_SINGLE = ("s", "m", "N", "%")  # units of one letter that need no brackets
_EMPTY = ("", "nan", "na")
MARKS = ";\t|,"  # between cells; a comma may be part of a head where one of the others stands
_CELL = re.compile(r'"[^"]*"|\S+')
_UNIT = re.compile(r"\s+(?=[\[({])")  # blanks between a name and its unit
_NUMBER = re.compile(r"[-+]?(\d|[.,]\d)[-+\d.,eE]*")


class Head(NamedTuple):
    """Title of a column.

    Attributes:
        name: without its unit.
        unit: as written, empty where there is none.
        absolute: whether it is of pressures over none, None where it does not say.
    """

    name: str
    unit: str
    absolute: bool | None


class CsvTable(NamedTuple):
    """Cells of a file.

    Attributes:
        where: the file, for messages.
        heads: of the columns, as written.
        rows: number of the line, and its cells.
        units: that this file alone has, in SI, by a head's unit, or its name if it has none.
    """

    where: str
    heads: list[str]
    rows: list[tuple[int, list[str]]]
    units: Mapping[str, float] = MappingProxyType({})

    def numbers(
        self, column: int, unit: str, units: str, gaps: bool = False
    ) -> NDArray[np.float64]:
        """Numbers of a column in a unit, (n,).

        Args:
            column: from 0 on.
            unit: of the result; "1" for a column whose head names none.
            known: units to name in the message.
            gaps: whether cells may be empty; they become NaN.

        Raises:
            ValueError: the head names no unit, or one of another kind, or a cell is no finite
                number.
        """
        head = self.heads[column]
        cells = [row[column] for _, row in self.rows]
        try:
            values = np.array(cells).astype(float)
        except ValueError:
            values = np.array([math.nan])
        if not np.isfinite(values).all():
            values = np.array([
                math.nan if gaps and cell.lower() in _EMPTY else self._number(line, head, cell)
                for (line, _), cell in zip(self.rows, cells, strict=True)
            ])  # fmt: skip
        return values * (1.0 if unit == "1" else self._factor(head, unit, units))

    def _number(self, line: int, head: str, cell: str) -> float:
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise ValueError(f"{self.where}: line {line}: {head} must be a number, got {cell!r}")
        return value

    def _factor(self, head: str, unit: str, units: str) -> float:
        words = head_of(head).unit
        stated_unit = self.units.get(words or head.strip().lower())
        if stated_unit is not None:
            return stated_unit
        if not words:
            raise ValueError(
                f"{self.where}: column {head!r} must name its unit, such as {units}, in brackets"
            )
        try:
            return in_unit(head, f"1 {words}", unit)
        except ValueError:
            raise ValueError(
                f"{self.where}: column {head!r} must have a unit such as {units}"
            ) from None


def read_csv(path: Path, what: str) -> CsvTable:
    """Read the table of a file.

    Args:
        path: of the file.
        what: kind of the file, for messages.

    Raises:
        ValueError: the file cannot be read, is empty, or a line has too many or too few cells.
    """
    where = f"{what} {str(path)!r}"
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise ValueError(f"{where} cannot be read: {missing(path, error)}") from error
    except UnicodeDecodeError as error:
        raise ValueError(f"{where} is no text: {error}") from error
    written = [(n, line) for n, line in enumerate(text.splitlines(), start=1) if line.strip()]
    lines = [(number, line) for number, line in written if not line.lstrip().startswith("#")]
    if not lines:
        raise ValueError(f"{where} is empty")
    comments = [line.strip("# \t") for number, line in written if number < lines[0][0]]
    if comments and _are_heads(comments[-1], lines[0][1]):
        lines.insert(0, (0, comments[-1]))
    mark = _mark(lines[0][1])
    if mark == "|":
        lines = _unframed(lines)
    decimal = "." if mark == "," else ","
    try:
        (_, heads), *rows = _cells(lines, mark)
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from None
    # loggers that end each line of numbers by a mark
    rows = [(n, row[:-1] if len(row) > len(heads) and not row[-1] else row) for n, row in rows]
    for number, row in rows:
        if len(row) != len(heads):
            raise ValueError(f"{where}: line {number}: needs {len(heads)} numbers, got {len(row)}")
    if decimal != ".":
        rows = [(number, [cell.replace(decimal, ".") for cell in row]) for number, row in rows]
    if rows and _are_units(rows[0][1]):  # a line of units below the names
        (_, units), *rows = rows
        heads = [
            f"{head} [{unit}]" if unit else head for head, unit in zip(heads, units, strict=True)
        ]
    return CsvTable(where, heads, rows)


def _unframed(lines: list[tuple[int, str]]) -> list[tuple[int, str]]:
    """Lines of a table without bars around them, and without a rule below its heads."""
    begun = lines[0][1].lstrip().startswith("|")
    bare = [(number, line.strip().removesuffix("|")) for number, line in lines]
    bare = [(number, line.removeprefix("|") if begun else line) for number, line in bare]
    return [(number, line) for number, line in bare if set(line) - set("|-:+ ")]


def _cells(lines: list[tuple[int, str]], mark: str | None) -> list[tuple[int, list[str]]]:
    """Cells of lines with their numbers; without a mark they are separated by blanks."""
    if odd := next((number for number, line in lines if line.count('"') % 2), 0):
        raise ValueError(f"line {odd}: a quotation mark must be closed in its line")
    if mark is not None:
        split = csv.reader((line for _, line in lines), delimiter=mark)
        return [
            (number, [cell.strip() for cell in row])
            for (number, _), row in zip(lines, split, strict=True)
        ]
    (first, heads), *rows = lines
    cells = [[cell.strip('"') for cell in _CELL.findall(line)] for _, line in rows]
    names = [cell.strip('"') for cell in _CELL.findall(_UNIT.sub("", heads))]
    apart = re.split(r"\s{2,}", heads.strip())  # names of several words
    if cells and len(names) != len(cells[0]) == len(apart):
        names = apart
    return [(first, names), *((number, row) for (number, _), row in zip(rows, cells, strict=True))]


def _mark(heads: str) -> str | None:
    """Mark between cells; None where they are separated by blanks."""
    return next((mark for mark in MARKS if mark in heads), None)


def _are_heads(comment: str, first: str) -> bool:
    """Tell whether a comment before numbers has their heads, as numpy.savetxt writes them."""
    if '"' in comment or _mark(comment) not in (_mark(first), None):
        return False
    (_, heads), (_, numbers) = _cells([(0, comment), (1, first)], _mark(comment))
    return len(heads) == len(numbers) and all(_NUMBER.fullmatch(cell) for cell in numbers)


def _are_units(cells: list[str]) -> bool:
    """Tell whether cells are units, or empty, and no numbers, which "1" is too."""
    words = [cell for cell in cells if cell]
    return bool(words) and all(
        not word[0].isdigit() and find(split_reference(word)[0]) is not None for word in words
    )


def name_of(head: str) -> str:
    """Name of a column without its unit."""
    return head_of(head).name


def head_of(head: str) -> Head:
    """Name and unit of a column, told by brackets, or by a unit that is known behind the name."""
    bare = _BARE.fullmatch(head)
    match, words = _BRACKETS.fullmatch(head), ""
    if match is not None:
        name, words = match[1], match[2]
        # the last brackets, where those before them are part of the name
        inner = _BRACKETS.fullmatch(head[match.start(2) :])
        while inner is not None and find(split_reference(words)[0]) is None:
            name, words = head[: head.rindex(inner[2])].rstrip("[({ "), inner[2]
            inner = _BRACKETS.fullmatch(head[head.rindex(inner[2]) :])
    elif bare is not None and _is_unit(bare[2]):
        name, words = bare[1], bare[2]
    else:
        return Head(head.strip(), "", None)
    unit, absolute = split_reference(words)
    return Head(name.strip(), unit, absolute)


def _is_unit(words: str) -> bool:
    """Tell whether the end of a head is a unit, and no part of its name as in `p_l` or `p_in`."""
    if len(words) == 1 or words == "in":
        return words in _SINGLE
    return find(split_reference(words)[0]) is not None
