"""Ramps that a simulation can follow, from corners some of which are too close to each other.

Corners without which the path of the pressures hardly changes go, the others move apart in time.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SHORTEST = 0.02  # s between corners; 4 steps of the default 5 ms
_CLOSE = (0.01, 0.02, 0.04, 0.08)  # of the highest pressure, by which a merger may change it
_FAR = 2.5  # shortest ramps by which a corner may move in time; chosen
_FIXED = 1e6  # weight of the first and last time


class Ramps(NamedTuple):
    """Straight ramps.

    Attributes:
        time: of the corners, increasing, (C,) [s].
        pressure: at the corners, (C, S) [Pa].
        corners: their number before mergers.
        moved: by which corners moved in time at most [s].
        changed: by which mergers change the path of the pressures at most [Pa].
    """

    time: Array
    pressure: Array
    corners: int
    moved: float
    changed: float


def merged(time: Array, pressure: Array, shortest: float, floor: float) -> Ramps:
    """Ramps none of which is shorter than allowed.

    Args:
        time: of corners, increasing, (C,) [s].
        pressure: (C, S) [Pa].
        shortest: duration of a ramp [s].
        floor: change of pressure that is none [Pa].

    Raises:
        ValueError: the pressures change too fast for ramps that long.
    """
    corners, highest = len(time), float(np.abs(pressure).max())
    if len(time) < 2 or np.diff(time).min() >= shortest:
        return Ramps(time, pressure, corners, 0.0, 0.0)
    for part in _CLOSE:
        kept = _kept(time, pressure, shortest, max(part * highest, floor))
        apart = _apart(time[kept], shortest)
        moved = float(np.abs(apart - time[kept]).max())
        if moved <= _FAR * shortest:
            changed = _change(pressure, kept)
            return Ramps(apart, pressure[kept], corners, moved, changed)
    raise ValueError(
        f"{corners} changes in {time[-1] - time[0]:.3g} s, some much faster than ramps of "
        f"{shortest:g} s can follow: take a smaller timestep, or smoother pressures"
    )


def _kept(time: Array, pressure: Array, shortest: float, tolerance: float) -> NDArray[np.int_]:
    """Corners without those that are near others and on the way between them."""
    kept = np.arange(len(time))
    while len(kept) > 2:
        gaps = np.diff(time[kept])
        near = np.minimum(gaps[:-1], gaps[1:]) < shortest
        off = _off_the_way(time[kept], pressure[kept], shortest)
        off[~near] = math.inf
        least = off.argmin()
        if off[least] > tolerance:
            break
        # all that are the least of their neighbourhood, so that many go at once
        around = np.pad(off, 1, constant_values=math.inf)
        gone = (off <= tolerance) & (off < around[:-2]) & (off <= around[2:])
        gone[least] = True
        kept = np.delete(kept, 1 + np.flatnonzero(gone))
    return kept


def _off_the_way(time: Array, pressure: Array, shortest: float) -> Array:
    """Distance of each inner corner from the ramp between its neighbours at about its time [Pa]."""
    way, span = pressure[2:] - pressure[:-2], time[2:] - time[:-2]
    off = pressure[1:-1] - pressure[:-2]
    square = (way**2).sum(axis=1)
    nearest = (off * way).sum(axis=1) / np.where(square > 0, square, 1.0)
    part, slack = (time[1:-1] - time[:-2]) / span, shortest / span
    nearest = np.clip(np.clip(nearest, part - slack, part + slack), 0.0, 1.0)
    return np.asarray(np.abs(off - nearest[:, None] * way).max(axis=1))


def _apart(time: Array, shortest: float) -> Array:
    """Nearest times that are so far apart, by pooling neighbours (isotonic regression)."""
    offset = shortest * (1 + 1e-9) * np.arange(len(time))
    pools: list[list[float]] = []  # mean, weight, number of times
    for number, value in enumerate(time - offset):
        weight = _FIXED if number in (0, len(time) - 1) else 1.0
        pools.append([float(value), weight, 1])
        while len(pools) > 1 and pools[-2][0] >= pools[-1][0]:
            later, before = pools.pop(), pools[-1]
            total = before[1] + later[1]
            before[0] = (before[0] * before[1] + later[0] * later[1]) / total
            before[1], before[2] = total, before[2] + later[2]
    means = np.concatenate([np.full(int(number), mean) for mean, _, number in pools])
    return np.asarray(means + offset)


def _change(pressure: Array, kept: NDArray[np.int_]) -> float:
    """Distance of the corners that went from the way between those that were kept [Pa]."""
    most = 0.0
    for corner in np.setdiff1d(np.arange(len(pressure)), kept):
        end = int(np.searchsorted(kept, corner))
        begin, way = pressure[kept[end - 1]], pressure[kept[end]] - pressure[kept[end - 1]]
        off, square = pressure[corner] - begin, float(way @ way)
        part = min(max(float(off @ way) / square, 0.0), 1.0) if square else 0.0
        most = max(most, float(np.abs(off - part * way).max()))
    return most
