"""Least squares of laws, plays and zeros on the files of a bench."""

import math
from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from analytic.fitting import laws
from analytic.fitting.bench import Bench, late_start
from analytic.fitting.laws import SHAPES, LawName

Array = NDArray[np.float64]
Zero = Literal["", "angle", "pressure"]

MOST_PLAYS = 3
BETTER = 10.0  # of Schwarz's criterion for one more play: "very strong" (Kass and Raftery 1995)
_WIDTHS = (0.03, 0.1, 0.3)  # of a play, over the range, at which a search begins; chosen
_TURNS = 0.02  # of the range, by which a pressure must fall to tell of hysteresis; chosen
_LATEST, _STARTS = 0.6, 13  # of the highest pressure, at which bending may start; tried ones
_MANY = 12  # points that tell of such a start


class Solution(NamedTuple):
    """Least squares of one law and number of plays."""

    law: LawName
    plays: int
    point: Array
    jacobian: Array
    residuals: Array
    inside: NDArray[np.bool_]

    @property
    def criterion(self) -> float:
        """Schwarz's: less is better."""
        count, unknowns = self.jacobian.shape
        square = float(self.residuals @ self.residuals)
        return count * math.log(max(square / count, 1e-300)) + unknowns * math.log(count)


class Data(NamedTuple):
    """Pressures over the highest, bends over the largest, file by file."""

    names: tuple[str, ...]
    x: list[Array]
    y: list[Array]
    highest: float
    largest: float
    start: float
    zero: Zero
    unit: str
    turns: bool
    may_be_late: bool

    @classmethod
    def of(cls, benches: Sequence[Bench], zero: Zero) -> "Data":
        """The data of files, see analytic.fitting.actuator.fit_actuator."""
        highest = max(float(bench.pressure.max()) for bench in benches)
        largest = max(float(np.abs(bench.bend).max()) for bench in benches)
        start = 0.0 if zero else min(late_start(bench) for bench in benches)
        x = [bench.pressure / highest for bench in benches]
        y = [bench.bend / largest for bench in benches]
        falls = max(float((np.maximum.accumulate(part) - part).max()) for part in x)
        seen = zero == "pressure" or any(bench.bend[0] == 0 for bench in benches)
        count = sum(len(part) for part in x)
        return cls(tuple(b.name for b in benches), x, y, highest, largest, start, zero,
                   benches[0].unit, falls > _TURNS, not seen and count >= _MANY)  # fmt: skip

    def late(self, law: LawName) -> "Data":
        """The data with a start of bending above 0, where one without hysteresis fits better."""

        def criterion(part: float) -> float:
            return self._replace(start=part * self.highest).fit(law, 0).criterion

        parts = np.linspace(0.0, _LATEST, _STARTS)
        step = float(parts[1])
        least = float(parts[np.argmin([criterion(part) for part in parts.tolist()])])
        around = max(least - step, 0.0), least + step
        minimum = optimize.minimize_scalar(criterion, bounds=around, method="bounded")
        start = float(minimum.x) * self.highest
        return self._replace(start=start) if criterion(0.0) - minimum.fun > BETTER else self

    def with_plays(self, law: LawName, plays: int | None) -> Solution:
        """The best fit with so many plays, or as many as the data need."""
        best = self.fit(law, plays or 0)
        if plays is None and self.turns and law != "affine":
            for count in range(1, MOST_PLAYS + 1):
                more = self.fit(law, count)
                if best.criterion - more.criterion < BETTER:
                    break
                best = more
        return best

    def model(self, law: LawName, plays: int, point: Array) -> Array:
        """Bends of all files at a point: the law's numbers, widths, shares, zeros."""
        count = len(SHAPES[law].start)
        shape, point = point[:count], point[count:]
        play, share, zeros = np.split(point, [plays, 2 * plays])
        parts = []
        for i, x in enumerate(self.x):
            off = float(zeros[i]) if self.zero else 0.0
            at = x - off if self.zero == "pressure" else x
            late = self.start / self.highest
            acting = laws.acting(at, tuple(play), tuple(share))
            bent = laws.bend(law, tuple(shape), (acting - late) / (1 - late))
            parts.append(bent + off if self.zero == "angle" else bent)
        return np.concatenate(parts)

    def fit(self, law: LawName, plays: int) -> Solution:
        """The best fit from several widths of the plays."""
        target, count = np.concatenate(self.y), len(SHAPES[law].start)
        unknowns = count + 2 * plays + (len(self.x) if self.zero else 0)
        if len(target) < unknowns:
            raise ValueError(f"{self.names[0]}: a fit of {unknowns} numbers needs as many points, "
                             f"got {len(target)}")  # fmt: skip
        low, high = np.full(unknowns, -np.inf), np.full(unknowns, np.inf)
        low[:count], high[:count] = SHAPES[law].low, SHAPES[law].high
        low[count : count + 2 * plays] = [1e-4] * plays + [1e-5] * plays
        high[count : count + 2 * plays] = [1.0] * plays + [1.0 / max(plays, 1)] * plays
        best: Solution | None = None
        for width in _WIDTHS if plays else (0.0,):
            begin = np.zeros(unknowns)
            begin[:count] = SHAPES[law].start
            begin[count : count + plays] = width * 3.0 ** -np.arange(plays)
            begin[count + plays : count + 2 * plays] = 0.1
            if self.zero:
                begin[count + 2 * plays :] = self._begin()
            solution = optimize.least_squares(
                lambda point: self.model(law, plays, point) - target, begin, bounds=(low, high),
                x_scale="jac", diff_step=1e-5,
            )  # fmt: skip
            candidate = Solution(law, plays, solution.x, solution.jac, solution.fun,
                              solution.active_mask == 0)  # fmt: skip
            if best is None or candidate.criterion < best.criterion:
                best = candidate
        assert best is not None
        return best

    def _begin(self) -> list[float]:
        """Zeros at which a search begins: where the bend is nearest to none, or at rest."""
        if self.zero == "pressure":
            return [float(x[np.abs(y).argmin()]) for x, y in zip(self.x, self.y, strict=True)]
        return [float(y[np.abs(x).argmin()]) for x, y in zip(self.x, self.y, strict=True)]


def errors_of(best: Solution, counts: Sequence[int]) -> Array:
    """Standard errors, NaN of what ended at a bound; larger where neighbouring errors are alike."""
    jacobian = best.jacobian[:, best.inside]
    free = max(len(best.residuals) - jacobian.shape[1], 1)
    variance = float(best.residuals @ best.residuals) / free
    parts = np.split(best.residuals, np.cumsum(counts)[:-1])
    alike = sum(float(part[1:] @ part[:-1]) for part in parts)
    r = min(max(alike / max(float(best.residuals @ best.residuals), 1e-300), 0.0), 0.99)
    covariance = np.linalg.pinv(jacobian.T @ jacobian) * variance * (1 + r) / (1 - r)
    errors = np.full(len(best.point), np.nan)
    errors[best.inside] = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    return errors
