"""Slips of a few contacts in one increment, by trying them all."""

from itertools import product

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_VISCOUS = 1e-3  # resistance that decides what bounds leave open, times a slip of L over the bound
_GIVE = 1e-9  # of a contact that sticks, over L by D0 / L^2
_SMALL = 1e-10


def friction(
    gap: Array,
    compliance: Array,
    bound: Array,
    before: tuple[int, ...],
    backward: Array | float = 1.0,
) -> tuple[Array, float, tuple[int, ...]] | None:
    """Friction t of each contact, motion U of the whole and slips, by trying all patterns of slips.

    s = g + U - K t, sum t = 0, -b V <= t <= V where s = 0, else t = V + c s ahead and -b V + c s
    back, with c next to none and b = backward, of each.
    """
    count = len(bound)
    if not count:
        return np.zeros(0), 0.0, ()
    drag = _VISCOUS * max(float(bound.max()), _SMALL)
    options = [(-1, 0, 1) if v > 0 else (2,) for v in bound]
    everything = np.array(list(product(*options)))
    first = np.array([before]) if len(before) == count else everything[:0]
    first = np.where(bound > 0, np.where(first == 2, 0, first), 2)
    for patterns in (first, everything):
        if not len(patterns):
            continue
        stick = patterns == 0
        dry = np.where(np.abs(patterns) == 1, patterns, 0) * bound
        dry = np.where(dry < 0, backward * dry, dry)
        # rows: s = -give t where it sticks, t - c s = dry where it slides, sum t = 0
        factor = np.where(stick, 1.0, -drag)
        system = np.zeros((len(patterns), count + 1, count + 1))
        system[:, :count, :count] = -factor[:, :, None] * compliance
        i = np.arange(count)
        system[:, i, i] += np.where(stick, -_GIVE, 1.0)
        system[:, :count, count] = factor
        system[:, count, :count] = 1.0
        right = np.zeros((len(patterns), count + 1, 1))
        right[:, :count, 0] = dry - factor * gap
        solution = np.linalg.solve(system, right)[..., 0]
        t, whole = solution[:, :count], solution[:, count]
        slip = gap + whole[:, None] - t @ compliance.T
        most = np.where(t < 0, backward, 1.0) * np.where(bound > 0, bound, 1.0)
        over = np.where(stick, np.abs(t) / most - 1.0, 0.0)
        back = np.where(np.abs(patterns) == 1, -patterns * slip, 0.0)
        wrong = np.maximum(over - 1e-10, 1e3 * (back - 1e-14)).max(axis=1)
        best = int(np.argmin(wrong))
        if wrong[best] <= (0.0 if patterns is first else 1e-6):
            return t[best], float(whole[best]), tuple(int(s) for s in patterns[best])
    return None
