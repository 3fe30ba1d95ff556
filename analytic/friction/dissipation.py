"""Least dissipation along a line: which contacts of a soft robot slide.

The robot's shape moves its contacts by dX_j along x while the whole moves by dU. The ground resists
at each by a bound V_j, and the motion is the one that dissipates least,

    dU minimises  sum_j V_j |dU + dX_j|,

a weighted median. With two contacts it is the rule of [Majidi13], section 2.2: the one with the
larger bound stays. Where several dU dissipate alike (equal tips; no bound anywhere) the limit of
vanishing equal viscosity decides, the least squares of the slips among the minimisers.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ALIKE = 1e-9  # part of the whole bound that two halves may differ by and count as equal; chosen


def least_dissipation(bounds: Array, moves: Array) -> float:
    """The motion dU of the whole [m].

    Args:
        bounds: V_j of the contacts, at least 0, shape (C,) [N].
        moves: dX_j by which the shape moves them, shape (C,) [m].
    """
    low, high = minimisers(bounds.tolist(), moves.tolist())
    return float(np.clip(-moves.mean(), low, high))


def minimisers(bounds: Sequence[float], moves: Sequence[float]) -> tuple[float, float]:
    """The interval of all dU that dissipate least [m]; without any bound the whole line.

    Plain floats, since this is asked at every step of a simulation.
    """
    total = sum(bounds)
    if total <= 0:
        return -math.inf, math.inf
    first, below = None, 0.0
    ordered = sorted(zip(moves, bounds, strict=True), reverse=True)
    for move, bound in ordered:
        below += bound
        # the slope of the dissipation right of this place is 2 below - total
        if first is None and below >= (0.5 - _ALIKE) * total:
            first = -move
        if below >= (0.5 + _ALIKE) * total:
            return (-move if first is None else first), -move
    farthest = -ordered[-1][0]
    return (farthest if first is None else first), farthest
