"""Gait from the pressures that a sensor recorded: `--gait pressures.csv`.

The table has a column of time and one per chamber, whose heads name their units: `time [s], p1
[kPa]`, `t_ms, p1_psig`; see mjsim.files.gaits.log_columns for how chambers are told. Samples may
come at any rate and need not be even, close a cycle or start at rest. They become straight ramps
between few corners, as many as the noise leaves visible, so that the cost of a walk grows with the
number of changes and not of samples.

Notes on what was left out, merged or assumed go to the logger "mjsim".
"""

import logging
import math
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.gait import Gait
from mjsim.files.csv_table import CsvTable, read_csv
from mjsim.files.gaits.corners import ramps
from mjsim.files.gaits.log_columns import find_columns
from mjsim.files.gaits.mergers import SHORTEST

Array = NDArray[np.float64]

LOG = logging.getLogger("mjsim")
ATMOSPHERE = 101325.0  # Pa; ISO 2533
_AMBIENT = (8e4, 1.1e5)  # Pa; of all weathers from the sea up to 1,900 m, ISO 2533
_ALIKE = 3e3  # Pa between the chambers' lowest pressures, if these are the ambient one; chosen
_SAME = 1e-9  # of the highest pressure
_OPEN = 0.05  # of the highest pressure by which the ends of a cycle may differ; chosen
_PERIODIC = 0.05  # of the spread of pressures by which cycles may differ to be alike; chosen
_GRID = 2000  # times at which cycles are compared
_SHORT = 0.02  # of a cycle that may lack at the end of a log, such as its last sample; chosen


class Series(NamedTuple):
    """Pressures along time.

    Attributes:
        time: from 0 on, not decreasing, (T,) [s].
        pressure: of the segments, left first, (T, S) [Pa].
    """

    time: Array
    pressure: Array


def read_series(path: Path, chambers: Sequence[str] = (), columns: Sequence[str] = ()) -> Series:
    """Read the series of a file.

    Args:
        path: of the CSV.
        chambers: names of a robot's chambers; columns with these names may be in any order.
        columns: names of the columns to read, see mjsim.files.gaits.log_columns.find_columns.

    Raises:
        ValueError: the file cannot be read or is no such table, or some of its heads name chambers
            and others do not; the message names line and column.
    """
    table = read_csv(path, "pressures")
    picked = find_columns(table, chambers, columns)
    where, rows = table.where, table.rows
    if len(rows) < 2:
        raise ValueError(f"{where}: needs two samples at least, got {len(rows)}")
    heads = [f"{h.name} [{h.unit}]" if h.unit else o for h, o in zip(picked.heads, table.heads,
                                                                     strict=True)]  # fmt: skip
    table = table._replace(heads=heads)
    time = _times(table, picked.time)
    late = np.flatnonzero(np.diff(time) < 0)
    if len(late):
        line, row = rows[late[0] + 1]
        raise ValueError(f"{where}: line {line}: time must not go back, got {row[picked.time]!r}")
    if time[-1] == time[0]:
        line, row = rows[-1]
        raise ValueError(f"{where}: line {line}: time must increase, got {row[picked.time]!r}")
    pressure = np.stack(
        [table.numbers(i, "Pa", "Pa, kPa, psi, bar") for i in picked.chambers], axis=1
    )
    for note in picked.notes:
        LOG.warning("%s: %s", where, note)
    return Series(time - time[0], _gauge(where, pressure, picked.absolute))


def _times(table: CsvTable, column: int) -> Array:
    """Times of a column [s]; of one without a unit dates and times of day too."""
    try:
        return table.numbers(column, "s", "s or ms")
    except ValueError:
        try:
            stamps = [datetime.fromisoformat(_dated(row[column])) for _, row in table.rows]
        except ValueError:
            stamps = []
        if not stamps or table.rows[0][1][column].replace(".", "").isdigit():
            raise
    return np.array([(stamp - stamps[0]).total_seconds() for stamp in stamps])


def _dated(cell: str) -> str:
    """Text of a date and time, of a time alone that of a day."""
    return cell if "-" in cell or "/" in cell else f"2000-01-01T{cell}"


def _gauge(where: str, pressure: Array, absolute: bool) -> Array:
    """Pressures over the ambient one [Pa]."""
    lowest = np.quantile(pressure, 0.02, axis=0)
    low, high = _AMBIENT
    at_rest = bool((low < lowest).all() and (lowest < high).all() and np.ptp(lowest) < _ALIKE)
    if not (absolute or at_rest):
        return pressure
    ambient, why = ATMOSPHERE, "the standard atmosphere, is taken off"
    if at_rest or low < lowest.min() < high:
        near = pressure[pressure < lowest.min() + _ALIKE]
        ambient, why = float(np.median(near)), "to which chambers vent, is taken off"
    said = "pressures are absolute" if absolute else "pressures that never fall below the ambient "
    said += "" if absolute else "one are taken for absolute"
    LOG.warning("%s: %s: %.2f kPa, %s", where, said, 1e-3 * ambient, why)
    return pressure - ambient


def read_gait(
    path: Path,
    chambers: Sequence[str] = (),
    columns: Sequence[str] = (),
    cycle: float | None = None,
    shortest: float = SHORTEST,
) -> tuple[Gait, float]:
    """The gait of a file and its highest pressure [Pa]; it repeats if it is cut to a cycle.

    Args:
        path, chambers, columns: see read_series.
        cycle: duration of a cycle in it [s]; the last whole one is the gait's.
        shortest: see mjsim.files.gaits.mergers.

    Raises:
        ValueError: see read_series and as_gait.
    """
    series = read_series(path, chambers, columns)
    try:
        return as_gait(path.stem, series, cycle, shortest)
    except ValueError as error:
        raise ValueError(f"pressures {str(path)!r}: {error}") from error


def as_gait(
    name: str, series: Series, cycle: float | None = None, shortest: float = SHORTEST
) -> tuple[Gait, float]:
    """The gait of a series and its highest pressure [Pa]; it repeats if it is cut to a cycle.

    Args:
        name: of the gait.
        series: pressures along time.
        cycle, shortest: see read_gait.

    Raises:
        ValueError: no pressure is above the noise, the series is shorter than a cycle, or the cycle
            does not end as it begins.
    """
    if cycle is not None:
        series = _last_cycle(name, series, cycle)
    merged = ramps(*series, shortest)
    time, pressure = merged.time - merged.time[0], merged.pressure
    highest = float(np.abs(pressure).max())
    if not highest > 0:
        raise ValueError("no pressure is above the noise")
    if merged.moved or len(time) < merged.corners:
        LOG.warning(
            "gait %s: %d of %d corners merged, as some were closer than %g s: the others "
            "move by up to %.3g s, and pressures on the way by up to %.2g kPa",
            name, merged.corners - len(time),
            merged.corners, shortest, merged.moved, 1e-3 * merged.changed,
        )  # fmt: skip
    if cycle is not None:
        time, pressure = _closed(time, pressure, cycle, highest)
    fractions = np.where(np.abs(pressure) > (1 - _SAME) * highest, np.sign(pressure),
                         pressure / highest)  # fmt: skip
    gait = Gait(name, tuple(map(tuple, fractions.tolist())), tuple(np.diff(time).tolist()),
                repeats=cycle is not None)  # fmt: skip
    if cycle is None:
        _note_cycles(gait)
    return gait, highest


def _last_cycle(name: str, series: Series, cycle: float) -> Series:
    """The last whole cycle of a series."""
    time, pressure = series
    count = math.floor(time[-1] / cycle + _SHORT) if cycle > 0 else 0
    if count < 1:
        raise ValueError(
            f"cycle must be above 0 s and at most the {time[-1]:g} s of the record, got {cycle:g} s"
        )
    begin, end = (count - 1) * cycle, count * cycle
    inside = (time >= begin) & (time <= end)
    if count > 1:
        LOG.warning("gait %s: the last of %d cycles of %g s repeats", name, count, cycle)
    edges = np.array([begin, max(end, time[-1] if time[-1] < end else end)])
    at = np.stack([np.interp(edges, time, column) for column in pressure.T], axis=1)
    times = np.concatenate([[begin], time[inside], [edges[1]]]) - begin
    return Series(times, np.concatenate([at[:1], pressure[inside], at[1:]]))


def _closed(time: Array, pressure: Array, cycle: float, highest: float) -> tuple[Array, Array]:
    """Corners of a cycle that ends as it begins.

    Raises:
        ValueError: it ends elsewhere, or cannot be that short.
    """
    apart = np.abs(pressure[-1] - pressure[0])
    if apart.max() > _OPEN * highest:
        chamber = int(apart.argmax())
        begin, end = (1e-3 * pressure[row, chamber] for row in (0, -1))
        raise ValueError(
            f"cycle must be the time after which pressures are the same again, got {cycle:g} s: "
            f"chamber {chamber + 1} begins at {begin:.4g} kPa and ends at {end:.4g} kPa"
        )
    pressure = pressure.copy()
    pressure[0] = pressure[-1] = 0.5 * (pressure[0] + pressure[-1])
    return np.append(time[:-1], cycle), pressure


def _note_cycles(gait: Gait) -> None:
    """Say that a record which repeats itself counts as one cycle."""
    pressures = gait.fractions(np.linspace(0.0, gait.period, _GRID))
    spread = math.sqrt(2 * float(pressures.var(axis=0).sum()))
    lags = np.arange(1, int((0.5 + _SHORT) * _GRID))
    off = np.array([np.square(pressures[lag:] - pressures[:-lag]).sum(axis=1).mean()
                    for lag in lags]) ** 0.5  # fmt: skip
    apart = int(np.argmax(off > 0.5 * spread))  # before it a record is like itself
    if not apart or not (off[apart:] < _PERIODIC * spread).any():
        return
    first = apart + int(np.argmax(off[apart:] < _PERIODIC * spread))
    lag = first + int(off[first : 2 * first].argmin()) + 1
    cycle = gait.period * lag / (_GRID - 1)
    LOG.warning(
        "gait %s: its %.4g s count as one cycle, though they look like %.3g of %.3g s each: "
        "cycle = %.3g, or --cycle %.3gs, cuts and repeats one",
        gait.name, gait.period, gait.period / cycle, cycle, cycle, cycle,
    )  # fmt: skip
