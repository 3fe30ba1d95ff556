"""Results of a sweep in one SQLite file: a row per scene, with units and provenance.

    pandas.read_sql("select * from scenes", sqlite3.connect("results.sqlite"))

Tables: `scenes`, a row per scene, numbers in the units of `columns`; `plan`, the sweep's settings;
`sessions`, machines and times of work; `confirmations`, walks of some scenes again, finer. One
driver writes, whole chunks in one transaction each, so that a crash leaves whole rows behind.
"""

import json
import sqlite3
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import IO, Any

from mjsim.files.scene_tables.quantities import field_text, field_unit
from mjsim.results.provenance import machine, origin
from mjsim.sweeps.plan import Plan
from mjsim.sweeps.rows import OUTPUTS, Row

KIND = "undulator sweep 2"  # of file; the number is that of its layout
_UNUSED = 2**30 + 512  # a byte that SQLite never reads: in its page of locks, behind its own
_FREE = ("python", "commit", "dm_control")  # versions that may differ between sessions of one sweep


class Store:
    """File of a sweep, open for its one writer.

    Args:
        path: of the file; made if there is none.
        plan: of the sweep.

    Raises:
        ValueError: the file is of another plan, another version, no such file, in use, or cannot
            be written.
    """

    def __init__(self, path: Path, plan: Plan) -> None:
        self.path, self._inputs = path, plan.fields
        self._columns = [*plan.fields, *OUTPUTS]
        try:
            self._lock = path.open("ab")
        except OSError as error:
            raise ValueError(f"out {str(path)!r} cannot be written: {error.strerror}") from error
        try:
            _lock(self._lock)
        except OSError as error:
            self._lock.close()
            raise ValueError(f"out {str(path)!r} is being written by another sweep") from error
        self._base = sqlite3.connect(path, isolation_level=None)  # see _transaction
        try:
            self._open(plan)
        except (sqlite3.DatabaseError, ValueError) as error:
            self.close()
            raise ValueError(f"out {str(path)!r} {_why(error)}") from error

    def _open(self, plan: Plan) -> None:
        tables = {name for (name,) in self._base.execute("select name from sqlite_master")}
        if tables:
            if "plan" not in tables:
                raise ValueError("is no file of a sweep")
            notes = dict(self._base.execute("select key, value from plan"))
            if notes.get("kind") != KIND:
                raise ValueError("is no file of a sweep")
            if notes["digest"] != plan.digest:
                raise ValueError(
                    f"has another plan, {notes['digest']}: give another file for {plan.digest}"
                )
            stored = json.loads(notes["versions"])
            for name, version in _versions(origin()).items():
                if version != stored.get(name):
                    raise ValueError(
                        f"was made with {name} {stored.get(name)}, here is {version}: give another "
                        "file"
                    )
        with self._transaction():
            if not tables:
                self._create(plan)
            now = datetime.now(UTC).isoformat(timespec="seconds")
            where = json.dumps(origin())
            self._base.execute("insert into sessions values (?, ?, ?)", (now, where, machine()))

    def _create(self, plan: Plan) -> None:
        kinds = {name: _kind(plan, name) for name in plan.fields}
        kinds |= {name: kind for name, (kind, _, _) in OUTPUTS.items()}
        typed = ", ".join(f'"{name}" {kind}' for name, kind in kinds.items())
        run = self._base.execute
        run(f"create table scenes (id integer primary key, {typed})")
        run("create table confirmations (id integer primary key, status, displacement_over_L)")
        run("create table plan (key text primary key, value text)")
        run("create table columns (name text primary key, role, unit, long_name)")
        run("create table sessions (began, origin, machine)")
        notes = {
            "kind": KIND, "digest": plan.digest, "model": plan.model, "scenes": len(plan),
            "base": json.dumps(plan.base, default=str), "tolerance": plan.tolerance,
            "versions": json.dumps(_versions(origin())),
        }  # fmt: skip
        self._base.executemany("insert into plan values (?, ?)", notes.items())
        columns = [(n, "input", field_unit(n), field_text(n)) for n in plan.fields]
        columns += [(n, "output", unit, text) for n, (_, unit, text) in OUTPUTS.items()]
        self._base.executemany("insert into columns values (?, ?, ?, ?)", columns)

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        """Write all of a block or nothing, tables too, whatever ends it.

        Raises:
            OSError: the file cannot be written.
        """
        try:
            with self._base:
                self._base.execute("begin immediate")
                yield
        except sqlite3.OperationalError as error:
            raise OSError(f"out {str(self.path)!r} cannot be written: {error}") from error

    def note(self, key: str, value: str | None = None) -> str | None:
        """Value of a key of the table `plan`, written first if it is given."""
        if value is not None:
            with self._transaction():
                self._base.execute("insert or replace into plan values (?, ?)", (key, value))
        row = self._base.execute("select value from plan where key = ?", (key,)).fetchone()
        return row and row[0]

    def missing(self, numbers: range, table: str = "scenes") -> list[int]:
        """Numbers of scenes that have no row yet."""
        stored = self._base.execute(
            f"select id from {table} where id between ? and ?", (numbers[0], numbers[-1])
        )
        return sorted(set(numbers) - {number for (number,) in stored})

    def add(self, rows: Iterable[Row], points: Mapping[int, Mapping[str, Any]]) -> None:
        """Write rows of scenes and their fields, all or none of them."""
        names = ", ".join(f'"{name}"' for name in self._columns)
        marks = ", ".join("?" * (1 + len(self._columns)))
        values = [
            [row["id"], *(_plain({**row, **points[row["id"]]}.get(name)) for name in self._columns)]
            for row in rows
        ]
        with self._transaction():
            self._base.executemany(f"insert into scenes (id, {names}) values ({marks})", values)

    def confirm(self, rows: Iterable[Row]) -> None:
        """Write rows of scenes that were walked again, finer."""
        values = [(row["id"], row["status"], row.get("displacement_over_L")) for row in rows]
        with self._transaction():
            self._base.executemany("insert into confirmations values (?, ?, ?)", values)

    def select(self, query: str, values: Sequence[Any] = ()) -> list[tuple[Any, ...]]:
        """Rows of a query in SQL."""
        return self._base.execute(query, values).fetchall()

    def close(self) -> None:
        """Close the file; another sweep may write it then."""
        self._base.close()
        self._lock.close()

    def __enter__(self) -> "Store":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()


def _lock(file: IO[bytes]) -> None:
    """Lock a file against other sweeps, until it is closed or this process ends, by kill too.

    Raises:
        OSError: another sweep has it.
    """
    if sys.platform == "win32":  # where no other process can read locked bytes
        import msvcrt

        file.seek(_UNUSED)
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
    else:
        import fcntl

        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _kind(plan: Plan, name: str) -> str:
    value = plan.point(0)[name]
    return "REAL" if isinstance(value, int | float) and not isinstance(value, bool) else "TEXT"


def _plain(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, list | tuple | dict) else value


def _versions(source: Mapping[str, Any]) -> dict[str, str]:
    return {key: value for key, value in source["versions"].items() if key not in _FREE}


def _why(error: Exception) -> str:
    return str(error) if isinstance(error, ValueError) else f"cannot be used: {error}"
