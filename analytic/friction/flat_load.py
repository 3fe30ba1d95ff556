"""Load of a strip that lies flat: its weight, its payloads, and what adhesion presses it with.

The ground carries the load of a flat stretch where that is, and a concentrated force R besides
where the strip lifts off. So the length xi of a flat end follows from the sum F and the moment M
about the end of the ground's forces: with W(s) the load from the end to s,

    M = int_0^xi (F - W(s)) ds,    R = F - W(xi) >= 0.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

from analytic.scene.robot import GRAVITY, Robot


def flat_length(weight: Any, total: Any, moment: Any) -> Any:
    """xi of a flat end that carries F = w xi + R with the moment M = w xi^2 / 2 + R xi [m].

    Args:
        weight: w [N/m], a float or an array.
        total: F [N], a float or an array.
        moment: M about the end [N m], of the shape of F.
    """
    square = total * total - 2.0 * weight * moment
    return (total - (0.5 * (square + abs(square))) ** 0.5) / weight


def heaviest(strip: Robot) -> float:
    """Greatest weight per length of a strip with what is spread over it [N/m]."""
    return max(weight for _, weight in FlatLoad(strip).weights)


class Piece(NamedTuple):
    """Stretch of even load.

    Attributes:
        begin: distance from where the load is counted from [m].
        point: load at that place [N].
        weight: from there on [N/m].
    """

    begin: float
    point: float
    weight: float


class LoadFrom:
    """Load of a strip from one place on, in one direction.

    Args:
        pieces: in order, the first of which begins at 0.
        whole: length of the strip [m].

    Attributes:
        whole: as given.
    """

    def __init__(self, pieces: Sequence[Piece], whole: float) -> None:
        self.whole = whole
        ends = [piece.begin for piece in pieces[1:]]
        self._pieces = list(zip(pieces, [*ends, float("inf")], strict=True))

    def length(self, total: float, moment: float) -> float:
        """Length of a flat end, by the sum [N] and the moment [N m] of the ground's forces [m]."""
        for (begin, point, weight), end in self._pieces:
            total -= point
            span = end - begin
            whole = (total - 0.5 * weight * span) * span if span < float("inf") else moment
            if total <= 0.0:
                return begin
            if moment <= whole or total <= weight * span:
                return begin + float(flat_length(weight, total, moment))
            total, moment = total - weight * span, moment - whole
        raise AssertionError("the last piece has no end")

    def of(self, length: float) -> float:
        """Load of so much of it, from 0 on [N]."""
        return sum(
            point + weight * (min(end, length) - begin)
            for (begin, point, weight), end in self._pieces if begin <= length
        )  # fmt: skip


class FlatLoad:
    """Load of a strip that lies flat.

    Args:
        strip: with its payloads.
        press: of adhesive ground [N/m].
        normal: part of the weight that presses on the ground [1].

    Attributes:
        weights: where stretches of even load begin [m], and their load [N/m].
        from_begin, from_end: from either end inwards.
    """

    def __init__(self, strip: Robot, press: float = 0.0, normal: float = 1.0) -> None:
        self._length, line_load = strip.length, normal * strip.weight_per_length + press
        stretches, self._points = [], []
        for payload in strip.carried:
            begin, end = (part * strip.length for part in payload.stretch)
            weight = normal * GRAVITY * payload.mass
            if begin == end:
                self._points.append((begin, weight))
            else:
                stretches.append((begin, end, weight / (end - begin)))
        edges = sorted({0.0, *(s for s, _ in self._points), *(s for part in stretches
                                                             for s in part[:2])})  # fmt: skip
        self.weights = [
            (edge, line_load + sum(w for begin, end, w in stretches if begin <= edge < end))
            for edge in edges if edge < strip.length
        ]  # fmt: skip
        self.from_begin, self.from_end = self._from(0.0, 1), self._from(strip.length, -1)

    def length_between(self, places: Sequence[float], push: Sequence[float]) -> float:
        """Length of a flat stretch between the ends, either half of which carries its load [m].

        Args:
            places: of the nodes that push there, ascending [m].
            push: of each [N].
        """
        middle, length = 0.5 * (places[0] + places[-1]), 0.0
        for sign in (-1, 1):
            total = moment = 0.0
            for place, part in zip(places, push, strict=True):
                reach = sign * (place - middle)
                if reach >= 0:
                    total += part if reach else 0.5 * part
                    moment += part * reach
            length += self._from(middle, sign, 0.5).length(total, moment)
        return length

    def _from(self, place: float, sign: int, share: float = 1.0) -> LoadFrom:
        """Load from a place on [m], to the right (1) or left (-1), with a share of what is there.

        A load at the far end is left out, as nothing lies flat beyond it.
        """
        ends = [begin for begin, _ in self.weights[1:]] + [self._length]
        pieces: dict[float, float] = {}  # weight per length by where it begins
        for (begin, weight), end in zip(self.weights, ends, strict=True):
            near, far = sorted((sign * (begin - place), sign * (end - place)))
            if far > 0.0:
                pieces[max(near, 0.0)] = weight
        points = dict.fromkeys(pieces, 0.0)
        for at, weight in self._points:
            reach = sign * (at - place)
            if reach in points:
                points[reach] += weight if reach else share * weight
        if not pieces:
            pieces, points = {0.0: self.weights[-1][1]}, {0.0: 0.0}
        ordered = [Piece(begin, points[begin], pieces[begin]) for begin in sorted(pieces)]
        return LoadFrom(ordered, self._length)
