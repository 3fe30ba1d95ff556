"""Who slides where a soft robot touches the ground: the way of least dissipation.

The robot's shape moves its contacts by dX_j along x while the whole moves by dU. The ground resists
at each by a bound V_j, and the motion is the one that dissipates least,

    dU minimises  sum_j V_j |dU + dX_j|,

a weighted median. With two contacts it is the rule of [Majidi13], section 2.2: the one with the
larger bound stays. Where several dU dissipate alike (equal tips; no bound anywhere) the limit of
vanishing equal viscosity decides, the least squares of the slips among the minimisers.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ALIKE = 1e-9  # part of the whole bound that two halves may differ by and count as a tie; chosen


def least_dissipation(bounds: Array, moves: Array) -> float:
    """The motion dU of the whole [m].

    Args:
        bounds: V_j of the contacts, at least 0, shape (C,) [N].
        moves: dX_j by which the shape moves them, shape (C,) [m].
    """
    low, high = minimisers(bounds, moves)
    return float(np.clip(-moves.mean(), low, high))


def minimisers(bounds: Array, moves: Array) -> tuple[float, float]:
    """The interval of all dU that dissipate least [m]; without any bound the whole line."""
    total = float(bounds.sum())
    if total <= 0:
        return -np.inf, np.inf
    order = np.argsort(-moves)
    places, below = -moves[order], np.cumsum(bounds[order])
    half = 0.5 * total
    # slope of the dissipation right of the j-th place is 2 below_j - total
    first = int(np.searchsorted(below, half - _ALIKE * total))
    last = int(np.searchsorted(below, half + _ALIKE * total))
    return float(places[first]), float(places[min(last, len(places) - 1)])
