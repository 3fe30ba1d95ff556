"""Results of a sweep as CSV, netCDF or Parquet."""

import csv
import sqlite3
from collections.abc import Callable
from pathlib import Path
from typing import Any

from mjsim.files.files import whole

_MANY = 10_000  # rows at a time


def export(results: Path, out: Path) -> None:
    """Write a sweep's rows to a file, by its ending: .csv, .nc or .parquet.

    Raises:
        ValueError: the ending is none of these, or what writes it is not installed.
    """
    check_ending(out)
    base = sqlite3.connect(results)
    try:
        with whole(out) as part:
            _WRITERS[out.suffix](base, part)
    finally:
        base.close()


def check_ending(out: Path) -> None:
    """Raise ValueError for a file of another kind, or one that nothing here can write."""
    if out.suffix not in _WRITERS:
        raise ValueError(f"export must end in {', '.join(_WRITERS)}, got {str(out)!r}")
    if out.suffix == ".parquet":
        try:
            import pyarrow  # noqa: F401
        except ImportError as error:
            raise ValueError("parquet needs pyarrow: pip install 'undulator[parquet]'") from error


def described(base: sqlite3.Connection) -> dict[str, tuple[str, str]]:
    """Unit and meaning of each column."""
    rows = base.execute("select name, unit, long_name from columns")
    return {name: (unit, text) for name, unit, text in rows}


def _csv(base: sqlite3.Connection, path: Path) -> None:
    units = described(base)
    rows = base.execute("select * from scenes order by id")
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        heads = [name for name, *_ in rows.description]
        writer.writerow([_head(name, units.get(name, ("", ""))[0]) for name in heads])
        writer.writerows(rows)


def _head(name: str, unit: str) -> str:
    return name if unit in ("", "1") else f"{name} [{unit}]"


def _netcdf(base: sqlite3.Connection, path: Path) -> None:
    import numpy as np
    import xarray as xr

    units = described(base)
    kinds = {name: kind for _, name, kind, *_ in base.execute("pragma table_info(scenes)")}
    columns = {}
    for name, kind in kinds.items():
        if name == "id":
            continue
        found = [v for (v,) in base.execute(f'select "{name}" from scenes order by id')]
        if kind == "REAL":
            values: Any = np.array([np.nan if v is None else v for v in found], dtype=float)
        else:
            values = np.array(["" if v is None else str(v) for v in found], dtype=object)
        unit, text = units.get(name, ("", ""))
        attributes = {"long_name": text} | ({"units": unit} if unit else {})
        columns[name] = ("scene", values, attributes)
    numbers = [v for (v,) in base.execute("select id from scenes order by id")]
    plan = dict(base.execute("select key, value from plan"))
    attributes = {key: str(value) for key, value in plan.items() if value is not None}
    data = xr.Dataset(columns, coords={"scene": numbers}, attrs=attributes)
    data.to_netcdf(path, engine="h5netcdf")


def _parquet(base: sqlite3.Connection, path: Path) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    units = described(base)
    types = {"REAL": pa.float64(), "INTEGER": pa.int64()}
    fields = [
        pa.field(name, types.get(kind.upper(), pa.string()),
                 metadata={"unit": units.get(name, ("", ""))[0],
                           "long_name": units.get(name, ("", ""))[1]})
        for _, name, kind, *_ in base.execute("pragma table_info(scenes)")
    ]  # fmt: skip
    schema = pa.schema(fields)
    rows = base.execute("select * from scenes order by id")
    with pq.ParquetWriter(path, schema) as writer:
        while some := rows.fetchmany(_MANY):
            pairs = zip(zip(*some, strict=True), fields, strict=True)
            columns = [pa.array(column, type=field.type) for column, field in pairs]
            writer.write_table(pa.Table.from_arrays(columns, schema=schema))


_WRITERS: dict[str, Callable[[sqlite3.Connection, Path], None]] = {
    ".csv": _csv, ".nc": _netcdf, ".parquet": _parquet,
}  # fmt: skip
