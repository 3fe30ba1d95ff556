"""A walk that goes on until it is stopped, played by its gait or by pressures from outside."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene.limbs import limbs_of, rotation
from analytic.scene.surface import Ground
from mjsim.scene import Numerics, Scene
from mjsim.simulation.observation import Observation
from mjsim.simulation.simulation import Simulation

Array = NDArray[np.float64]


class Session:
    """One robot, its valves and what it stands on.

    Args:
        scene: where it starts.
        numerics: how it is stepped.

    Attributes:
        simulation: the stepper.
        seen: observation after the last step.
        playing: whether the gait commands the valves.
        clock: how much of the gait has been played [s].
        valves: commanded pressures, (S,) [Pa].
    """

    def __init__(self, scene: Scene, numerics: Numerics) -> None:
        self.simulation = Simulation(scene, numerics, history=False)
        self._given = numerics
        self._begin()

    def _begin(self) -> None:
        self.seen: Observation = self.simulation.observe()
        self.start = self.seen.place
        self.playing, self.clock, self._owed = True, 0.0, 0.0
        self.valves = self.gait_at(0.0)

    @property
    def scene(self) -> Scene:
        """Scene that is played."""
        return self.simulation.scene

    @property
    def displacement(self) -> float:
        """Displacement of the strip's left end or the trunk's beginning, ahead over L."""
        gone = self.seen.place - self.start
        ahead = rotation(limbs_of(self.scene.robot)[0].angle)[:, 0]
        return float(gone @ ahead) / self.scene.robot.length

    def gait_at(self, time: float) -> Array:
        """Pressures that the gait commands, over and over, (S,) [Pa]."""
        gait = self.scene.gait
        (fractions,) = gait.fractions(np.array([time % gait.period]))
        return np.asarray(self.scene.robot.peak_pressure * fractions)

    def command(self, valves: ArrayLike) -> None:
        """Take the valves in hand: the gait stops where it is.

        Args:
            valves: pressures, (S,) [Pa].
        """
        self.valves = np.array(valves, dtype=float)
        self.playing = False

    def advance(self, seconds: float) -> Observation:
        """Go on for so long [s], in whole steps; the rest is made up for later."""
        dt = self.simulation.numerics.timestep
        self._owed += seconds
        for _ in range(int(self._owed / dt + 1e-9)):
            self._owed -= dt
            if self.playing:
                self.clock += dt
                self.valves = self.gait_at(self.clock)
            self.seen = self.simulation.step(self.valves)
        return self.seen

    def restart(self) -> None:
        """Begin again from rest, with the gait."""
        self.simulation.reset()
        self._begin()

    def move_to(self, ground: Ground) -> None:
        """Begin again from rest on another ground.

        Raises:
            ValueError: the scene cannot be had there.
        """
        self.simulation = Simulation(replace(self.scene, ground=ground), self._given, history=False)
        self._begin()

    def words(self) -> Sequence[tuple[str, str]]:
        """State in words, one name and one value per line."""
        gait = f"{self.scene.gait.name}, {'plays' if self.playing else 'by hand'}"
        pressures = " ".join(f"{1e-3 * p:.0f}" for p in self.seen.pressure)
        return (
            ("ground", self.scene.ground.name),
            ("gait", gait),
            ("time", f"{self.seen.time:.1f} s"),
            ("pressures", f"{pressures} kPa"),
            ("ahead", f"{self.displacement:+.4f} L"),
            ("status", str(self.seen.status)),
        )
