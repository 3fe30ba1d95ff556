"""Gaits: closed sequences of segment pressures, joined by linear ramps ([Majidi13], Figure 3)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from analytic.checks import file_word, is_number, positive
from analytic.units import in_unit

Array = NDArray[np.float64]

_ROUNDING = 1e-9
_HARDLY = 0.2  # of the peak: the ends of the paper's strip arch over half its length; chosen
_MUCH, _FINE = 0.5, 10  # change over the peak; states of a ramp to see it by; chosen


@dataclass(frozen=True)
class Gait:
    """One cycle as stages of pressure fractions (p1, p2, ...)/p and the time between stages.

    Args:
        name: how commands and files call the gait.
        stages: fractions of the peak pressure in [-1, 1], left segment first; the last stage must
            equal the first, so that cycles join. Below 0 the pressure is on a segment's other face
            and curls it up.
        ramp_time: duration of the linear ramp between two stages, one for all or one each [s].
        repeats: whether it is a cycle; one that is not, such as a measured series, need not close,
            and holds its last stage after its end.

    Raises:
        ValueError: fewer than two stages, stages that are not alike many fractions in [-1, 1], a
            cycle that does not close, or ramp times that are not positive and finite or not as many
            as ramps.
    """

    name: str
    stages: tuple[tuple[float, ...], ...]
    ramp_time: float | tuple[float, ...] = 2.0
    repeats: bool = True

    def __post_init__(self) -> None:
        file_word("name of a gait", self.name)
        object.__setattr__(self, "stages", tuple(tuple(stage) for stage in self.stages))
        times = self.ramp_time
        if isinstance(times, str):
            times = in_unit("ramp_time", times, "s")
        elif isinstance(times, Sequence):
            times = tuple(in_unit("ramp_time", t, "s") if isinstance(t, str) else t for t in times)
        object.__setattr__(self, "ramp_time", times)
        if len(self.stages) < 2:
            raise ValueError(f"stages must be at least two, got {len(self.stages)}")
        for stage in self.stages:
            if not stage or not all(is_number(f) and -1 <= f <= 1 for f in stage):
                raise ValueError(f"stages must be fractions in [-1, 1], got {stage!r}")
            if len(stage) != self.segments:
                raise ValueError(f"stages must have {self.segments} fractions each, got {stage!r}")
        if self.repeats and self.stages[0] != self.stages[-1]:
            raise ValueError(
                f"stages must close the cycle: first {self.stages[0]!r}, last {self.stages[-1]!r}"
            )
        if len(self.ramp_times) != self.ramps:
            raise ValueError(f"ramp_time must be one or {self.ramps} times, got {self.ramp_time!r}")
        for time in self.ramp_times:
            positive("ramp_time", time, "s")

    @property
    def segments(self) -> int:
        """Number of segments of the robots it is for."""
        return len(self.stages[0])

    @property
    def ramp_times(self) -> tuple[float, ...]:
        """Duration of each ramp [s]."""
        times = self.ramp_time
        return times if isinstance(times, tuple) else (times,) * self.ramps

    @property
    def ramps(self) -> int:
        """Number of ramps in a cycle."""
        return len(self.stages) - 1

    @property
    def period(self) -> float:
        """Duration of one cycle [s]."""
        return math.fsum(self.ramp_times)

    def reversed(self) -> "Gait":
        """Gait of the same stages in reverse order."""
        times = self.ramp_time
        backward = times[::-1] if isinstance(times, tuple) else times
        return Gait(f"{self.name}-reversed", self.stages[::-1], backward, self.repeats)

    def dips(self) -> bool:
        """Tell whether a segment is ever inflated less than one on either side of it.

        Then the strip may come down to the ground between its ends.
        """
        fractions = self.pressures(4)
        before = np.maximum.accumulate(fractions, axis=1)[:, :-2]
        after = np.maximum.accumulate(fractions[:, ::-1], axis=1)[:, ::-1][:, 2:]
        return bool((fractions[:, 1:-1] < np.minimum(before, after)).any())

    def lingers(self) -> bool:
        """Tell whether an end stays nearly empty while another segment changes by half the peak.

        Then the strip may lie flat behind that end.
        """
        fractions = np.abs(self.pressures(_FINE))
        steps = np.abs(np.diff(fractions, axis=0))
        for end in (0, -1):
            middle = 0.5 * (fractions[1:, end] + fractions[:-1, end])
            low = (middle > 0) & (middle < _HARDLY)
            if np.delete(steps[low], end, axis=1).sum(axis=0).max(initial=0.0) >= _MUCH:
                return True
        return False

    def between(self) -> bool:
        """Tell whether the gait may bring the strip to the ground between its ends."""
        return self.dips() or self.lingers()

    def pressures(self, states_per_ramp: int, cycles: int = 1) -> Array:
        """Fractions of the peak pressure along the gait.

        Args:
            states_per_ramp: states per ramp, the ramp's end included, at least 1.
            cycles: number of cycles, at least 1.

        Returns:
            Shape (T, S), T = cycles * ramps * states_per_ramp + 1; every states_per_ramp-th row is
            a stage.
        """
        if states_per_ramp < 1 or cycles < 1:
            raise ValueError(
                f"states_per_ramp and cycles must be at least 1, got {states_per_ramp} and {cycles}"
            )
        steps = np.arange(cycles * self.ramps * states_per_ramp + 1) / states_per_ramp
        return self._at_ramp(steps)

    def path(self, states: int, cycles: int = 1) -> tuple[Array, Array]:
        """Fractions of the peak pressure along the gait, as dense as the pressures change.

        Args:
            states: of a change by the peak pressure, at least 1.
            cycles: number of cycles, at least 1.

        Returns:
            Fractions, shape (T, S), and their times, (T,) [s]. A ramp has one state at least.
        """
        most = np.abs(np.diff(np.array(self.stages), axis=0)).max(axis=1)
        counts = np.tile(np.maximum(np.ceil(states * most - _ROUNDING), 1).astype(int), cycles)
        ramp = np.repeat(np.arange(len(counts)), counts)
        within = np.arange(1, len(ramp) + 1) - np.repeat(np.cumsum(counts) - counts, counts)
        steps = np.append(0.0, (ramp * counts[ramp] + within) / counts[ramp])
        return self._at_ramp(steps), self._time_of(steps, cycles)

    def times(self, states_per_ramp: int, cycles: int = 1) -> Array:
        """When `pressures` has its rows, shape (T,) [s]."""
        steps = np.arange(cycles * self.ramps * states_per_ramp + 1) / states_per_ramp
        return self._time_of(steps, cycles)

    def _time_of(self, steps: Array, cycles: int) -> Array:
        ends = np.concatenate([[0.0], np.cumsum(self.ramp_times * cycles)])
        return np.interp(steps, np.arange(len(ends)), ends)

    def fractions(self, time: Array) -> Array:
        """Fractions of the peak pressure at times since the start, shape (T,) [s] -> (T, S).

        Before the start the first stage holds; cycles repeat after it.
        """
        if not self.repeats:
            time = np.minimum(time, self.period)
        cycles, within = np.divmod(np.maximum(time, 0.0), self.period)
        ends = np.concatenate([[0.0], np.cumsum(self.ramp_times)])
        ramps = np.interp(within, ends, np.arange(self.ramps + 1.0))
        return self._at_ramp(cycles * self.ramps + ramps)

    def _at_ramp(self, position: Array) -> Array:
        stages = np.array(self.stages)
        index = np.floor(position).astype(int)
        part = (position - index)[:, None]
        start = index % self.ramps
        if not self.repeats:  # the end is the end of the last ramp, not the start of the first
            ended = index >= self.ramps
            start, part = np.where(ended, self.ramps - 1, start), np.where(ended[:, None], 1, part)
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
