"""Corners between straight ramps, of which a noisy record consists as far as the noise lets see.

Samples from which straight lines are farthest are corners (Douglas and Peucker 1973); then their
times and pressures are those that fit all samples best, and corners that do not stand out go.
Corners that no single sample shows come where two lines fit all samples between others better than
one does, by more than noise would let them (as in Friedman 1991, Annals of Statistics 19, 1).
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

from mjsim.files.gaits.mergers import SHORTEST, Ramps, merged

Array = NDArray[np.float64]

_NOISES = 1.5  # by which a corner must stand out, of the largest of so many samples; chosen
_FEW = 16  # samples, too few to estimate their noise; chosen
_LEAST = 0.005  # of the highest pressure, below which a change is none; chosen
_DENSE = 4  # samples in a time step from which on they are averaged; chosen
_STEPS = 1.5  # of a sensor's resolution by which samples may be off; chosen
_SEEN = 2.0  # such changes, by which a corner must stand out once it was fitted; chosen
_ROUNDS, _HALVED = 12, 4  # improvements of the corners' times, and how often each is halved
_SHIFT = 0.4  # of the time to the next corner by which one may move in a round; chosen
_LITTLE = 1e-9
_LAGS = 4  # times the shortest ramp over which neighbours are compared; chosen
_QUARTER = 0.25  # of the shortest ramp: a time step
_PLACES = 64  # between two corners at which another one is tried; chosen


def ramps(time: Array, pressure: Array, shortest: float = SHORTEST) -> Ramps:
    """Few straight ramps through samples.

    Args:
        time: of the samples, not decreasing; the later of two at one time come after a step, (T,)
            [s].
        pressure: (T, S) [Pa].
        shortest: duration of a ramp [s].

    Raises:
        ValueError: the pressures change too fast for ramps that long.
    """
    ends = time[[0, -1]]
    resolution = _resolution(pressure)
    time, pressure, count = _averaged(_spread(time), pressure, _QUARTER * shortest)
    highest = float(np.abs(pressure).max())
    if not highest > 0:
        raise ValueError("no pressure is above the noise")
    noise = _noise(time, pressure, count, _LAGS * shortest)
    floor = max(_LEAST * highest, _STEPS * resolution)
    seen = _NOISES * math.sqrt(2 * math.log(max(pressure.size, 2))) * noise / np.sqrt(count)
    knots = time[_corners(time, pressure, np.maximum(seen, floor))]
    knots[[0, -1]] = ends
    knots, fitted, sure = _Samples(time, pressure, count, noise).refined(knots, floor)
    fitted[np.abs(fitted) < sure[:, None]] = 0.0
    return merged(knots, fitted, shortest, max(float(np.median(sure)), floor))


def _resolution(pressure: Array) -> float:
    """Step between the values of a sensor that has few of them [Pa]; 0 for all others."""
    steps = []
    for column in pressure.T:
        values = np.unique(column)
        if _FEW < len(values) < len(column) / 4:
            steps.append(float(np.diff(values).min()))
    return max(steps, default=0.0)


def _spread(time: Array) -> Array:
    """Times of which no two are the same.

    A clock that ticks less often than samples are taken gives several the same time: they are
    spread over the tick. Two or so at one time are a step.
    """
    ticks, inverse, counts = np.unique(time, return_inverse=True, return_counts=True)
    if len(ticks) == len(time):
        return time
    first = np.searchsorted(time, ticks)
    part = (np.arange(len(time)) - first[inverse]) / counts[inverse]
    gaps = np.diff(ticks, append=2 * ticks[-1] - ticks[-2] if len(ticks) > 1 else ticks[-1] + 1.0)
    coarse = float(np.median(counts)) > 2
    # a step takes a part of the gap so small that no ramp is bent by it
    width = gaps if coarse else np.minimum(gaps, np.diff(ticks).min(initial=1.0)) * 1e-3
    return np.asarray(time + part * width[inverse])


def _averaged(time: Array, pressure: Array, width: float) -> tuple[Array, Array, Array]:
    """Times, pressures and numbers of samples, where many lie within a width their mean."""
    place = np.floor((time - time[0]) / width).astype(int)
    _, begin, inverse, count = np.unique(
        place, return_index=True, return_inverse=True, return_counts=True
    )
    alone = count[inverse] < _DENSE
    starts = np.union1d(begin, np.flatnonzero(alone))
    sizes = np.diff(np.append(starts, len(time))).astype(float)
    return (
        np.add.reduceat(time, starts) / sizes,
        np.add.reduceat(pressure, starts) / sizes[:, None],
        sizes,
    )


def _noise(time: Array, pressure: Array, count: Array, longest: float) -> float:
    """Deviation of the noise of a sample [Pa].

    It is that of samples from the line between neighbours on both sides, near ones and farther ones
    up to a time, since noise that a sensor smoothes is small between near ones.
    """
    most, lag = 0.0, 1
    while len(time) > _FEW * lag and (
        lag == 1 or float(np.median(time[2 * lag :] - time[: -2 * lag])) < longest
    ):
        left, middle, right = (slice(0, -2 * lag), slice(lag, -lag), slice(2 * lag, None))
        part = (time[middle] - time[left]) / (time[right] - time[left])
        size = np.sqrt(1 / count[middle] + (1 - part) ** 2 / count[left] + part**2 / count[right])
        line = (1 - part)[:, None] * pressure[left] + part[:, None] * pressure[right]
        off = np.abs(pressure[middle] - line) / size[:, None]
        most = max(most, float(np.median(off, axis=0).max()) / 0.6745)
        lag *= 2
    return most


def _corners(time: Array, pressure: Array, tolerance: Array) -> NDArray[np.int_]:
    """Samples between which straight lines stay within the tolerance (Douglas and Peucker 1973)."""
    corners, spans = {0, len(time) - 1}, [(0, len(time) - 1)]
    while spans:
        begin, end = spans.pop()
        if end - begin < 2:
            continue
        inside = slice(begin + 1, end)
        part = ((time[inside] - time[begin]) / (time[end] - time[begin]))[:, None]
        chord = pressure[begin] + part * (pressure[end] - pressure[begin])
        distance = np.abs(pressure[inside] - chord).max(axis=1) / tolerance[inside]
        farthest = int(distance.argmax())
        if distance[farthest] > 1:
            middle = begin + 1 + farthest
            corners.add(middle)
            spans += [(begin, middle), (middle, end)]
    return np.array(sorted(corners))


class _Fit(NamedTuple):
    """Ramps through samples by least squares, so that no corner carries the noise of one sample.

    Attributes:
        values: at the corners, (C, S) [Pa].
        left, right: weights of the samples before and after each corner, (C,).
        pull: of samples before each corner towards more pressure, (C, S) [Pa].
        error: sum of the squares of what is left, weighted [Pa^2].
    """

    values: Array
    left: Array
    right: Array
    pull: Array
    error: float

    def sure(self, noise: float) -> Array:
        """Three deviations of the values, from those of a sample, (C,) [Pa]."""
        return np.asarray(3 * noise / np.sqrt(np.maximum(self.left + self.right, _LITTLE)))


class _Samples(NamedTuple):
    """Times (T,) [s], pressures (T, S) [Pa], numbers of samples in each (T,), and their noise."""

    time: Array
    pressure: Array
    number: Array
    noise: float

    def refined(self, knots: Array, floor: float) -> tuple[Array, Array, Array]:
        """Times of few corners that fit best, pressures there, and what these are sure to [Pa]."""
        knots, fit = self._settled(knots, floor)
        for _ in range(_ROUNDS):
            more, better = self._settled(self._with_missed(knots), floor)
            if len(more) <= len(knots):
                break
            knots, fit = more, better
        return knots, fit.values, np.maximum(fit.sure(self.noise), floor)

    def _settled(self, knots: Array, floor: float) -> tuple[Array, _Fit]:
        """Corners that stand out, at the times that fit best, and their fit."""
        fit = self._through(knots)
        for _ in range(_ROUNDS):
            off, sure = _distance(knots, fit.values, fit.sure(self.noise))
            seen = off > _SEEN * np.maximum(sure, floor)
            # of two neighbours that do not stand out the second may, once the first has gone
            seen[1:] |= ~seen[:-1]
            seen[[0, -1]] = True
            if not seen.all():
                knots = knots[seen]
                fit = self._through(knots)
            elif (better := self._moved(knots, fit)) is not None:
                knots, fit = better
            else:
                break
        return knots, fit

    def _with_missed(self, knots: Array) -> Array:
        """Corners, and between two of them one more where two lines fit better than one."""
        chambers = self.pressure.shape[1]
        chance = self.noise * (math.sqrt(chambers) + math.sqrt(2 * math.log(len(self.time))))
        more = []
        for begin, end in pairwise(knots):
            inside = slice(*np.searchsorted(self.time, [begin, end]))
            time, root = self.time[inside], np.sqrt(self.number[inside])
            if len(time) < _FEW:
                continue
            line, _ = np.linalg.qr(root[:, None] * np.stack([np.ones(len(time)), time - begin], 1))
            values = root[:, None] * self.pressure[inside]
            places = np.linspace(begin, end, _PLACES + 2)[1:-1]
            gains = []
            for place in places:
                bend = root * np.maximum(time - place, 0.0)
                bend -= line @ (bend @ line)
                size = max(float(np.linalg.norm(bend)), _LITTLE * (end - begin))
                gains.append(float(np.linalg.norm(bend @ values)) / size)
            if max(gains) > chance:
                more.append(places[int(np.argmax(gains))])
        return np.sort(np.append(knots, more))

    def _moved(self, knots: Array, fit: _Fit) -> tuple[Array, _Fit] | None:
        """Corners at better times, by a step of Gauss and Newton for each alone, and their fit."""
        slope = np.diff(fit.values, axis=0) / np.diff(knots)[:, None]
        bend = slope[:-1] - slope[1:]
        left, right = fit.left[1:-1], fit.right[1:-1]
        stiffness = (bend**2).sum(axis=1) * left * right / np.maximum(left + right, 1e-300)
        force = -(bend * fit.pull[1:-1]).sum(axis=1)
        step = np.where(stiffness > 0, force / np.where(stiffness > 0, stiffness, 1.0), 0.0)
        gaps = _SHIFT * np.diff(knots)
        step = np.clip(step, -gaps[:-1], gaps[1:])
        for _ in range(_HALVED):
            moved = knots.copy()
            moved[1:-1] += step
            better = self._through(moved)
            if better.error < fit.error * (1 - _LITTLE):
                return moved, better
            step = 0.5 * step
        return None

    def _through(self, knots: Array) -> _Fit:
        """Least squares of all samples with corners at given times."""
        final_ramp, size, count = len(knots) - 2, len(knots), self.number
        index = np.clip(np.searchsorted(knots, self.time, side="right") - 1, 0, final_ramp)
        after = (self.time - knots[index]) / (knots[index + 1] - knots[index])
        before = 1 - after

        def sums(weight: Array, place: NDArray[np.int_], values: Array) -> Array:
            columns = [np.bincount(place, weight * column, size) for column in values.T]
            return np.stack(columns, axis=1)

        right = np.bincount(index, count * before**2, size).astype(float)
        left = np.bincount(index + 1, count * after**2, size).astype(float)
        normal = np.zeros((2, size))  # diagonal, and the one below it
        normal[0] = np.maximum(left + right, _LITTLE)  # a corner without samples
        normal[1] = np.bincount(index, count * before * after, size)
        load = sums(count * before, index, self.pressure)
        load += sums(count * after, index + 1, self.pressure)
        values = np.asarray(solveh_banded(normal, load, lower=True))
        line = before[:, None] * values[index] + after[:, None] * values[index + 1]
        rest = self.pressure - line
        return _Fit(values, left, right, sums(count * after, index + 1, rest),
                    float((count[:, None] * rest**2).sum()))  # fmt: skip


def _distance(time: Array, pressure: Array, sure: Array) -> tuple[Array, Array]:
    """Distance of corners from the ramp between their neighbours, infinite at the ends [Pa].

    Beside it what it is sure to, as corner and neighbours are.
    """
    part = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    line = (1 - part)[:, None] * pressure[:-2] + part[:, None] * pressure[2:]
    off = np.abs(pressure[1:-1] - line).max(axis=1)
    spread = np.sqrt(sure[1:-1] ** 2 + ((1 - part) * sure[:-2]) ** 2 + (part * sure[2:]) ** 2)
    return np.pad(off, 1, constant_values=np.inf), np.pad(spread, 1)
