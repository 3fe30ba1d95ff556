"""Tables to read: columns as wide as their cells, words to the left, numbers to the right."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

NONE = "-"


class Column(NamedTuple):
    """A column of a table.

    Attributes:
        head: its title.
        key: of the rows' values.
        form: how a number is written, as "+.4f"; empty in a column of words.
        error: whether it is of errors, of which one that is less than its digits show is written
            as "<0.0001", not as none.
    """

    head: str
    key: str
    form: str = ""
    error: bool = False

    def cell(self, row: dict[str, Any]) -> str:
        """The value of a row as it is written; a dash where there is none."""
        value = row.get(self.key)
        if value is None or value == "":
            return NONE
        if isinstance(value, str):
            return value
        text = format(value, self.form)
        if self.error and value and not float(text):
            return f"<{text[:-1]}1"
        return text


def counts(numbers: Mapping[str, int]) -> str:
    """Words for numbers by name: "ok 12, slid 3"."""
    return ", ".join(f"{name} {number:,}" for name, number in numbers.items())


def text_table(columns: Sequence[Column], rows: Sequence[dict[str, Any]]) -> str:
    """Lines of a table with its heads; an empty row is an empty line."""
    cells = [[column.cell(row) for column in columns] if row else [] for row in rows]
    every = [[column.head for column in columns], *cells]
    widths = [max(len(line[i]) for line in every if line) for i in range(len(columns))]
    return "\n".join(
        "  ".join(
            cell.rjust(width) if column.form else cell.ljust(width)
            for cell, width, column in zip(line, widths, columns, strict=False)
        ).rstrip()
        for line in every
    )
