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
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import special

from analytic.fitting import laws
from analytic.fitting.bench import Bench, check_function
from analytic.fitting.laws import SHAPES, LawName
from analytic.fitting.least_squares import BETTER, Data, Solution, Zero, errors_of
from analytic.scene.actuator import Actuator

Array = NDArray[np.float64]

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
            _rounded(pressure), _rounded(curvature), play=_rounded(self.play),
            share=_rounded(self.share),
        )  # fmt: skip


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
    data = Data.of(benches, zero)
    if law is None:
        softens = data.fit("quadratic", 0)
        law = "quadratic" if softens.point[1] <= softens.point[0] else "power"
    best = data.with_plays(law, plays)
    if data.may_be_late and law != "affine":
        late = data.late(law)
        other = late.with_plays(law, plays) if late.start else best
        # a rise that lags may look late: both are compared with their plays
        if best.criterion - other.criterion > BETTER + math.log(len(best.residuals)):
            data, best = late, other
    return _result(data, best)


def _result(data: Data, best: Solution) -> ActuatorFit:
    """The fit in the units of the data."""
    law, plays, count = best.law, best.plays, len(SHAPES[best.law].start)
    shape, play, share, zeros = np.split(best.point, [count, count + plays, count + 2 * plays])
    of_pressure = data.zero == "pressure"
    zeros = zeros * (data.highest if of_pressure else data.largest)
    ends = np.cumsum([len(y) for y in data.y])[:-1]
    tops = [data.highest * x.max() - (zeros[i] if of_pressure else 0.0)
            for i, x in enumerate(data.x)]  # fmt: skip
    sizes = [1.0 if name == "exponent" else data.largest for name in SHAPES[law].names]
    return ActuatorFit(
        law=law, highest=data.highest, start=data.start, reached=float(max(tops)),
        shape=tuple((shape * sizes).tolist()),
        play=tuple((data.highest * play).tolist()), share=tuple(share.tolist()),
        zeros=tuple(zeros.tolist()), zero=data.zero, numbers=tuple(_numbers(data, best)),
        residuals=tuple(data.largest * part for part in np.split(best.residuals, ends)),
    )  # fmt: skip


def _numbers(data: Data, best: Solution) -> Iterator[Number]:
    """Numbers of a fit with their intervals."""
    plays = best.plays
    names = [*SHAPES[best.law].names, *(f"play {k + 1}" for k in range(plays)),
             *(f"share {k + 1}" for k in range(plays)),
             *(f"zero of {name}" for name in data.names if data.zero)]  # fmt: skip
    sizes: dict[str, tuple[float, str]] = {
        "slope": (data.largest / (data.highest - data.start), f"{data.unit}/Pa"),
        "bend": (data.largest, data.unit), "exponent": (1.0, "1"),
        "play": (data.highest, "Pa"), "share": (1.0, "1"),
        "zero": (data.highest, "Pa") if data.zero == "pressure" else (data.largest, data.unit),
    }  # fmt: skip
    errors = errors_of(best, [len(y) for y in data.y])
    free = max(len(best.residuals) - len(best.point), 1)
    wide = float(special.stdtrit(free, 0.5 + 0.5 * _INSIDE))  # Student's t
    for name, value, error in zip(names, best.point, errors, strict=True):
        size, unit = sizes[name.split()[0]]
        ends = size * (value - wide * error), size * (value + wide * error)
        yield Number(name, float(size * value), unit, ends if math.isfinite(error) else None)


def _rounded(values: Sequence[float] | Array) -> tuple[float, ...]:
    """Numbers to the digits that files have."""
    return tuple(float(f"{value:.8g}") for value in values)
