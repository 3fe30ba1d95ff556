"""Gaits: closed sequences of segment pressures, joined by linear ramps (seed, Figure 3)."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Gait:
    """One cycle as stages of pressure fractions (p1, p2, ...)/p and the time between stages.

    Args:
        name: how commands and files call the gait.
        stages: fractions of the peak pressure in [0, 1], left segment first; the last stage must
            equal the first, so that cycles join.
        leg_time: duration of the linear ramp between two stages, one for all or one each [s].

    Raises:
        ValueError: fewer than two stages, stages that are not alike many fractions in [0, 1], a
            cycle that does not close, or leg times that are not positive and finite or not as many
            as legs.
    """

    name: str
    stages: tuple[tuple[float, ...], ...]
    leg_time: float | tuple[float, ...] = 2.0

    def __post_init__(self) -> None:
        if len(self.stages) < 2:
            raise ValueError(f"stages must be at least two, got {len(self.stages)}")
        for stage in self.stages:
            if not stage or not all(0 <= fraction <= 1 for fraction in stage):
                raise ValueError(f"a stage is one fraction in [0, 1] a segment, got {stage!r}")
            if len(stage) != self.segments:
                raise ValueError(f"stages must have {self.segments} fractions each, got {stage!r}")
        if self.stages[0] != self.stages[-1]:
            raise ValueError(
                f"the cycle must close: first stage {self.stages[0]!r}, last {self.stages[-1]!r}"
            )
        if len(self.leg_times) != self.legs:
            raise ValueError(f"leg_time must be one or {self.legs} times, got {self.leg_time!r}")
        for time in self.leg_times:
            if not (math.isfinite(time) and time > 0):
                raise ValueError(f"leg_time must be a positive time [s], got {time!r}")

    @property
    def segments(self) -> int:
        """Number of segments of the robots it is for."""
        return len(self.stages[0])

    @property
    def leg_times(self) -> tuple[float, ...]:
        """Duration of each ramp [s]."""
        times = self.leg_time
        return times if isinstance(times, tuple) else (times,) * self.legs

    @property
    def legs(self) -> int:
        """Number of ramps in a cycle."""
        return len(self.stages) - 1

    @property
    def period(self) -> float:
        """Duration of one cycle [s]."""
        return math.fsum(self.leg_times)

    def reversed(self) -> "Gait":
        """The same stages in reverse order."""
        times = self.leg_time
        backward = times[::-1] if isinstance(times, tuple) else times
        return Gait(f"{self.name}-reversed", self.stages[::-1], backward)

    def pressures(self, n_per_leg: int, cycles: int = 1) -> Array:
        """Fractions of the peak pressure along the gait.

        Args:
            n_per_leg: states per ramp, the ramp's end included, at least 1.
            cycles: number of cycles, at least 1.

        Returns:
            Shape (T, S) with T = cycles * legs * n_per_leg + 1; rows 0, n_per_leg, ... are stages.
        """
        if n_per_leg < 1 or cycles < 1:
            raise ValueError(
                f"n_per_leg and cycles must be at least 1, got {n_per_leg} and {cycles}"
            )
        steps = np.arange(cycles * self.legs * n_per_leg + 1) / n_per_leg
        return self._at_leg(steps)

    def fractions(self, time: Array) -> Array:
        """Fractions of the peak pressure at times since the start, shape (T,) [s] -> (T, S).

        Before the start the first stage holds; cycles repeat after it.
        """
        cycles, within = np.divmod(np.maximum(time, 0.0), self.period)
        ends = np.concatenate([[0.0], np.cumsum(self.leg_times)])
        legs = np.interp(within, ends, np.arange(self.legs + 1.0))
        return self._at_leg(cycles * self.legs + legs)

    def _at_leg(self, position: Array) -> Array:
        stages = np.array(self.stages)
        index = np.floor(position).astype(int)
        part = (position - index)[:, None]
        start = index % self.legs
        return (1 - part) * stages[start] + part * stages[start + 1]


# Figure 3 is lost. "wave" is the assumption every published number of this project rests on: the
# wave runs through the segments in order, with the two neighbours inflated together in between,
# as the contact sequence of section 4 demands. The others bracket it.
_WAVE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1), (0, 0, 1), (0, 0, 0))
_FULL_WAVE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1), (0, 0, 1), (0, 0, 0))
_PULSE = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0))

GAITS: dict[str, Gait] = {
    gait.name: gait
    for gait in (Gait("wave", _WAVE), Gait("full-wave", _FULL_WAVE), Gait("pulse", _PULSE))
}
