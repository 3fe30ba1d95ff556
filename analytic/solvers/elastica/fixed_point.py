"""Bounds of contacts that depend on the contacts that they lead to."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_FREE_UPDATES = 6  # before the change of bounds is extrapolated


class FixedPoint:
    """Bounds that are those of the contacts that they lead to, by secants and bisection.

    A contact may be a side as long as it resists like a tip, and a tip as long as it resists like a
    side. Then it is both in turn: bisection ends where the bound would jump, at a bound between.

    Args:
        count: of contacts.
        doubts: whether to begin anew where it seems to end, since early results are of shapes that
            are not yet in balance.

    Attributes:
        between: contacts that are so held.
    """

    def __init__(self, count: int, doubts: bool = True) -> None:
        self._doubts = doubts
        self._forget(count)

    def _forget(self, count: int) -> None:
        self._low, self._high = np.full(count, -np.inf), np.full(count, np.inf)
        self._before: tuple[Array, Array] | None = None
        self._tries = 0
        self.between = [False] * count

    @property
    def at_a_jump(self) -> bool:
        """Whether bounds are known that result in greater and in smaller ones, and no others."""
        bounded = np.isfinite(self._low) & np.isfinite(self._high) & (self._low < self._high)
        return self._tries > 2 * _FREE_UPDATES and bool(bounded.any())

    def next(self, bounds: Array, results: Array, near: float) -> tuple[bool, Array]:
        """Tell whether bounds nearly result in themselves, and which to try next."""
        gap = results - bounds
        if np.abs(gap).max(initial=0.0) <= near:
            self.between = [False] * len(gap)
            return True, bounds
        self._low = np.where(gap > near, np.maximum(self._low, bounds), self._low)
        self._high = np.where(gap < -near, np.minimum(self._high, bounds), self._high)
        between = self._low < self._high
        wide = between & (self._high - self._low > 10 * near)
        held = between & ~wide & (np.abs(gap) > near)
        self.between = held.tolist()
        solved = bool(((np.abs(gap) <= near) | held).all())
        if solved and self._doubts:
            self._doubts = False
            self._forget(len(gap))
            return False, results
        after, self._tries = results, self._tries + 1
        if self._before is not None and self._tries > _FREE_UPDATES:
            step, change = bounds - self._before[0], gap - self._before[1]
            falls = change * np.sign(step) < -0.05 * np.abs(step)
            after = bounds - np.where(falls, gap * step / np.where(falls, change, 1.0), -gap)
            after = np.where(np.abs(gap) <= near, bounds, np.maximum(after, 0.0))
            bounded = np.isfinite(self._low) & np.isfinite(self._high) & between
            low, high = np.where(bounded, self._low, 0.0), np.where(bounded, self._high, 0.0)
            outside = bounded & ((after <= low) | (after >= high) | (self._tries % 2 == 0))
            after = np.where(outside, 0.5 * (low + high), after)
        self._before = bounds, gap
        return solved, bounds if solved else after
