"""Effects of the fields of a sweep, alone and in pairs, on one column of its results.

The part of the variance that a field explains alone is that of the means over its levels (its
first-order Sobol index, Saltelli and others 2008), less the part that so many levels explain by
chance: epsilon squared (Kelley 1935). Of a pair it is the same over cells, less the parts of both
fields alone.
"""

import sqlite3
from collections.abc import Mapping
from contextlib import closing
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.checks import missing
from mjsim.sweeps.export import described
from mjsim.sweeps.rows import OUTPUTS

Array = NDArray[np.float64]

_LEVELS = 12  # distinct values that are levels; more are put into bins of equal counts
_IN_CELL = 8  # scenes that a cell of a pair should have
_LEAST = 3  # bins of a pair
_NUMBERS = tuple(name for name, (kind, _, _) in OUTPUTS.items() if kind == "REAL")


class Field(NamedTuple):
    """Field in which scenes differ.

    Attributes:
        name, unit: of the field.
        values: of the scenes, numbers, or the place of a word in `words`, (N,).
        words: of a field without numbers, else empty.
    """

    name: str
    unit: str
    values: Array
    words: tuple[str, ...]


class Levels(NamedTuple):
    """Scenes by one field.

    Attributes:
        of: level of each scene, (N,).
        centre: mean of the field in each level, (L,).
    """

    of: NDArray[np.int_]
    centre: Array


class Map(NamedTuple):
    """Means over the cells of two fields.

    Attributes:
        one, two: the fields.
        x, y: centres of the cells, (X,) and (Y,).
        mean: over each cell, NaN where there is no scene, (Y, X).
        part: of the variance that both explain together and neither alone.
    """

    one: Field
    two: Field
    x: Array
    y: Array
    mean: Array
    part: float


@dataclass(frozen=True)
class Results:
    """Scenes of a sweep that have a number.

    Attributes:
        fields: in which they differ, the one that explains most first.
        quantity, unit: of the column.
        values: of the quantity, (N,).
        parts: of the variance that each field explains alone.
        status: number of scenes by status, those without a number too.
    """

    fields: list[Field]
    quantity: str
    unit: str
    values: Array
    parts: list[float]
    status: Mapping[str, int]


def load(path: Path, quantity: str) -> Results:
    """Read the results of a file.

    Raises:
        ValueError: it is no file of a sweep, has no such column, or nothing in it differs.
    """
    try:
        path.open("rb").close()
    except OSError as error:
        raise ValueError(
            f"results must be a file of undulator sweep, got {str(path)!r}: {missing(path, error)}"
        ) from error
    if quantity not in _NUMBERS:
        raise ValueError(f"quantity must be one of {', '.join(_NUMBERS)}; got {quantity!r}")
    try:
        with closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as base:
            units = described(base)
            inputs = [n for (n,) in base.execute("select name from columns where role = 'input'")]
            names = ", ".join(f'"{name}"' for name in [*inputs, quantity])
            numbers = base.execute(f"select {names} from scenes where {quantity} is not null")
            rows = numbers.fetchall()
            status = dict(
                base.execute("select status, count(*) from scenes group by 1 order by 2 desc")
            )
    except sqlite3.DatabaseError as error:
        raise ValueError(
            f"results {str(path)!r} are no file of undulator sweep: {error}"
        ) from error
    if len(rows) < 2:
        raise ValueError(f"results {str(path)!r} have {len(rows)} scenes with a {quantity}")
    *columns, outputs = zip(*rows, strict=True)
    fields = [
        _field(name, units[name][0], column)
        for name, column in zip(inputs, columns, strict=True)
        if len(set(column)) > 1
    ]
    values = np.array(outputs, dtype=float)
    if not fields:
        raise ValueError(f"results {str(path)!r} differ in no field")
    parts = {field.name: explained(values, levels(field.values).of) for field in fields}
    fields.sort(key=lambda field: -parts[field.name])
    return Results(fields, quantity, units[quantity][0], values, [parts[f.name] for f in fields],
                   status)  # fmt: skip


def _field(name: str, unit: str, column: tuple[Any, ...]) -> Field:
    if all(isinstance(value, int | float) for value in column):
        return Field(name, unit, np.array(column, dtype=float), ())
    words = tuple(sorted({str(value) for value in column}))
    places = np.array([words.index(str(value)) for value in column], dtype=float)
    return Field(name, unit, places, words)


def levels(values: Array, most: int = _LEVELS) -> Levels:
    """Levels of values: each value one if they are few, else bins of equal counts."""
    distinct, of = np.unique(values, return_inverse=True)
    if len(distinct) <= most:
        return Levels(of, distinct)
    edges = np.quantile(values, np.linspace(0, 1, most + 1)[1:-1])
    of = np.searchsorted(edges, values, side="right")
    centre = np.array([values[of == level].mean() for level in range(most)])
    return Levels(of, centre)


def explained(values: Array, groups: NDArray[np.int_]) -> float:
    """Part of the variance of values that is between groups, corrected for chance, 0 to 1."""
    _, of, counts = np.unique(groups, return_inverse=True, return_counts=True)
    total = float(((values - values.mean()) ** 2).sum())
    if total == 0 or len(counts) == len(values):
        return 0.0
    means = np.bincount(of, values) / counts
    within = float(((values - means[of]) ** 2).sum())
    chance = (len(values) - 1) / (len(values) - len(counts))
    return max(0.0, 1.0 - chance * within / total)


def pairs(results: Results, fields: int = 4) -> list[Map]:
    """Maps of each two of the fields that explain most, the largest joint effect first."""
    most = max(_LEAST, min(_LEVELS, int((len(results.values) / _IN_CELL) ** 0.5)))
    maps = []
    for one, two in combinations(results.fields[:fields], 2):
        a, b = levels(one.values, most), levels(two.values, most)
        cell = b.of * len(a.centre) + a.of
        cells = len(a.centre) * len(b.centre)
        counts = np.bincount(cell, minlength=cells)
        sums = np.bincount(cell, results.values, cells)
        mean = np.where(counts > 0, sums / np.maximum(counts, 1), np.nan)
        alone = explained(results.values, a.of) + explained(results.values, b.of)
        part = max(0.0, explained(results.values, cell) - alone)
        shape = len(b.centre), len(a.centre)
        maps.append(Map(one, two, a.centre, b.centre, mean.reshape(shape), part))
    return sorted(maps, key=lambda pair: -pair.part)
