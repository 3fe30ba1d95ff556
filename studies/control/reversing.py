"""A controller that changes its gait when it does not go forward any more.

[Majidi13]: crossing from felt to gelatin the robot must reverse its sequence to keep going forward.
It senses its displacement in each cycle, and nothing of the ground. A cumulative sum (Page 1954) of
the shortfall from the least progress shows when noise no longer explains it; then the next gait is
tried.

To reverse is not enough. Where it stands across a seam, a gait backwards goes as far back as it
goes forward (the states are the same in opposite order): where the one stalls, so does the other,
and no map helps. A third gait, which stalls elsewhere, carries it over: see `REPERTOIRE`.
"""

import math
from collections.abc import Sequence

import numpy as np

from analytic.checks import not_negative, positive
from analytic.scene.gait import GAITS, Gait
from analytic.scene.robot import Robot
from mjsim.simulation.observation import Observation
from studies import Array

LEAST = 0.0025  # progress a cycle over L that counts as going forward; chosen
_PATIENCE = 3.0  # cycles without any, before it changes; chosen
_NOISES = 4.0  # standard deviations that may be missing; chosen
_ROUNDING = 1e-9

# forward on felt; over the seam; forward on gelatin; over the seam
REPERTOIRE = (GAITS["wave"], GAITS["pulse"], GAITS["wave"].reversed(), GAITS["pulse"])


class Chooser:
    """Decides after each cycle whether to go on or to try the next gait.

    Args:
        gaits: number of gaits, tried in turn.
        noise: standard deviation of the sensed displacement per cycle over L.
        least: progress per cycle over L that counts as going forward.
        seed: of the noise.

    Raises:
        ValueError: a value is out of its range.

    Attributes:
        choice: place of the gait of the next cycle.
        changes: number of changes.
        sensed: displacements per cycle over L, with their noise.
    """

    def __init__(self, gaits: int, noise: float = 0.0, least: float = LEAST, seed: int = 0) -> None:
        not_negative("noise", noise)
        positive("least", least)
        self._gaits, self._least, self._noise = gaits, least, noise
        self._limit = max(_PATIENCE * least, _NOISES * noise)
        self._missing = 0.0
        self._rng = np.random.default_rng(seed)
        self.choice = self.changes = 0
        self.sensed: list[float] = []

    def after_cycle(self, displacement: float) -> int:
        """The next cycle's gait, after one of a sensed displacement over L."""
        self._missing = max(0.0, self._missing + self._least - displacement)
        if self._missing >= self._limit * (1 - _ROUNDING):
            self.choice, self._missing = (self.choice + 1) % self._gaits, 0.0
            self.changes += 1
        return self.choice

    def sense(self, displacement: float) -> int:
        """The next cycle's gait, after one of a true displacement over L."""
        self.sensed.append(displacement + self._noise * float(self._rng.standard_normal()))
        return self.after_cycle(self.sensed[-1])


class Reversing:
    """The controller as a policy of mjsim.Simulation.

    Args:
        robot: of the walk.
        timestep: of the simulation [s].
        gaits: tried in turn; all begin and end without pressure.
        noise: standard deviation of the sensed displacement per cycle over L.
        seed: of that noise.

    Raises:
        ValueError: the gaits are not of that kind.

    Attributes:
        chooser: the controller.
        chosen: place of the gait of each cycle.
    """

    def __init__(
        self,
        robot: Robot,
        timestep: float,
        gaits: Sequence[Gait] = REPERTOIRE,
        noise: float = 0.0,
        seed: int = 0,
    ) -> None:
        check_gaits(gaits)
        self.chooser = Chooser(len(gaits), noise, seed=seed)
        self.chosen: list[int] = [0]
        self._robot, self._timestep, self._gaits = robot, timestep, gaits
        self._period = max(gait.period for gait in gaits)
        self._start: float | None = None  # of the left end in this cycle, m

    def __call__(self, seen: Observation) -> Array:
        """Pressures for the next step, (S,) [Pa]."""
        if self._start is None:
            self._start = seen.left
        if seen.time >= len(self.chosen) * self._period - _ROUNDING:
            moved = (seen.left - self._start) / self._robot.length
            self.chosen.append(self.chooser.sense(moved))
            self._start = seen.left
        within = seen.time + self._timestep - (len(self.chosen) - 1) * self._period
        gait = self._gaits[self.chosen[-1]]
        # a gait that is shorter takes as long as the others
        at = math.fmod(within, self._period) * gait.period / self._period
        return np.asarray(self._robot.peak_pressure * gait.fractions(np.array([at]))[0])


def check_gaits(gaits: Sequence[Gait]) -> None:
    """Raise ValueError unless gaits can follow each other."""
    if not gaits:
        raise ValueError("gaits must be one at least, got none")
    for gait in gaits:
        if any(gait.stages[0]) or not gait.repeats:
            raise ValueError(f"gait {gait.name!r} must begin and end without pressure")
