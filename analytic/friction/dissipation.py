"""Least dissipation along a line: which contacts of a soft robot slide.

The robot's shape moves its contacts by dX_j along x while the whole moves by dU. The ground resists
at each by a bound V_j, and the motion is the one that dissipates least,

    dU minimises  sum_j V_j |dU + dX_j|,

a weighted median, V_j being the bound against the way that a contact slides. With two contacts it
is the rule of [Majidi13], section 2.2: the one with the larger bound stays. Where several dU
dissipate alike (equal tips; no bound anywhere) the limit of vanishing equal viscosity decides, the
least squares of the slips among the minimisers.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ALIKE = 1e-9  # part of the whole bound that two halves may differ by and count as equal; chosen


def least_dissipation(bounds: Array, moves: Array, back: Array | None = None) -> float:
    """The motion dU of the whole [m].

    Args:
        bounds: V_j of the contacts, at least 0, shape (C,) [N].
        moves: dX_j by which the shape moves them, shape (C,) [m].
        back: bounds against motion back, towards -x, if those are of motion ahead only [N].
    """
    low, high = minimisers(bounds.tolist(), moves.tolist(), None if back is None else back.tolist())
    return float(np.clip(-moves.mean(), low, high))


def minimisers(
    bounds: Sequence[float], moves: Sequence[float], back: Sequence[float] | None = None
) -> tuple[float, float]:
    """The interval of all dU that dissipate least [m]; without any bound the whole line.

    Plain floats, since this is asked at every step of a simulation.
    """
    back = bounds if back is None else back
    against = sum(back)  # slope of the dissipation where all slide back, with the other sign
    total = 0.5 * (sum(bounds) + against)
    if total <= 0:
        return -math.inf, math.inf
    first, below = None, 0.0
    corners = [0.5 * (v + b) for v, b in zip(bounds, back, strict=True)]
    ordered = sorted(zip(moves, corners, strict=True), reverse=True)
    if against <= ALIKE * total:
        first = -math.inf  # all may slide back for nothing
    for move, corner in ordered:
        below += corner
        # the slope of the dissipation right of this place is 2 below - against
        if first is None and below >= 0.5 * against - ALIKE * total:
            first = -move
        if below >= 0.5 * against + ALIKE * total:
            return (-move if first is None else first), -move
    return (-ordered[-1][0] if first is None else first), math.inf
