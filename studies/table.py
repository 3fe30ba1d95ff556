"""Tables of measurements, kept as CSV that grows: a run that was stopped goes on where it was.

The arguments of the function that measures are the first columns, and its results the next ones.
"""

import logging
import os
import typing
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import pandas as pd  # type: ignore[import-untyped]

from mjsim.files.command_line.cli import bar
from mjsim.files.processes import clean_start
from mjsim.results.provenance import signature

DOCS = Path(__file__).resolve().parents[1] / "docs"


def columns(measure: Callable[..., Any]) -> dict[str, type]:
    """Names and types of the arguments of a function."""
    return {name: kind for name, kind in typing.get_type_hints(measure).items() if name != "return"}


def read(path: Path, measure: Callable[..., Any]) -> pd.DataFrame:
    """Rows of a file; none if it is not there.

    Raises:
        ValueError: the file lacks a column for an argument of the function that measures.
    """
    types = columns(measure)
    if not path.is_file():
        return pd.DataFrame(columns=list(types))
    table = pd.read_csv(path, dtype={**types, "versions": str, "commit": str}, na_values=["nan"],
                        keep_default_na=False)  # fmt: skip
    if not set(types) <= set(table):
        raise ValueError(f"{path} is no table of rows: its columns are {list(table)}")
    return table


def append(row: Mapping[str, Any], path: Path) -> None:
    """Write a row to the end of a file, below the names of the columns if it is the first."""
    path.parent.mkdir(parents=True, exist_ok=True)
    pd.DataFrame([row]).to_csv(path, mode="a", header=not path.is_file(), index=False,
                               float_format="%.6g", na_rep="nan")  # fmt: skip


def complete(
    path: Path,
    measure: Callable[..., Mapping[str, Any]],
    grid: Iterable[tuple[Any, ...]],
    processes: int | None = None,
) -> pd.DataFrame:
    """Rows of a file, to which those of a grid are appended that it lacks.

    Args:
        path: of the file.
        measure: the function, of a module; returns the columns that it measures.
        grid: its arguments.
        processes: that share the work; one per core by default.
    """
    names = list(columns(measure))
    present = set(read(path, measure)[names].itertuples(index=False, name=None))
    missing = [setting for setting in dict.fromkeys(grid) if setting not in present]
    with pool(processes) as workers, bar(path.stem, len(missing)) as advance:
        results = workers.map(measure, *zip(*missing, strict=True))
        for setting, result in zip(missing, results, strict=True):
            append({**dict(zip(names, setting, strict=True)), **result, **signature()}, path)
            advance(1)
    return read(path, measure)


def pool(processes: int | None = None) -> ProcessPoolExecutor:
    """Worker processes, one per core by default, in which divergence is no warning but a result."""
    return ProcessPoolExecutor(processes or os.cpu_count(), mp_context=clean_start(),
                               initializer=_quiet)  # fmt: skip


def _quiet() -> None:
    logging.getLogger("absl").setLevel(logging.ERROR)
