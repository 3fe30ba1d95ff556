"""Slides along a walk: increments in which the same end slides."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_STILL = 1e-9  # change of the separation over L that is none; chosen
_SHORT = 1e-6  # of a slide over L, so short that it does not count; chosen
_FRACTION = 2e-3  # of a slip fraction, from 0, 1/2 and 1; chosen
SLIDERS = {0.0: "right", 0.5: "both", 1.0: "left"}


class Run(NamedTuple):
    """Increments in which the same end slides.

    Attributes:
        slip: fraction of the left end.
        begin, end: rows where it begins and ends.
        change: of the separation [m].
        counts: whether it is in the cycle that is measured.
    """

    slip: float
    begin: int
    end: int
    change: float
    counts: bool


def runs_of(separation: Array, left: Array, times: Array, start: float, length: float) -> list[Run]:
    """Slides along a walk, but for those so short that they do not count."""
    change, moved = np.diff(separation), np.diff(left)
    runs: list[Run] = []
    for row in np.flatnonzero(np.abs(change) > _STILL * length):
        slip = -moved[row] / change[row]
        near = round(2 * slip) / 2
        if abs(slip - near) > _FRACTION or near not in SLIDERS:
            continue
        counts = bool(times[row] >= start * (1 - 1e-12) - 1e-9)
        run = Run(near, int(row), int(row) + 1, float(change[row]), counts)
        if runs and (runs[-1].slip, runs[-1].counts) == (near, counts):
            total = runs[-1].change + abs(run.change)
            runs[-1] = runs[-1]._replace(end=run.end, change=total)
        else:
            runs.append(run._replace(change=abs(run.change)))
    long = [run for run in runs if run.change > _SHORT * length]
    merged: list[Run] = []
    for run in long:
        if merged and (merged[-1].slip, merged[-1].counts) == (run.slip, run.counts):
            run = run._replace(begin=merged[-1].begin, change=merged.pop().change + run.change)
        merged.append(run)
    return merged
