"""Tables of measured numbers: CSV whose heads name their units, as `time [s]` or `p1_kPa`.

Commas, semicolons (then with decimal commas) or tabs between; lines that begin with # are comments.
"""

import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

from mjsim.files.units import in_unit

_BRACKETS = re.compile(r"^(.*?)\s*[\[(]\s*(.+?)\s*[\])]\s*$")
_SUFFIX = re.compile(r"^(.+)_([A-Za-z]+)$")


class CsvTable(NamedTuple):
    """What a file holds.

    Attributes:
        where: the file, for messages.
        heads: of the columns, as written.
        rows: number of the line, and its cells.
    """

    where: str
    heads: list[str]
    rows: list[tuple[int, list[str]]]


def read_csv(path: Path, what: str) -> CsvTable:
    """The table of a file.

    Args:
        path: of the file.
        what: it is, for messages.

    Raises:
        ValueError: the file cannot be read, is empty, or a line has too many or too few cells.
    """
    where = f"{what} {str(path)!r}"
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise ValueError(f"{where} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ValueError(f"{where} is no text: {error}") from error
    lines = [
        (number, line)
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise ValueError(f"{where} is empty")
    comma = max(";\t,", key=lambda mark: (mark in lines[0][1], -";\t,".index(mark)))
    cells = csv.reader([line for _, line in lines], delimiter=comma)
    decimal = comma == ";"  # where the comma is the decimal mark
    (_, heads), *rows = [
        (number, [cell.strip().replace(",", ".") if decimal else cell.strip() for cell in row])
        for (number, _), row in zip(lines, cells, strict=True)
    ]
    for number, row in rows:
        if len(row) != len(heads):
            raise ValueError(f"{where}: line {number}: needs {len(heads)} numbers, got {len(row)}")
    return CsvTable(where, heads, rows)


def name_of(head: str) -> str:
    """What a column is of, without its unit in brackets."""
    found = _BRACKETS.match(head)
    return found.group(1) if found else head


def factor(table: CsvTable, head: str, unit: str, known: str) -> float:
    """What a column's numbers are to be multiplied with to be in a unit.

    Args:
        table: whose column it is.
        head: of the column.
        unit: that is wanted.
        known: units to name in the message.

    Raises:
        ValueError: the head names no unit, or one of another kind.
    """
    found = _BRACKETS.match(head) or _SUFFIX.match(head)
    if found is None:
        raise ValueError(
            f"{table.where}: column {head!r} must name its unit, such as {known}, in brackets"
        )
    try:
        return in_unit(head, f"1 {found.group(2)}", unit)
    except ValueError:
        raise ValueError(
            f"{table.where}: column {head!r} must have a unit such as {known}"
        ) from None


def number_in(table: CsvTable, line: int, head: str, cell: str) -> float:
    """The number of a cell.

    Raises:
        ValueError: it is none, or not finite.
    """
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f"{table.where}: line {line}: {head} must be a number, got {cell!r}")
    return value
