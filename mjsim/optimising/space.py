"""Gaits as points of a unit cube: lag, duty, ramp and pressure of the chambers."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.gait import Gait
from analytic.scene.trapezoid import staggered

Array = NDArray[np.float64]

GRID = 0.02  # of the cycle and of the pressure, the finest that valves can follow; chosen
SHORTEST = 0.2  # of the longest period, the shortest that is searched; chosen
_DUTY = (0.1, 0.9)
_GENTLEST, _LEAST = 1.0, 0.15  # ramps, as part of the longest that the duty leaves room for


class Space(NamedTuple):
    """Space of a robot's gaits.

    A point has S - 1 lags between neighbours (parts of the cycle, periodic), then S duties, one
    ramp as part of the longest possible, and S fractions of the peak pressure.

    Attributes:
        chambers: S.
        period: of all gaits [s]; where `free`, the longest, and a last number sets it.
        free: whether the period is searched too.
    """

    chambers: int
    period: float
    free: bool = False

    @property
    def size(self) -> int:
        """Number of variables."""
        return 3 * self.chambers + self.free

    @property
    def lags(self) -> int:
        """Number of periodic variables, which come first."""
        return self.chambers - 1

    def middle(self) -> Array:
        """Point to begin at: the wave of [Majidi13], at nine tenths of the pressure."""
        s = self.chambers
        lag, duty = 0.2, (0.4 - _DUTY[0]) / (_DUTY[1] - _DUTY[0])
        ramp = (0.5 - _LEAST) / (_GENTLEST - _LEAST)
        return np.array([lag] * (s - 1) + [duty] * s + [ramp] + [0.9] * s + [0.5] * self.free)

    def gait(self, point: Array, name: str = "searched") -> Gait:
        """Gait of a point; all its times and pressures are multiples of GRID."""
        s = self.chambers
        lags, rest = point[: s - 1] % 1.0, np.clip(point[s - 1 :], 0.0, 1.0)
        duties = on_grid(_DUTY[0] + (_DUTY[1] - _DUTY[0]) * rest[:s])
        room = np.minimum(duties, 1 - duties)
        ramps = on_grid((_LEAST + (_GENTLEST - _LEAST) * rest[s]) * room)
        ramps = np.clip(ramps, GRID, room)
        starts = on_grid(np.concatenate([[0.0], np.cumsum(lags)]))
        fractions = on_grid(rest[s + 1 : 2 * s + 1])
        period = self.period * SHORTEST ** float(rest[-1]) if self.free else self.period
        return staggered(starts.tolist(), duties.tolist(), ramps.tolist(), fractions.tolist(),
                         round(period, 2), name)  # fmt: skip


def on_grid(values: Array) -> Array:
    """The nearest multiples of GRID."""
    return np.round(np.round(values / GRID) * GRID, 9)
