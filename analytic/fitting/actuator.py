"""Curves and hysteresis of actuators from what a bench measured, by least squares.

Of pressures that act, by the plays of analytic.scene.actuator, x is what is over the pressure at
which bending starts, as a part of the highest. An actuator bends by one of two laws of two numbers,

    quadratic    g0 x + (g1 - g0) x^2 / 2,    slopes g0, g1 >= 0 at either end, if it softens
    power        c x^n                        if it stiffens.

Of laws with as few numbers they miss points beyond or between those that were measured the least:
of 53 layouts of pneu-nets, the top third of the points left out, a quadratic misses 52 by at most 2
degrees, a power law 47, an affine one 18; six actuators that start late, a point left out, are
missed least by power laws.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import optimize, special

from analytic.fitting import laws
from analytic.fitting.bench import Bench, check_function, late_start
from analytic.fitting.laws import SHAPES, LawName
from analytic.scene.actuator import Actuator

Array = NDArray[np.float64]
Zero = Literal["", "angle", "pressure"]

MOST_PLAYS = 3
_BETTER = 10.0  # of Schwarz's criterion for one more play: "very strong" (Kass and Raftery 1995)
_WIDTHS = (0.03, 0.1, 0.3)  # of a play, over the range, at which a search begins; chosen
_TURNS = 0.02  # of the range, by which a pressure must fall to tell of hysteresis; chosen
_POINTS = 33  # of the curve that a law becomes; its cubics are then within 1e-4 of it
_INSIDE = 0.95  # of an interval


class Number(NamedTuple):
    """A fitted number and its 95 % interval, None where it ended at a bound."""

    name: str
    value: float
    unit: str
    interval: tuple[float, float] | None


@dataclass(frozen=True)
class ActuatorFit:
    """Law, plays and zeros that fit the files of a bench best.

    Attributes:
        law: quadratic, power, or affine.
        highest, start: largest reading of a sensor, and pressure at which bending starts [Pa].
        reached: largest pressure, over the zero of its sensor [Pa].
        shape: g0 and g1, c and n, or g0 alone [unit of the bend; n: 1].
        play, share: of plays, the widths [Pa] and the parts of the pressure [1].
        zeros: of each file [Pa, or unit of the bend].
        zero: what the files may read at rest.
        numbers: all fitted ones.
        residuals: model less data, of each file.
    """

    law: LawName
    highest: float
    start: float
    reached: float
    shape: tuple[float, ...]
    play: tuple[float, ...]
    share: tuple[float, ...]
    zeros: tuple[float, ...]
    zero: Zero
    numbers: tuple[Number, ...]
    residuals: tuple[Array, ...]

    def bend(self, acting: Array) -> Array:
        """Bend at pressures that act, of any shape."""
        return laws.bend(self.law, self.shape, (acting - self.start) / self.scale)

    def along(self, path: Array) -> Array:
        """Bend along a path of pressures from rest, (n,)."""
        return self.bend(laws.acting(path, self.play, self.share))

    @property
    def scale(self) -> float:
        """Pressure that is 1 in the law [Pa]."""
        return self.highest - self.start

    @property
    def rms(self) -> float:
        """Root mean square of the residuals."""
        return float(np.sqrt(np.mean(np.concatenate(self.residuals) ** 2)))

    @property
    def worst(self) -> float:
        """Largest residual."""
        return float(np.abs(np.concatenate(self.residuals)).max())

    def actuator(self, length: float | None = None) -> Actuator:
        """The curve as points, up to the highest pressure.

        Args:
            length: of the segment that was bent [m], where the bend is an angle.

        Raises:
            ValueError: it is bent without pressure.
        """
        # denser where a power law is steep
        top = (self.reached - self.start) / self.scale
        x = top * np.linspace(0.0, 1.0, _POINTS) ** 2
        pressure = self.start + self.scale * x
        if self.start < 0:
            raise ValueError(f"an actuator must be straight without pressure; it is at "
                             f"{self.start:g} Pa")  # fmt: skip
        curvature = laws.bend(self.law, self.shape, x) / (length or 1.0)
        return Actuator(
            tuple(pressure.tolist()), tuple(curvature.tolist()), play=self.play, share=self.share
        )


def fit_actuator(
    benches: Sequence[Bench], zero: Zero = "", plays: int | None = None,
    law: LawName | None = None,
) -> ActuatorFit:  # fmt: skip
    """Fit one actuator to the files of a bench.

    Args:
        benches: files; each begins at rest.
        zero: what each may read at rest: angle, the bend's; pressure, the sensor's; or nothing.
        plays: how many; as many as the data need, if None.
        law: quadratic if the actuator softens and power if it stiffens, if None.

    Raises:
        ValueError: the bend is no function of the pressure, or there are fewer numbers than
            unknowns.
    """
    for bench in benches:
        check_function(bench)
    data = _Data.of(benches, zero)
    if law is None:
        softens = data.fit("quadratic", 0)
        law = "quadratic" if softens.point[1] <= softens.point[0] else "power"
    best = data.fit(law, plays or 0)
    if plays is None and data.turns and law != "affine":
        for count in range(1, MOST_PLAYS + 1):
            more = data.fit(law, count)
            if best.criterion - more.criterion < _BETTER:
                break
            best = more
    return data.result(best)


class _Solution(NamedTuple):
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


class _Data(NamedTuple):
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

    @classmethod
    def of(cls, benches: Sequence[Bench], zero: Zero) -> "_Data":
        highest = max(float(bench.pressure.max()) for bench in benches)
        largest = max(float(np.abs(bench.bend).max()) for bench in benches)
        start = 0.0 if zero else min(late_start(bench) for bench in benches)
        x = [bench.pressure / highest for bench in benches]
        y = [bench.bend / largest for bench in benches]
        falls = max(float((np.maximum.accumulate(part) - part).max()) for part in x)
        return cls(tuple(b.name for b in benches), x, y, highest, largest, start, zero,
                   benches[0].unit, falls > _TURNS)  # fmt: skip

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

    def fit(self, law: LawName, plays: int) -> _Solution:
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
        best: _Solution | None = None
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
            found = _Solution(law, plays, solution.x, solution.jac, solution.fun,
                              solution.active_mask == 0)  # fmt: skip
            if best is None or found.criterion < best.criterion:
                best = found
        assert best is not None
        return best

    def _begin(self) -> list[float]:
        """Zeros at which a search begins: where the bend is nearest to none, or at rest."""
        if self.zero == "pressure":
            return [float(x[np.abs(y).argmin()]) for x, y in zip(self.x, self.y, strict=True)]
        return [float(y[np.abs(x).argmin()]) for x, y in zip(self.x, self.y, strict=True)]

    def result(self, best: _Solution) -> ActuatorFit:
        """The fit in the units of the data."""
        law, plays, count = best.law, best.plays, len(SHAPES[best.law].start)
        shape, play, share, zeros = np.split(best.point, [count, count + plays, count + 2 * plays])
        of_pressure = self.zero == "pressure"
        zeros = zeros * (self.highest if of_pressure else self.largest)
        ends = np.cumsum([len(y) for y in self.y])[:-1]
        tops = [self.highest * x.max() - (zeros[i] if of_pressure else 0.0)
                for i, x in enumerate(self.x)]  # fmt: skip
        order = np.argsort(play)
        sizes = [1.0 if name == "exponent" else self.largest for name in SHAPES[law].names]
        return ActuatorFit(
            law=law, highest=self.highest, start=self.start, reached=float(max(tops)),
            shape=tuple((shape * sizes).tolist()),
            play=tuple((self.highest * play[order]).tolist()), share=tuple(share[order].tolist()),
            zeros=tuple(zeros.tolist()), zero=self.zero, numbers=tuple(self._numbers(best)),
            residuals=tuple(self.largest * part for part in np.split(best.residuals, ends)),
        )  # fmt: skip

    def _numbers(self, best: _Solution) -> Iterator[Number]:
        """Numbers of a fit with their intervals."""
        plays = best.plays
        names = [*SHAPES[best.law].names, *(f"play {k + 1}" for k in range(plays)),
                 *(f"share {k + 1}" for k in range(plays)),
                 *(f"zero of {name}" for name in self.names if self.zero)]  # fmt: skip
        sizes: dict[str, tuple[float, str]] = {
            "slope": (self.largest / (self.highest - self.start), f"{self.unit}/Pa"),
            "bend": (self.largest, self.unit), "exponent": (1.0, "1"),
            "play": (self.highest, "Pa"), "share": (1.0, "1"),
            "zero": (self.highest, "Pa") if self.zero == "pressure" else (self.largest, self.unit),
        }  # fmt: skip
        errors = _errors(best, [len(y) for y in self.y])
        free = max(len(best.residuals) - len(best.point), 1)
        wide = float(special.stdtrit(free, 0.5 + 0.5 * _INSIDE))  # Student's t
        for name, value, error in zip(names, best.point, errors, strict=True):
            size, unit = sizes[name.split()[0]]
            ends = size * (value - wide * error), size * (value + wide * error)
            yield Number(name, float(size * value), unit, ends if math.isfinite(error) else None)


def _errors(best: _Solution, counts: Sequence[int]) -> Array:
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
