"""Results of a sweep as CSV, netCDF or Parquet."""

import csv
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

from mjsim.files.extras import optional
from mjsim.files.files import whole

_MANY = 10_000  # rows at a time


def export(results: Path, out: Path) -> None:
    """Write a sweep's rows to a file, by its ending: .csv, .nc or .parquet.

    Raises:
        ModuleNotFoundError: what writes it is not installed.
        ValueError: the ending is none of these.
    """
    check_ending(out)
    with closing(sqlite3.connect(results)) as base, whole(out) as part:
        _WRITERS[out.suffix](base, part)


def check_ending(out: Path) -> None:
    """Raise ValueError for a file of another kind, ModuleNotFoundError for want of its writer."""
    if out.suffix not in _WRITERS:
        raise ValueError(f"export must end in {', '.join(_WRITERS)}, got {str(out)!r}")
    if out.suffix == ".parquet":
        optional("pyarrow", "parquet")


def described(base: sqlite3.Connection) -> dict[str, tuple[str, str]]:
    """Unit and meaning of each column, empty of the scenes' number."""
    rows = base.execute("select name, unit, long_name from columns")
    return {"id": ("", "")} | {name: (unit, text) for name, unit, text in rows}


def with_unit(name: str, unit: str) -> str:
    """Head or label of a column: its name, and its unit in brackets if that is not in the name."""
    named = name.endswith("_" + unit.replace("/", "_per_"))
    return name if unit in ("", "1") or named else f"{name} [{unit}]"


def _csv(base: sqlite3.Connection, path: Path) -> None:
    units = described(base)
    rows = base.execute("select * from scenes order by id")
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        heads = [name for name, *_ in rows.description]
        writer.writerow([with_unit(name, units[name][0]) for name in heads])
        writer.writerows(rows)


def _netcdf(base: sqlite3.Connection, path: Path) -> None:
    import numpy as np

    from mjsim.results.netcdf import Variable, packed

    def column(name: str) -> list[Any]:
        return [value for (value,) in base.execute(f'select "{name}" from scenes order by id')]

    units = described(base)
    number = np.array(column("id"), dtype=int)
    rows = [Variable("scene", ("scene",), number, "", "number in the plan")]
    for _, name, kind, *_ in base.execute("pragma table_info(scenes)").fetchall()[1:]:
        if kind == "REAL":
            values: Any = np.array(column(name), dtype=float)  # None becomes NaN
        else:
            values = np.array(["" if v is None else str(v) for v in column(name)], dtype=object)
        unit, text = units[name]
        rows.append(Variable(name, ("scene",), values, unit, text))
    notes = base.execute("select key, value from plan where value is not null")
    path.write_bytes(packed(rows, {key: str(value) for key, value in notes}))


def _parquet(base: sqlite3.Connection, path: Path) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    units = described(base)
    types = {"REAL": pa.float64(), "INTEGER": pa.int64()}
    fields = [
        pa.field(name, types.get(kind.upper(), pa.string()),
                 metadata=dict(zip(("unit", "long_name"), units[name], strict=True)))
        for _, name, kind, *_ in base.execute("pragma table_info(scenes)")
    ]  # fmt: skip
    schema = pa.schema(fields)
    rows = base.execute("select * from scenes order by id")
    with pq.ParquetWriter(path, schema) as writer:
        while chunk := rows.fetchmany(_MANY):
            pairs = zip(zip(*chunk, strict=True), fields, strict=True)
            columns = [pa.array(column, type=field.type) for column, field in pairs]
            writer.write_table(pa.Table.from_arrays(columns, schema=schema))


_WRITERS: dict[str, Callable[[sqlite3.Connection, Path], None]] = {
    ".csv": _csv, ".nc": _netcdf, ".parquet": _parquet,
}  # fmt: skip
