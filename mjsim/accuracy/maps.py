"""Grids of outcomes: where each integrator, and each rung, still walks and where it fails."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from analytic import GAITS, SURFACES, Robot, pneunet, predict
from mjsim.accuracy.outcome import GROUND, outcome, tried
from mjsim.config import Numerics, Scene

MAPPED = ("discrete", "Euler", "implicitfast", "RK4")
LINKS = (6, 12, 18, 24, 30, 36, 42, 48, 60, 72, 84, 96)
TIMESTEPS = tuple(float(f"{dt:.4g}") for dt in np.geomspace(5e-4, 0.1, 12))
STIFFNESSES = tuple(float(f"{f:.4g}") for f in np.geomspace(0.01, 100, 12))
GAMMAS = tuple(float(f"{g:.4g}") for g in np.geomspace(2, 60, 12))
PRESSURES = tuple(float(f"{p:.4g}") for p in np.linspace(12e3, 78e3, 12))
USUAL_LINKS = 12  # of the maps that do not vary them; chosen


@dataclass(frozen=True)
class Tried:
    """One walk of the default gait: its time step [s], stiffness over the default's, outcome."""

    integrator: str
    links: int
    timestep: float
    stiffness: float
    cycles: int
    outcome: str = ""
    versions: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[str, int, float, float, int]:
        """What tells this walk from others."""
        return self.integrator, self.links, self.timestep, self.stiffness, self.cycles

    def done(self) -> "Tried":
        """The same with its outcome."""
        return replace(self, outcome=tried(*self.key))


@dataclass(frozen=True)
class Standing:
    """One robot on every rung, the pressure in Pa.

    Attributes:
        elastica: "ok", or the flag where its stable branch ends.
        planar: MuJoCo's outcome.
        sunk: how far the seed's modes lie below the ground at worst, over L.
        versions, commit: of what it was found with.
    """

    gamma: float
    pressure: float
    elastica: str = ""
    planar: str = ""
    sunk: float = 0.0
    versions: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[float, float]:
        """What tells this robot from others."""
        return self.gamma, self.pressure

    def done(self) -> "Standing":
        """The same with what became of it."""
        base = Robot()
        unit = pneunet.base_rigidity(base) / base.length**3
        robot = replace(base, weight_per_length=self.gamma * unit, peak_pressure=self.pressure)
        gait, surface = GAITS["wave"], SURFACES[GROUND]
        exact = predict(robot, gait, surface)
        modes = predict(robot, gait, surface, "modes").shapes
        _, height = modes.curve(np.linspace(0, robot.length, 121))
        reference = exact.locomotion.per_cycle / robot.length
        found = outcome(Scene(robot, gait, surface), Numerics(), reference)
        known = not exact.flags
        return replace(
            self,
            elastica="ok" if known else "+".join(f.name.lower() for f in exact.flags if f.name),
            planar=found,
            sunk=-float(np.nanmin(height)) / robot.length,
        )


def integrators(quick: bool = False, cycles: int = 3) -> Iterator[Tried]:
    """Time step over links, and over stiffness, for each integrator."""
    skip = 5 if quick else 1
    for integrator in MAPPED:
        for timestep in TIMESTEPS[::-1][::skip]:
            for links in LINKS[:6:2] if quick else LINKS:
                yield Tried(integrator, links, timestep, 1.0, cycles)
            for stiffness in STIFFNESSES[::skip]:
                yield Tried(integrator, USUAL_LINKS, timestep, stiffness, cycles)


def robots(quick: bool = False) -> Iterator[Standing]:
    """Pressure over Gamma = w L^3 / D0."""
    skip = 4 if quick else 1
    for gamma in GAMMAS[::skip]:
        for pressure in PRESSURES[::skip]:
            yield Standing(gamma, pressure)
