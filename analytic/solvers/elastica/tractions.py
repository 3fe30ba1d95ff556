"""Tractions of contacts on an elastic body: which stick and which slide in one increment.

Traction t_j of the ground on contact j moves every contact by the body's compliance K, and the
whole moves by U:

    s = g + U + K t,    sum_j t_j = F,    |t_j| <= V_j where s_j = 0,  else

    t_j = -V_j sign(s_j) - c_j s_j,

with V_j the dry resistance against motion ahead where t_j < 0, against motion back where t_j > 0,
s the slips, g what they would be without traction, F the force that pulls the body
towards -x, and c_j viscous resistance: the next minimum of energy + dissipation, to second
order in the slips (incremental minimisation; Mielke and Roubicek, Rate-Independent Systems, 2015).
On a stiff body (K = 0) it is the least dissipation of analytic.friction.dissipation. Vanishing
viscosity decides, as there, what equal bounds leave open.
"""

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_VANISHING = 1e-6  # viscous resistance that decides between equal bounds, over the greatest; chosen
_TOLD = 1e-10  # of the greatest bound, which it comes to at least where a contact slides; chosen
_SLIDES = 1e-10  # slip over L of what does not stick; chosen
_GIVE = 1e-11  # of a contact that sticks, under the greatest bound; keeps a flat strip's K regular
_ALIKE = 1e-12  # part of a bound by which two differ by rounding; chosen
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
    back: Array | None = None,
) -> Tractions | None:
    """Solve for t and U by changing which contacts stick and slide until all conditions are met.

    Args:
        gaps: g, (C,).
        compliance: K, (C, C).
        bounds: V, (C,), at least 0.
        viscosity: c, (C,), at least 0.
        pull: F.
        guess: as Tractions.slips.
        back: V against motion back if `bounds` are of motion ahead only, (C,).

    Returns:
        None if no contact can balance the pull, or no state meets the conditions.
    """
    increment = _increment(gaps, compliance, bounds, viscosity, pull, guess, back, _VANISHING)
    most = float(np.abs(increment.slid).max(initial=0.0)) if increment else 0.0
    if increment is None or not _SLIDES < most < _TOLD / _VANISHING or not _any_alike(bounds):
        return increment
    # of slips so short rounding would decide between the two
    surer = _increment(
        gaps, compliance, bounds, viscosity, pull, increment.slips, back, _TOLD / most
    )
    return surer or increment


def _any_alike(bounds: Array) -> bool:
    """Tell whether two contacts resist alike but for a rounding."""
    ordered = sorted(bounds.tolist())
    return any(b - a <= _ALIKE * b for a, b in itertools.pairwise(ordered))


def _increment(
    gaps: Array, compliance: Array, bounds: Array, viscosity: Array, pull: float,
    guess: NDArray[np.int_] | None, back: Array | None, vanishing: float,
) -> Tractions | None:  # fmt: skip
    """See tractions; `vanishing` is the viscous resistance of all over the greatest bound."""
    count = len(bounds)
    strongest = bounds if back is None else np.maximum(bounds, back)
    scale = float(strongest.max(initial=0.0)) or 1.0
    give, limit, gap, row = _GIVE / scale, strongest.tolist(), gaps.tolist(), compliance.tolist()
    ahead, behind = bounds.tolist(), (bounds if back is None else back).tolist()
    drag = [c + vanishing * scale for c in viscosity.tolist()]
    slips = [0] * count if guess is None else guess.tolist()
    for attempt in range(_ATTEMPTS):
        stick = [v > 0 and not slip for v, slip in zip(limit, slips, strict=True)]
        system = []
        for j in range(count):
            factor = 1.0 if stick[j] else drag[j]
            equation = [factor * k for k in row[j]]
            equation[j] += give if stick[j] else 1.0
            dry = (0.0, -ahead[j], behind[j])[slips[j]]
            system.append([*equation, factor, dry - factor * gap[j]])
        system.append([1.0] * count + [0.0, pull])
        solution = _solved(system)
        if solution is None:
            return None
        traction, whole = solution[:-1], solution[-1]
        slid = [
            g + whole + sum(k * t for k, t in zip(ks, traction, strict=True))
            for g, ks in zip(gap, row, strict=True)
        ]
        wrong = [
            j for j in range(count)
            if limit[j] > 0 and (max(-traction[j] - ahead[j], traction[j] - behind[j])
                                 > 1e-12 * limit[j] if stick[j]
                                 else -slips[j] * slid[j] > _ROUNDING)
        ]  # fmt: skip
        if not wrong:
            dry_slips = [slip for slip, v in zip(slips, limit, strict=True) if v > 0]
            # balanced too where some slide one way and some the other, against each other
            if not (any(stick) or viscosity.any() or abs(pull) <= _ROUNDING
                    or (max(dry_slips, default=0) > 0 > min(dry_slips, default=0))):  # fmt: skip
                return None
            slips = [slip if v > 0 else (s > 0) - (s < 0)
                     for slip, v, s in zip(slips, limit, slid, strict=True)]  # fmt: skip
            return Tractions(np.array(traction), whole, np.array(slips, dtype=int), np.array(slid))
        if attempt >= _ALL_AT_ONCE:
            wrong = wrong[:1]  # the least index, which cannot cycle
        for j in wrong:
            slips[j] = (1 if traction[j] < 0 else -1) if stick[j] else 0
    return None


def _solved(system: list[list[float]]) -> list[float] | None:
    """Solution of a few linear equations, rows of (A, b); None if A is singular.

    Gaussian elimination with partial pivoting, in plain floats: numpy is slow on a few numbers.
    """
    size = len(system)
    for k in range(size):
        pivot = max(range(k, size), key=lambda i: abs(system[i][k]))
        if system[pivot][k] == 0.0:
            return None
        system[k], system[pivot] = system[pivot], system[k]
        head = system[k]
        for equation in system[k + 1 :]:
            factor = equation[k] / head[k]
            if factor:
                for j in range(k + 1, size + 1):
                    equation[j] -= factor * head[j]
    solution = [0.0] * size
    for k in reversed(range(size)):
        solved_part = sum(system[k][j] * solution[j] for j in range(k + 1, size))
        solution[k] = (system[k][size] - solved_part) / system[k][k]
    return solution
