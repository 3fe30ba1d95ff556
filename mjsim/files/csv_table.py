"""Tables of measured numbers: CSV whose heads name their units, as `time [s]` or `p1_kPa`.

Columns are separated by commas, semicolons (then with decimal commas) or tabs; lines that begin
with # are comments.
"""

import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mjsim.files.units import in_unit

_UNIT = re.compile(r"(.*?)\s*[\[(]\s*(.+?)\s*[\])]\s*|.+_([A-Za-z]+)")
_EMPTY = ("", "nan", "na")


class CsvTable(NamedTuple):
    """Cells of a file.

    Attributes:
        where: the file, for messages.
        heads: of the columns, as written.
        rows: number of the line, and its cells.
    """

    where: str
    heads: list[str]
    rows: list[tuple[int, list[str]]]

    def numbers(
        self, column: int, unit: str, known: str, gaps: bool = False
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
        values = [
            math.nan if gaps and row[column].lower() in _EMPTY
            else self._number(line, head, row[column])
            for line, row in self.rows
        ]  # fmt: skip
        return np.array(values) * (1.0 if unit == "1" else self._factor(head, unit, known))

    def _number(self, line: int, head: str, cell: str) -> float:
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise ValueError(f"{self.where}: line {line}: {head} must be a number, got {cell!r}")
        return value

    def _factor(self, head: str, unit: str, known: str) -> float:
        match = _UNIT.fullmatch(head)
        if match is None:
            raise ValueError(
                f"{self.where}: column {head!r} must name its unit, such as {known}, in brackets"
            )
        try:
            return in_unit(head, f"1 {match.group(2) or match.group(3)}", unit)
        except ValueError:
            raise ValueError(
                f"{self.where}: column {head!r} must have a unit such as {known}"
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
        raise ValueError(f"{where} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ValueError(f"{where} is no text: {error}") from error
    lines = {
        number: line
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    }
    if not lines:
        raise ValueError(f"{where} is empty")
    first = next(iter(lines.values()))
    mark = next((mark for mark in ";\t" if mark in first), ",")
    decimal = "," if mark == ";" else "."
    (_, heads), *rows = [
        (number, [cell.strip().replace(decimal, ".") for cell in row])
        for number, row in zip(lines, csv.reader(lines.values(), delimiter=mark), strict=True)
    ]
    for number, row in rows:
        if len(row) != len(heads):
            raise ValueError(f"{where}: line {number}: needs {len(heads)} numbers, got {len(row)}")
    return CsvTable(where, heads, rows)


def name_of(head: str) -> str:
    """Name of a column without its unit in brackets."""
    match = _UNIT.fullmatch(head)
    return match.group(1) or head if match else head
