"""Gait from the pressures that a sensor recorded: `--gait pressures.csv`.

The table has a column of time and one per segment, left first, whose heads name their units: `time
[s], p1 [kPa]`, `t_ms, p1_psi`. Heads that name a robot's chambers may be in any order. Samples may
come at any rate and need not be even, close a cycle or start at rest. They become straight ramps
between few corners, as many as the noise leaves visible, so that the cost of a walk grows with the
number of changes and not of samples.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

from analytic.scene.gait import Gait
from mjsim.files.csv_table import name_of, read_csv

Array = NDArray[np.float64]

_NOISES = 1.5  # by which a corner must stand out, of the largest of so many samples; chosen
_FEW = 16  # samples, too few to estimate their noise; chosen
_LEAST = 0.005  # of the highest pressure, below which a change is none; chosen
_SAME = 1e-9  # of the highest pressure


class Series(NamedTuple):
    """Pressures along time.

    Attributes:
        time: from 0 on, increasing, (T,) [s].
        pressure: of the segments, left first, (T, S) [Pa].
    """

    time: Array
    pressure: Array


def read_series(path: Path, chambers: Sequence[str] = ()) -> Series:
    """Read the series of a file.

    Args:
        path: of the CSV.
        chambers: names of a robot's chambers; columns with these names may be in any order.

    Raises:
        ValueError: the file cannot be read or is no such table, or some of its heads name chambers
            and others do not; the message names line and column.
    """
    table = read_csv(path, "pressures")
    where, heads, rows = table
    if len(heads) < 2:
        raise ValueError(f"{where}: needs a column of time and one per segment, got {heads}")
    if len(rows) < 2:
        raise ValueError(f"{where}: needs two samples at least, got {len(rows)}")
    time = table.numbers(0, "s", "s or ms")
    late = np.flatnonzero(np.diff(time) <= 0)
    if len(late):
        line, row = rows[late[0] + 1]
        raise ValueError(f"{where}: line {line}: time must increase, got {row[0]!r}")
    pressures = [
        table.numbers(i, "Pa", "Pa, kPa, psi, bar") for i in _columns(where, heads, chambers)
    ]
    return Series(time - time[0], np.stack(pressures, axis=1))


def _columns(where: str, heads: Sequence[str], chambers: Sequence[str]) -> list[int]:
    """Columns of the pressures, in the order of the chambers that they name."""
    names = [name_of(head) for head in heads[1:]]
    if not set(names) & set(chambers):
        return list(range(1, len(heads)))
    if sorted(names) != sorted(chambers):
        raise ValueError(f"{where}: columns must be {', '.join(chambers)}; got {', '.join(names)}")
    return [1 + names.index(name) for name in chambers]


def read_gait(path: Path, chambers: Sequence[str] = ()) -> tuple[Gait, float]:
    """The gait of a file, which does not repeat, and its highest pressure [Pa].

    Args:
        path, chambers: see read_series.

    Raises:
        ValueError: see read_series; or no pressure is above the noise.
    """
    series = read_series(path, chambers)
    try:
        return as_gait(path.stem, series)
    except ValueError as error:
        raise ValueError(f"pressures {str(path)!r}: {error}") from error


def as_gait(name: str, series: Series) -> tuple[Gait, float]:
    """The gait of a series, which does not repeat, and its highest pressure [Pa].

    Raises:
        ValueError: no pressure is above the noise.
    """
    time, pressure = series
    tolerance = _tolerance(pressure)
    corners = _corners(time, pressure, tolerance)
    fitted = _through(time, pressure, corners)
    fitted[np.abs(fitted) < tolerance] = 0.0
    highest = float(np.abs(fitted).max())
    if not highest > 0:
        raise ValueError("no pressure is above the noise")
    fractions = np.where(np.abs(fitted) > (1 - _SAME) * highest, np.sign(fitted), fitted / highest)
    ramps = tuple(np.diff(time[corners]).tolist())
    return Gait(name, tuple(map(tuple, fractions.tolist())), ramps, repeats=False), highest


def _tolerance(pressure: Array) -> float:
    """Distance by which a corner must stand out: several times the noise [Pa].

    The noise is that of second differences: a line has none, and white noise of deviation s has
    differences of deviation sqrt(6) s; the largest of n samples is expected at sqrt(2 log n)
    deviations.
    """
    noise = 0.0
    if len(pressure) > _FEW:
        bends = np.abs(np.diff(pressure, 2, axis=0))
        noise = float(np.median(bends, axis=0).max()) / 0.6745 / math.sqrt(6)
        noise *= math.sqrt(2 * math.log(pressure.size))
    return max(_NOISES * noise, _LEAST * float(np.abs(pressure).max()))


def _corners(time: Array, pressure: Array, tolerance: float) -> NDArray[np.int_]:
    """Samples between which straight lines stay within the tolerance (Douglas and Peucker 1973)."""
    corners, spans = {0, len(time) - 1}, [(0, len(time) - 1)]
    while spans:
        begin, end = spans.pop()
        if end - begin < 2:
            continue
        inside = slice(begin + 1, end)
        part = ((time[inside] - time[begin]) / (time[end] - time[begin]))[:, None]
        chord = pressure[begin] + part * (pressure[end] - pressure[begin])
        distance = np.abs(pressure[inside] - chord).max(axis=1)
        farthest = int(distance.argmax())
        if distance[farthest] > tolerance:
            middle = begin + 1 + farthest
            corners.add(middle)
            spans += [(begin, middle), (middle, end)]
    return np.array(sorted(corners))


def _through(time: Array, pressure: Array, corners: NDArray[np.int_]) -> Array:
    """Pressures at the corners by least squares of all samples, so that none carries its noise."""
    count = len(corners)
    index = np.clip(np.searchsorted(corners, np.arange(len(time)), side="right") - 1, 0, count - 2)
    part = (time - time[corners[index]]) / (time[corners[index + 1]] - time[corners[index]])
    left, right = 1 - part, part
    normal = np.zeros((2, count))  # diagonal, and the one below it
    normal[0] = np.bincount(index, left**2, count) + np.bincount(index + 1, right**2, count)
    normal[1] = np.bincount(index, left * right, count)
    sums = np.stack(
        [np.bincount(index, left * p, count) + np.bincount(index + 1, right * p, count)
         for p in pressure.T], axis=1,
    )  # fmt: skip
    return np.asarray(solveh_banded(normal, sums, lower=True))
