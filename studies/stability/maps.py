"""Grids of outcomes: where each integrator, and each solver, still walks and where it fails."""

import itertools
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from analytic import GAITS, SURFACES, ContactShapes, Prediction, Robot, Status, predict
from analytic.scene import pneunet
from mjsim.scene import INTEGRATORS, Numerics, Scene
from studies.stability.outcome import GROUND, outcome

LINKS = tuple(range(6, 73, 6))
USUAL_LINKS = 12  # of the maps that do not vary them; chosen
LONG = 20  # cycles that a walk must last, if its first is accurate
CYCLES = {"planar": LONG, "cable": 1, "rod": 5}  # those are too slow for more everywhere


def rounded(values: np.typing.ArrayLike) -> list[float]:
    """Values of a grid with four digits."""
    return [float(f"{value:.4g}") for value in np.asarray(values)]


TIMESTEPS, STIFFNESSES = rounded(np.geomspace(0.1, 1e-3, 12)), rounded(np.geomspace(0.01, 100, 12))
GAMMAS, PRESSURES = rounded(np.geomspace(2, 60, 12)), rounded(np.linspace(12e3, 78e3, 12))


def robot_outcome(gamma: float, pressure: float) -> dict[str, Any]:
    """Outcomes of one robot on every solver.

    Args:
        gamma: load w L^3 / D0.
        pressure: the peak [Pa].

    Returns:
        elastica: "ok", or the flag of the first state that has no shape.
        planar: MuJoCo's outcome.
        sunk: greatest depth of the paper's modes below the ground, over L.
        penetrating: part of the states that lie below it.
        newton: linear systems per state that the elastica solves, where it has shapes.
        exchanges: the same of the obstacle's active set.
        unconverged: part of the states in which that gives up.
    """
    robot = pneunet.with_load(replace(Robot(), peak_pressure=pressure), gamma)
    gait, surface = GAITS["wave"], SURFACES[GROUND]
    exact, obstacle, modes = (
        predict(robot, gait, surface, solver) for solver in ("elastica", "obstacle", "modes")
    )
    _, height = modes.shapes.curve(np.linspace(0, robot.length, 121))
    failed = exact.shapes.status[exact.shapes.status != 0]
    reference = exact.locomotion.per_cycle / robot.length
    return {
        "elastica": str(Status(int(failed[0])).name).lower() if len(failed) else "ok",
        "planar": outcome(Scene(robot, gait, surface), Numerics(), reference),
        "sunk": -float(np.nanmin(height)) / robot.length,
        "penetrating": _part(modes, Status.PENETRATES),
        "newton": _iterations(exact),
        "exchanges": _iterations(obstacle),
        "unconverged": _part(obstacle, Status.NOT_CONVERGED),
    }


def _part(walk: Prediction, flag: Status) -> float:
    """Part of the states that carry a flag."""
    return float(np.mean(walk.shapes.status & int(flag) > 0))


def _iterations(walk: Prediction) -> float:
    """Mean number of linear systems of the states that have a shape."""
    shapes = walk.shapes
    assert isinstance(shapes, ContactShapes)
    return float(shapes.iterations[shapes.status == 0].mean())


def walks(body: str, quick: bool = False) -> Iterator[tuple[Any, ...]]:
    """Time step over links, and over stiffness, for each integrator; and some walks for LONG."""
    skip, links = (5, LINKS[:6:2]) if quick else (1, LINKS)
    cycles = 1 if quick else CYCLES[body]
    for integrator, timestep in itertools.product(INTEGRATORS, TIMESTEPS[::skip]):
        for n in links:
            yield body, integrator, n, timestep, 1.0, cycles
        for stiffness in STIFFNESSES[::skip]:
            yield body, integrator, USUAL_LINKS, timestep, stiffness, cycles
        if not quick:
            yield body, integrator, USUAL_LINKS, timestep, 1.0, LONG


def robots(quick: bool = False) -> Iterator[tuple[float, float]]:
    """Pressure over Gamma = w L^3 / D0."""
    skip = 4 if quick else 1
    yield from itertools.product(GAMMAS[::skip], PRESSURES[::skip])
