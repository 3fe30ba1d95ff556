"""Grids of outcomes: where each integrator, and each solver, still walks and where it fails.

Outcomes: accurate, within NEAR of the reference's displacement; drifting, finite but farther off;
wrong, the opposite way by more than a standstill; toppled, an end left the ground; diverged;
finished, where there is no reference to be near to.
"""

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from analytic import GAITS, SURFACES, ContactShapes, Flag, Prediction, Robot, direction, predict
from analytic.scene import pneunet
from mjsim.results.measures import measure
from mjsim.results.prediction import displacement, prediction
from mjsim.results.status import Status
from mjsim.scene import INTEGRATORS, Numerics, Scene
from mjsim.simulation.simulation import simulate
from studies.accuracy.benchmark_cases import WALK, exact
from studies.accuracy.setting import Setting

OUTCOMES = ("accurate", "drifting", "wrong direction", "toppled", "diverged", "finished")
NEAR = 0.05  # relative error of an accurate displacement; chosen
GROUND = "gelatin"
LINKS = (6, 12, 18, 24, 36, 48, 60, 72)
SOME_LINKS = (6, 12, 24, 48)  # of bodies that are too slow for more
USUAL_LINKS = 12  # of the maps that do not vary them; chosen
LONG = 20  # cycles that a walk must last, if its first is accurate
CYCLES = {"chain": 5, "cable": 1, "rod": 1}  # everywhere; too slow for LONG


def rounded(values: np.typing.ArrayLike) -> list[float]:
    """Values of a grid with four digits."""
    return [float(f"{value:.4g}") for value in np.asarray(values)]


TIMESTEPS, STIFFNESSES = rounded(np.geomspace(0.1, 1e-3, 9)), rounded(np.geomspace(0.01, 100, 9))
GAMMAS, PRESSURES = rounded(np.geomspace(2, 60, 12)), rounded(np.linspace(12e3, 78e3, 12))


def outcome(scene: Scene, numerics: Numerics, reference: float) -> str:
    """Walk a scene; returns one of OUTCOMES.

    Args:
        scene, numerics: the walk.
        reference: the displacement per cycle over L that it should have, NaN if there is none.
    """
    walk = simulate(scene, numerics)
    numbers = measure(walk)
    if walk.status is Status.UNSETTLED:
        return "drifting"
    if numbers is None:
        return "diverged" if walk.status is Status.DIVERGED else "toppled"
    if math.isnan(reference):
        return "finished"
    if abs(numbers.displacement / reference - 1) <= NEAR:
        return "accurate"
    directions = {direction(numbers.displacement, 1.0), direction(reference, 1.0)}
    return "wrong direction" if directions == {"forward", "backward"} else "drifting"


def walked(
    body: str, integrator: str, links: int, timestep: float, stiffness: float = 1.0, cycles: int = 1
) -> dict[str, str]:
    """Outcome of the default gait on gelatin, of a strip so many times as stiff.

    A walk whose first cycle is not accurate does not go on.
    """
    numerics = Setting(body, links, timestep, integrator).numerics()
    scene, reference = replace(stiffened(stiffness), body=body), exact(WALK, GROUND)
    name = outcome(scene, numerics, reference)
    if name == "accurate" and cycles > 1:
        name = outcome(replace(scene, cycles=cycles), numerics, reference)
    return {"outcome": name}


def stiffened(stiffness: float) -> Scene:
    """The benchmark scene on GROUND with a strip so many times as stiff, of the same mass.

    Stiffness scales the modulus, the pressure and the weight, but not the mass: the shapes stay,
    and with them the reference, while the strip's frequencies rise with its square root.
    """
    base = Robot()
    scaled = {name: stiffness * getattr(base, name)
              for name in ("modulus", "peak_pressure", "weight_per_length")}  # fmt: skip
    return Scene(replace(base, **scaled), ground=SURFACES[GROUND],
                 gravity=stiffness * Scene.gravity)  # fmt: skip


def robot_outcome(gamma: float, pressure: float) -> dict[str, Any]:
    """Outcomes of one robot on every solver; those of MuJoCo against the elastica that is bent.

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
    scene = Scene(robot, gait, surface)
    exact, obstacle, modes = (
        predict(robot, gait, surface, solver) for solver in ("elastica", "obstacle", "modes")
    )
    _, height = modes.shapes.curve(np.linspace(0, robot.length, 121))
    failed = exact.shapes.status[exact.shapes.status != 0]
    bent = displacement(scene, prediction(scene))  # by the friction that bends it in MuJoCo too
    return {
        "elastica": str(Flag(int(failed[0])).name).lower() if len(failed) else "ok",
        "chain": outcome(scene, Numerics(), bent),
        "sunk": -float(np.nanmin(height)) / robot.length,
        "penetrating": _part(modes, Flag.PENETRATES),
        "newton": _iterations(exact),
        "exchanges": _iterations(obstacle),
        "unconverged": _part(obstacle, Flag.NOT_CONVERGED),
    }


def _part(walk: Prediction, flag: Flag) -> float:
    """Part of the states that carry a flag."""
    return float(np.mean(walk.shapes.status & int(flag) > 0))


def _iterations(walk: Prediction) -> float:
    """Mean number of linear systems of the states that have a shape."""
    shapes = walk.shapes
    assert isinstance(shapes, ContactShapes)
    return float(shapes.iterations[shapes.status == 0].mean())


def walks(body: str, quick: bool = False) -> Iterator[tuple[Any, ...]]:
    """Time step over links, and over stiffness, for each integrator; and some walks for LONG."""
    skip, links = (1, list(LINKS)) if body == "chain" else (2, list(SOME_LINKS))
    if quick:
        skip, links = 5, list(LINKS[:6:2])
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
