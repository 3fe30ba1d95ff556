"""Pressures as a sensor recorded them, as a gait: `--gait pressures.csv`.

A table with a column of time and one a segment, left first, whose heads name their units: `time
[s], front [kPa]`, `t_ms, p1_psi`. Samples may come at any rate and need not be even, close a cycle
or start at rest. They become straight ramps between few corners, as many as the noise leaves
visible, so that what is computed from them grows with what changes and not with the samples.
"""

import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

from analytic.gait import Gait
from mjsim.io.units import in_unit

Array = NDArray[np.float64]

_UNIT = re.compile(r"^(.*?)\s*(?:[\[(]\s*(.+?)\s*[\])]|_([A-Za-z]+))\s*$")
_PRESSURES = "Pa, kPa, psi, bar"
_NOISES = 1.5  # that a corner must stand out by, of the largest of so many samples; chosen
_FEW = 16  # samples that tell nothing of their noise; chosen
_LEAST = 0.005  # of the highest pressure: what is flatter is flat; chosen
_SAME = 1e-9  # of the highest pressure


class Series(NamedTuple):
    """Pressures along time.

    Attributes:
        time: from 0 on, increasing, (T,) [s].
        pressure: of the segments, left first, (T, S) [Pa].
    """

    time: Array
    pressure: Array


def read_series(path: Path) -> Series:
    """The series of a file.

    Raises:
        ValueError: the file cannot be read or is no such table; the message names line and column.
    """
    where = f"pressures {str(path)!r}"
    lines = _lines(path, where)
    head, rows = lines[0][1], lines[1:]
    if len(head) < 2:
        raise ValueError(f"{where}: needs a column of time and one a segment, got {head}")
    factors = [_factor(where, text, column) for column, text in enumerate(head)]
    if len(rows) < 2:
        raise ValueError(f"{where}: needs two samples at least, got {len(rows)}")
    values = np.array([_numbers(where, number, row, head) for number, row in rows]) * factors
    time = values[:, 0] - values[0, 0]
    late = np.flatnonzero(np.diff(time) <= 0)
    if len(late):
        number, row = rows[late[0] + 1]
        raise ValueError(f"{where}: line {number}: time must increase, got {row[0]!r}")
    return Series(time, values[:, 1:])


def read_gait(path: Path) -> tuple[Gait, float]:
    """The gait of a file, which does not repeat, and its highest pressure [Pa].

    Raises:
        ValueError: see read_series; or no pressure is above the noise.
    """
    series = read_series(path)
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
    kept = _corners(time, pressure, tolerance)
    fitted = _through(time, pressure, kept)
    fitted[np.abs(fitted) < tolerance] = 0.0
    highest = float(np.abs(fitted).max())
    if not highest > 0:
        raise ValueError("no pressure is above the noise")
    fractions = np.where(np.abs(fitted) > (1 - _SAME) * highest, np.sign(fitted), fitted / highest)
    ramps = tuple(np.diff(time[kept]).tolist())
    return Gait(name, tuple(map(tuple, fractions.tolist())), ramps, repeats=False), highest


def _tolerance(pressure: Array) -> float:
    """What a corner must stand out by: several times the noise, of which second differences tell.

    A line has none, and white noise of deviation s has differences of deviation sqrt(6) s; the
    largest of n samples is expected at sqrt(2 log n) deviations.
    """
    noise = 0.0
    if len(pressure) > _FEW:
        bends = np.abs(np.diff(pressure, 2, axis=0))
        noise = float(np.median(bends, axis=0).max()) / 0.6745 / math.sqrt(6)
        noise *= math.sqrt(2 * math.log(pressure.size))
    return max(_NOISES * noise, _LEAST * float(np.abs(pressure).max()))


def _corners(time: Array, pressure: Array, tolerance: float) -> NDArray[np.int_]:
    """Samples between which straight lines stay within the tolerance (Douglas and Peucker 1973)."""
    kept, open_ = {0, len(time) - 1}, [(0, len(time) - 1)]
    while open_:
        first, last = open_.pop()
        if last - first < 2:
            continue
        inside = slice(first + 1, last)
        part = ((time[inside] - time[first]) / (time[last] - time[first]))[:, None]
        chord = pressure[first] + part * (pressure[last] - pressure[first])
        away = np.abs(pressure[inside] - chord).max(axis=1)
        farthest = int(away.argmax())
        if away[farthest] > tolerance:
            middle = first + 1 + farthest
            kept.add(middle)
            open_ += [(first, middle), (middle, last)]
    return np.array(sorted(kept))


def _through(time: Array, pressure: Array, kept: NDArray[np.int_]) -> Array:
    """Pressures at the corners by least squares of all samples, so that none carries its noise."""
    count = len(kept)
    index = np.clip(np.searchsorted(kept, np.arange(len(time)), side="right") - 1, 0, count - 2)
    part = (time - time[kept[index]]) / (time[kept[index + 1]] - time[kept[index]])
    left, right = 1 - part, part
    normal = np.zeros((2, count))  # diagonal, and the one below it
    normal[0] = np.bincount(index, left**2, count) + np.bincount(index + 1, right**2, count)
    normal[1] = np.bincount(index, left * right, count)
    sums = np.stack(
        [np.bincount(index, left * p, count) + np.bincount(index + 1, right * p, count)
         for p in pressure.T], axis=1,
    )  # fmt: skip
    return np.asarray(solveh_banded(normal, sums, lower=True))


def _lines(path: Path, where: str) -> list[tuple[int, list[str]]]:
    """Numbers and cells of the lines that are neither empty nor comments."""
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
    return [
        (number, [cell.strip().replace(",", ".") if decimal else cell.strip() for cell in row])
        for (number, _), row in zip(lines, cells, strict=True)
    ]


def _factor(where: str, text: str, column: int) -> float:
    """What a column's numbers are to be multiplied with."""
    found = _UNIT.match(text)
    unit = found and (found.group(2) or found.group(3))
    wanted = "Pa" if column else "s"
    known = f"such as {_PRESSURES}" if column else "such as s or ms"
    if unit is None:
        raise ValueError(f"{where}: column {text!r} must name its unit, {known}, in brackets")
    try:
        return in_unit(text, f"1 {unit}", wanted)
    except ValueError:
        raise ValueError(f"{where}: column {text!r} must have a unit {known}") from None


def _numbers(where: str, number: int, row: list[str], head: list[str]) -> list[float]:
    if len(row) != len(head):
        raise ValueError(f"{where}: line {number}: needs {len(head)} numbers, got {len(row)}")
    values = []
    for text, name in zip(row, head, strict=True):
        try:
            values.append(float(text))
        except ValueError:
            values.append(math.nan)
        if not math.isfinite(values[-1]):
            raise ValueError(f"{where}: line {number}: {name} must be a number, got {text!r}")
    return values
