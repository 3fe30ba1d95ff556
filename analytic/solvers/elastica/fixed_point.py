"""Bounds of contacts that depend on the contacts that they lead to."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_FREE_UPDATES = 6  # before the change of bounds is extrapolated
_BALANCED = 1e-3  # change in a step of Newton's method, see FixedPoint.balanced [rad]; chosen
_BEYOND = 0.1  # of the way to where a margin seems to be 0, by which to go farther; chosen


class FixedPoint:
    """Bounds that are those of the contacts that they lead to, by secants.

    A contact may be a side as long as it resists like a tip, and a tip as long as it resists like a
    side. Then it is both in turn, and the bound lies between, where the contact's margin is 0. That
    is asked of shapes in balance only, since others tell contacts wrongly.

    Args:
        count: of contacts.

    Attributes:
        between: contacts that are so held.
        balanced: change in a step of Newton's method within which shapes tell contacts [rad].
    """

    def __init__(self, count: int) -> None:
        self.between = [False] * count
        self.balanced = 1.0
        self._before: tuple[Array, Array] | None = None
        self._tries = 0
        self._brackets = [_Bracket() for _ in range(count)]

    @property
    def at_a_jump(self) -> bool:
        """Tell whether bounds are known that result in greater and in smaller ones alone."""
        return self.balanced < 1.0 and any(bracket.closed for bracket in self._brackets)

    def next(
        self, bounds: Array, results: Array, margins: Array, near: float
    ) -> tuple[bool, Array]:
        """Tell whether bounds nearly result in themselves, and which to try next.

        Args:
            bounds: tried, (C,).
            results: bounds of the contacts that they led to, (C,).
            margins: of those contacts, (C,): above 0 for a side, below for a tip, and 0 where
                nothing is known of them.
            near: difference within which bounds are alike.
        """
        gap = results - bounds
        alike = np.abs(gap) <= near
        if alike.all():
            self.between = [False] * len(gap)
            return True, bounds
        for bracket, bound, difference, margin in zip(
            self._brackets, bounds.tolist(), gap.tolist(), margins.tolist(), strict=True
        ):
            if abs(difference) > near:
                bracket.narrow(_Try(bound, difference, margin))
        closed = np.array([bracket.closed for bracket in self._brackets])
        if closed.any() and self.balanced == 1.0 and self._tries > 1:
            self.balanced = _BALANCED
            self._brackets = [_Bracket() for _ in bounds]
            return False, bounds
        held = np.array([bracket.held(10 * near) for bracket in self._brackets]) & ~alike
        self.between = held.tolist()
        solved = bool((alike | held).all())
        after, self._tries = results, self._tries + 1
        if self._before is not None and self._tries > _FREE_UPDATES:
            step, change = bounds - self._before[0], gap - self._before[1]
            falls = change * np.sign(step) < -0.05 * np.abs(step)
            after = bounds - np.where(falls, gap * step / np.where(falls, change, 1.0), -gap)
            after = np.where(alike, bounds, np.maximum(after, 0.0))
        after = np.array([
            bracket.within(3 * near) if bracket.closed else bound
            for bracket, bound in zip(self._brackets, after.tolist(), strict=True)
        ])  # fmt: skip
        self._before = bounds, gap
        return solved, bounds if solved else after


class _Try(NamedTuple):
    """A bound of one contact, by how much it results in a greater one, and that one's margin."""

    bound: float
    gap: float
    margin: float


class _Bracket:
    """Bounds of one contact that result in greater ones, and in smaller ones."""

    def __init__(self) -> None:
        # each the last two, of which the last is the nearest to the others
        self._low: list[_Try] = []
        self._high: list[_Try] = []
        self._width = math.inf  # before the last step

    @property
    def closed(self) -> bool:
        """Tell whether some are known of either."""
        return bool(self._low and self._high)

    @property
    def _jumps(self) -> bool:
        """Tell whether one of the nearest two is of a tip and the other of a side."""
        return self._low[-1].margin * self._high[-1].margin < 0

    def held(self, least: float) -> bool:
        """Tell whether no bound between those known, so near to each other, results in itself."""
        if not self.closed:
            return False
        width = self._high[-1].bound - self._low[-1].bound
        return width <= (least if self._jumps else 1e-3 * least)

    def narrow(self, new: _Try) -> None:
        """Take a bound to those known."""
        order = 1.0 if new.gap > 0 else -1.0
        side, other = (self._low, self._high) if new.gap > 0 else (self._high, self._low)
        if not side or order * (new.bound - side[-1].bound) > 0:
            side[:] = [*side[-1:], new]
        if other and order * (other[-1].bound - new.bound) <= 0:
            other.clear()  # what was known of it was of another shape

    def within(self, least: float) -> float:
        """A bound to try next, at a jump at least so far from either side."""
        low, high = self._low[-1].bound, self._high[-1].bound
        width, before = high - low, self._width
        self._width = width
        by = 2 if self._jumps else 1
        least = min(least if self._jumps else 0.0, 0.5 * width)
        pairs = [self._low, self._high] + ([] if self._jumps else [[self._low[-1], self._high[-1]]])
        guesses = [
            (abs(zero - pair[-1].bound), zero + _BEYOND * (zero - pair[-1].bound) * self._jumps)
            for pair in pairs
            if (zero := _zero(pair, by)) is not None and low < zero < high
        ]
        if not guesses or width > 0.5 * before:
            return 0.5 * (low + high)
        return min(max(min(guesses)[1], low + least), high - least)


def _zero(pair: list[_Try], by: int) -> float | None:
    """Bound at which a value, gap or margin, is 0 by a line through two tries; None if unknown."""
    if len(pair) < 2 or pair[0][by] == pair[1][by]:
        return None
    before, latest = pair
    return latest.bound - latest[by] * (latest.bound - before.bound) / (latest[by] - before[by])
