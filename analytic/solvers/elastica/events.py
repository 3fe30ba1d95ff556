"""Place on the path where contacts change, between two states of the branch."""

import numpy as np
from numpy.typing import NDArray

from analytic.solvers.elastica.points import Point

Array = NDArray[np.float64]

_BEYOND = 0.3  # of the distance to an event first seen, by which to go farther; chosen
_SURE = 0.5  # of the last change of that place, by which to go farther; chosen


class Event:
    """Bracket of the row of the path where contacts change, narrowed by the secant method.

    Margins of contacts, and differences of their bounds, go through 0 there (see
    StickSlip.measures), with a kink or a jump: so each secant goes through two states of one side.
    The next row to try lies slightly beyond its root, so that the event is between the two and the
    bracket shrinks to that; where it is not halved so, or nothing goes through 0, it is bisected.

    Args:
        before: states before it, (1 or 2); two if the path between them is straight.
        after: state after it.
    """

    def __init__(self, before: list[Point], after: Point) -> None:
        self._sides = {False: before, True: [after]}
        self._width = np.inf
        self._place: float | None = None

    @property
    def before(self) -> Point:
        """Last state before the event."""
        return self._sides[False][-1]

    @property
    def after(self) -> Point:
        """First state after it."""
        return self._sides[True][-1]

    @property
    def width(self) -> float:
        """Rows between them."""
        return self.after.row - self.before.row

    def narrow(self, point: Point, after: bool) -> None:
        """Take a state between the two."""
        side = self._sides[after]
        self._sides[after] = [side[-1], point]

    def next(self, least: float) -> float:
        """Row to try next, by so much at least beyond where the event seems to be."""
        begin, end, width = self.before.row, self.after.row, self.width
        halved, self._width = width <= 0.5 * self._width, width
        place = self._estimate()
        previous, self._place = self._place, place
        if place is None or not halved:
            return 0.5 * (begin + end)
        nearer_begin = place - begin < end - place
        distance = min(place - begin, end - place)
        beyond = _BEYOND * distance if previous is None else _SURE * abs(place - previous)
        beyond = max(beyond, least)
        row = place + (beyond if nearer_begin else -beyond)
        return min(max(row, begin + 0.5 * least), end - 0.5 * least)

    def _estimate(self) -> float | None:
        """Row where a measure that changes its sign seems to go through 0, None if unknown."""
        begin, end = self.before.row, self.after.row
        signs = self.before.measures, self.after.measures
        alike = len(signs[0]) == len(signs[1])
        rows = []
        for side in self._sides.values():
            if len(side) == 2 and len(side[0].measures) == len(side[1].measures):
                change = side[1].measures - side[0].measures
                falls = (change != 0) & (signs[0] * signs[1] < 0 if alike else True)
                steps = side[1].measures[falls] / change[falls]
                rows += (side[1].row - steps * (side[1].row - side[0].row)).tolist()
        rows = [row for row in rows if begin < row < end]
        return min(rows, key=lambda row: min(row - begin, end - row), default=None)
