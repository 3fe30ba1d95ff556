"""Grids of outcomes: where each integrator, and each solver, still walks and where it fails."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from analytic import GAITS, SURFACES, ContactShapes, Prediction, Robot, Status, predict
from analytic.scene import pneunet
from mjsim.scene import INTEGRATORS, Numerics, Scene
from studies.stability.outcome import GROUND, outcome, tried

LINKS = tuple(range(6, 73, 6))
TIMESTEPS = tuple(float(f"{dt:.4g}") for dt in np.geomspace(0.1, 1e-3, 12))
STIFFNESSES = tuple(float(f"{f:.4g}") for f in np.geomspace(0.01, 100, 12))
GAMMAS = tuple(float(f"{g:.4g}") for g in np.geomspace(2, 60, 12))
PRESSURES = tuple(float(f"{p:.4g}") for p in np.linspace(12e3, 78e3, 12))
USUAL_LINKS = 12  # of the maps that do not vary them; chosen
LONG = 20  # cycles that a walk must last, if its first is accurate
CYCLES = {"planar": LONG, "cable": 1, "rod": 5}  # those are too slow for more everywhere


@dataclass(frozen=True)
class Tried:
    """One walk of the default gait: its time step [s], stiffness over the default's, outcome."""

    body: str
    integrator: str
    links: int
    timestep: float
    stiffness: float
    cycles: int
    outcome: str = ""
    versions: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[str, str, int, float, float, int]:
        """What tells this walk from others."""
        return (self.body, self.integrator, self.links, self.timestep, self.stiffness,
                self.cycles)  # fmt: skip

    def done(self) -> "Tried":
        """The same with its outcome."""
        return replace(self, outcome=tried(*self.key))


@dataclass(frozen=True)
class Standing:
    """One robot on every solver, the pressure in Pa.

    Attributes:
        elastica: "ok", or the flag of the first state that has no shape.
        planar: MuJoCo's outcome.
        sunk: how far the paper's modes lie below the ground at worst, over L.
        penetrating: part of the states in which they do.
        newton: linear systems a state that the elastica solves, where it has shapes.
        exchanges: the same of the obstacle's active set.
        unconverged: part of the states in which that gives up.
        versions, commit: of what it was found with.
    """

    gamma: float
    pressure: float
    elastica: str = ""
    planar: str = ""
    sunk: float = 0.0
    penetrating: float = 0.0
    newton: float = 0.0
    exchanges: float = 0.0
    unconverged: float = 0.0
    versions: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[float, float]:
        """What tells this robot from others."""
        return self.gamma, self.pressure

    def done(self) -> "Standing":
        """The same with what became of it."""
        robot = pneunet.with_load(replace(Robot(), peak_pressure=self.pressure), self.gamma)
        gait, surface = GAITS["wave"], SURFACES[GROUND]
        exact, obstacle, modes = (
            predict(robot, gait, surface, solver) for solver in ("elastica", "obstacle", "modes")
        )
        _, height = modes.shapes.curve(np.linspace(0, robot.length, 121))
        reference = exact.locomotion.per_cycle / robot.length
        return replace(
            self,
            elastica=_first_flag(exact),
            planar=outcome(Scene(robot, gait, surface), Numerics(), reference),
            sunk=-float(np.nanmin(height)) / robot.length,
            penetrating=_part(modes, Status.PENETRATES),
            newton=_work(exact),
            exchanges=_work(obstacle),
            unconverged=_part(obstacle, Status.NOT_CONVERGED),
        )


def _first_flag(walk: Prediction) -> str:
    status = walk.shapes.status
    failed = np.flatnonzero(status)
    return Status(int(status[failed[0]])).name.lower() if len(failed) else "ok"


def _part(walk: Prediction, flag: Status) -> float:
    """Part of the states that carry a flag."""
    return float(np.mean(walk.shapes.status & int(flag) > 0))


def _work(walk: Prediction) -> float:
    """Mean number of linear systems of the states that have a shape."""
    shapes = walk.shapes
    assert isinstance(shapes, ContactShapes)
    return float(shapes.iterations[shapes.status == 0].mean())


def integrators(body: str, quick: bool = False) -> Iterator[Tried]:
    """Time step over links, and over stiffness, for each integrator; and some walks for LONG."""
    skip = 5 if quick else 1
    cycles = 1 if quick else CYCLES[body]
    for integrator in INTEGRATORS:
        for timestep in TIMESTEPS[::skip]:
            for n in LINKS[:6:2] if quick else LINKS:
                yield Tried(body, integrator, n, timestep, 1.0, cycles)
            for stiffness in STIFFNESSES[::skip]:
                yield Tried(body, integrator, USUAL_LINKS, timestep, stiffness, cycles)
            if not quick:
                yield Tried(body, integrator, USUAL_LINKS, timestep, 1.0, LONG)


def robots(quick: bool = False) -> Iterator[Standing]:
    """Pressure over Gamma = w L^3 / D0."""
    skip = 4 if quick else 1
    for gamma in GAMMAS[::skip]:
        for pressure in PRESSURES[::skip]:
            yield Standing(gamma, pressure)
