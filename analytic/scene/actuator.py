"""An actuator as it was measured: curvature over pressure, rigidity over pressure, hysteresis.

In place of the affine laws (3) and (9) of [Majidi13] stand monotone cubics through points. Where a
falling pressure bends the actuator more than a rising one, plays stand between the pressure in a
chamber and the one that acts, the Prandtl-Ishlinskii model (Brokate and Sprekels, Hysteresis and
Phase Transitions, 1996, section 2):

    P[p] = (1 - sum w_k) p + sum w_k y_k,    p - r_k <= y_k <= p,

where y_k moves only when p pushes it. So the points are those of a pressure that falls; one that
rises from rest acts as p - sum w_k min(p, r_k); and at p = 0 the memory is gone.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.checks import is_number, positive
from analytic.fields import in_si

Array = NDArray[np.float64]

_CURVES = 256  # whose slopes are remembered
_SLOPES = 200  # parts of a curve by whose secants its slope is taken; chosen


@dataclass(frozen=True)
class Actuator:
    """Curve of a pneu-net, through points at pressures from 0 up.

    A pressure on the other face, below 0, acts as one on this one the other way round. Beyond the
    last point the curve goes on straight.

    Raises:
        ValueError: points are fewer than two or not one of each kind, pressures do not rise, the
            curvature falls, a rigidity is not positive, or the shares of the plays exceed 1.
    """

    pressure: tuple[float, ...]
    """of the points, rising [Pa]; one at 0 without curvature is added where there is none"""
    curvature: tuple[float, ...]
    """there, free of moment, of a pressure that falls [1/m]"""
    rigidity: tuple[float, ...] | None = None
    """D_p there, in place of (9) [N m^2]"""
    play: tuple[float, ...] = ()
    """r_k, by which a pressure must turn back until it acts in full [Pa]"""
    share: tuple[float, ...] = ()
    """w_k, part of the pressure that each play keeps back [1]"""

    def __post_init__(self) -> None:
        in_si(self)
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None:
                object.__setattr__(self, field.name, _numbers(field.name, value))
        if len(self.curvature) != len(self.pressure):
            raise ValueError(f"curvature must be {len(self.pressure)} numbers, one per pressure, "
                             f"got {len(self.curvature)}")  # fmt: skip
        if self.pressure[:1] != (0.0,) and self.pressure and self.rigidity is None:
            object.__setattr__(self, "pressure", (0.0, *self.pressure))
            object.__setattr__(self, "curvature", (0.0, *self.curvature))
        if len(self.pressure) < 2:
            raise ValueError(f"pressure must be two points at least, got {self.pressure!r}")
        self._check_points()
        self._check_plays()

    def _check_points(self) -> None:
        """Raise ValueError for what is no monotone function of pressure."""
        if self.pressure[0]:
            raise ValueError("pressure must begin at 0 where rigidity was measured, got "
                             f"{self.pressure[0]:g} Pa")  # fmt: skip
        for before, after in pairwise(self.pressure):
            if after <= before:
                raise ValueError(f"pressure must rise from point to point, got {after:g} Pa after "
                                 f"{before:g} Pa")  # fmt: skip
        if self.curvature[0]:
            raise ValueError("curvature must be 0 without pressure, where the robot lies flat, got "
                             f"{self.curvature[0]:g} 1/m")  # fmt: skip
        for i, (before, after) in enumerate(pairwise(self.curvature)):
            if after < before:
                raise ValueError(
                    f"curvature must not fall while the pressure rises, got {after:g} 1/m at "
                    f"{self.pressure[i + 1]:g} Pa after {before:g} 1/m at {self.pressure[i]:g} Pa"
                )
        if self.rigidity is not None:
            if len(self.rigidity) != len(self.pressure):
                raise ValueError(f"rigidity must be {len(self.pressure)} numbers, one per "
                                 f"pressure, got {len(self.rigidity)}")  # fmt: skip
            for value in self.rigidity:
                positive("rigidity", value, "N m^2")

    def _check_plays(self) -> None:
        """Raise ValueError for plays of which a pressure that rises would act as one that falls."""
        if len(self.share) != len(self.play):
            raise ValueError(f"share must be {len(self.play)} numbers, one per play, got "
                             f"{len(self.share)}")  # fmt: skip
        for name in ("play", "share"):
            for value in getattr(self, name):
                positive(name, value, "Pa" if name == "play" else "1")
        if sum(self.share) > 1:
            raise ValueError(f"share must be parts of the pressure, together 1 at most, got "
                             f"{sum(self.share):g}")  # fmt: skip

    @property
    def highest(self) -> float:
        """Pressure up to which it was measured [Pa]."""
        return self.pressure[-1]

    def curvature_at(self, pressure: ArrayLike) -> Array:
        """kappa of pressures that act, of any shape, free of moment [1/m]."""
        p = np.asarray(pressure, dtype=float)
        return np.asarray(np.sign(p) * _through(self.pressure, self.curvature, np.abs(p)))

    def rigidity_at(self, pressure: ArrayLike) -> Array | None:
        """D_p of pressures that act, of any shape [N m^2]; None where it was not measured."""
        if self.rigidity is None:
            return None
        p = np.minimum(np.abs(np.asarray(pressure, dtype=float)), self.highest)
        return _through(self.pressure, self.rigidity, p)

    def steepest(self, most: float) -> float:
        """Largest slope of the curve up to a pressure [1/(m Pa)]."""
        at = np.linspace(0.0, most, _SLOPES + 1)
        return float(np.max(np.diff(self.curvature_at(at)) / np.diff(at)))


def _numbers(name: str, values: Any) -> tuple[float, ...]:
    if isinstance(values, str) or not isinstance(values, Sequence | np.ndarray):
        raise ValueError(f"{name} must be numbers, one per point, got {values!r}")
    for value in values:
        if not is_number(value):
            raise ValueError(f"{name} must be finite numbers, got {value!r}")
    return tuple(float(value) for value in values)


@lru_cache(_CURVES)
def _slopes(x: tuple[float, ...], y: tuple[float, ...]) -> tuple[Array, Array, Array]:
    """Points (n,), (n,), and slopes there, (n,), of the monotone cubics of Fritsch and Butland.

    F. N. Fritsch and J. Butland, A method for constructing local monotone piecewise cubic
    interpolants, SIAM J. Sci. Stat. Comput. 5 (1984); at the ends those of Moler's pchip.
    """
    at, value = np.array(x), np.array(y)
    h, secant = np.diff(at), np.diff(value) / np.diff(at)
    slope = np.empty(len(at))
    left, right = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    alike = secant[1:] * secant[:-1] > 0
    safe = [np.where(alike, part, 1.0) for part in (secant[:-1], secant[1:])]
    inner = (left + right) / (left / safe[0] + right / safe[1])
    slope[1:-1] = np.where(alike, inner, 0.0)
    slope[0], slope[-1] = secant[0], secant[-1]
    if len(at) > 2:
        slope[0] = _end(h[0], h[1], secant[0], secant[1])
        slope[-1] = _end(h[-1], h[-2], secant[-1], secant[-2])
    return at, value, slope


def _end(h: float, other_h: float, secant: float, other: float) -> float:
    """Slope at an end by three points, as far as it keeps the curve monotone."""
    slope = ((2 * h + other_h) * secant - h * other) / (h + other_h)
    if slope * secant <= 0:
        return 0.0
    return 3 * secant if secant * other < 0 and abs(slope) > 3 * abs(secant) else float(slope)


def _through(x: tuple[float, ...], y: tuple[float, ...], p: Array) -> Array:
    """Monotone cubics through points at places p >= 0, straight beyond the last one."""
    at, value, slope = _slopes(x, y)
    i = np.clip(np.searchsorted(at, p, side="right") - 1, 0, len(at) - 2)
    h = at[i + 1] - at[i]
    within = np.minimum(p, at[-1])
    t, rise = (within - at[i]) / h, value[i + 1] - value[i]
    # cubic Hermite, so written that a straight line through the points is one exactly
    bend = t * (1 - t) * ((1 - t) * (h * slope[i] - rise) - t * (h * slope[i + 1] - rise))
    return np.asarray(value[i] + t * rise + bend + slope[-1] * (p - within))


class Memory:
    """Plays of the actuators of several chambers, and where they are.

    Args:
        actuators: of each chamber, None of one by the affine law.
    """

    def __init__(self, actuators: Sequence[Actuator | None]) -> None:
        most = max((len(a.play) for a in actuators if a), default=0)
        self._width = np.zeros((len(actuators), most))
        self._share = np.zeros((len(actuators), most))
        for i, actuator in enumerate(actuators):
            if actuator:
                self._width[i, : len(actuator.play)] = actuator.play
                self._share[i, : len(actuator.share)] = actuator.share
        self._state = np.zeros((len(actuators), most))
        self._sign = np.ones(len(actuators))

    def follow(self, pressures: Array) -> Array:
        """Pressures that act, (T, S), as the chambers' go along a path, (T, S) [Pa].

        Monotone from one row to the next; without plays they are the path's own.
        """
        if not self._width.shape[1]:
            return pressures
        acting = np.empty_like(pressures)
        free = 1.0 - self._share.sum(axis=1)
        for i, row in enumerate(pressures):
            size, sign = np.abs(row), np.where(row < 0, -1.0, 1.0)
            self._state[sign != self._sign] = 0.0  # through no pressure
            self._sign = sign
            low = size[:, None] - self._width
            np.clip(self._state, low, size[:, None], out=self._state)
            acting[i] = sign * (free * size + (self._share * self._state).sum(axis=1))
        return acting
