"""Tractions of contacts on an elastic body: which stick and which slide in one increment.

Traction t_j of the ground on contact j moves every contact by the body's compliance K, and the
whole moves by U:

    s = g + U + K t,    sum_j t_j = F,    |t_j| <= V_j where s_j = 0,  else

    t_j = -V_j sign(s_j) - c_j s_j,

with s the slips, g what they would be without traction, F the force that pulls the body
towards -x, V_j dry and c_j viscous resistance: the next minimum of energy + dissipation, to second
order in the slips (incremental minimisation; Mielke and Roubicek, Rate-Independent Systems, 2015).
On a stiff body (K = 0) it is the least dissipation of analytic.friction.dissipation. Vanishing
viscosity decides, as there, what equal bounds leave open.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgesv

Array = NDArray[np.float64]

_VANISHING = 1e-6  # viscous resistance that decides between equal bounds, over the greatest; chosen
_GIVE = 1e-11  # of a contact that sticks, under the greatest bound; keeps a flat strip's K regular
_ROUNDING = 1e-13
_ALL_AT_ONCE, _ATTEMPTS = 10, 200


class Tractions(NamedTuple):
    """One increment of C contacts.

    Attributes:
        traction: t, (C,).
        whole: U.
        slips: -1, 0 or 1 as each slides towards -x, sticks or slides towards +x, (C,).
        slid: s, (C,).
    """

    traction: Array
    whole: float
    slips: NDArray[np.int_]
    slid: Array


def tractions(
    gaps: Array,
    compliance: Array,
    bounds: Array,
    viscosity: Array,
    pull: float = 0.0,
    guess: NDArray[np.int_] | None = None,
) -> Tractions | None:
    """Solve for t and U by changing which contacts stick and slide until all conditions are met.

    Args:
        gaps: g, (C,).
        compliance: K, (C, C).
        bounds: V, (C,), at least 0.
        viscosity: c, (C,), at least 0.
        pull: F.
        guess: as Tractions.slips.

    Returns:
        None if no contact can balance the pull, or no state meets the conditions.
    """
    count = len(bounds)
    scale = float(bounds.max(initial=0.0)) or 1.0
    drag, give = viscosity + _VANISHING * scale, _GIVE / scale
    dry = bounds > 0
    slips = np.zeros(count, dtype=int) if guess is None else guess.copy()
    matrix, right = np.zeros((count + 1, count + 1)), np.zeros(count + 1)
    matrix[-1, :-1], right[-1] = 1.0, pull
    for attempt in range(_ATTEMPTS):
        stick = dry & (slips == 0)
        factor = np.where(stick, 1.0, drag)
        matrix[:-1, :-1] = factor[:, None] * compliance
        matrix[range(count), range(count)] += np.where(stick, give, 1.0)
        matrix[:-1, -1] = factor
        right[:-1] = np.where(stick, 0.0, -slips * bounds) - factor * gaps
        _, _, solution, singular = dgesv(matrix, right)
        if singular:
            return None
        traction, whole = solution[:-1], float(solution[-1])
        slid = gaps + whole + compliance @ traction
        over = np.where(stick, np.abs(traction) - bounds * (1 + 1e-12), 0.0)
        back = np.where(dry & ~stick, -slips * slid - _ROUNDING, 0.0)
        wrong = np.flatnonzero((over > 0) | (back > 0))
        if not len(wrong):
            balanced = stick.any() or viscosity.any() or abs(pull) <= _ROUNDING
            # or some slide one way and some the other, against each other
            balanced = balanced or bool((slips[dry] > 0).any() and (slips[dry] < 0).any())
            slips = np.where(dry, slips, np.sign(slid).astype(int))
            return Tractions(traction, whole, slips, slid) if balanced else None
        if attempt >= _ALL_AT_ONCE:
            wrong = wrong[:1]  # the least index, which cannot cycle
        slips[wrong] = np.where(stick[wrong], -np.sign(traction[wrong]).astype(int), 0)
    return None
