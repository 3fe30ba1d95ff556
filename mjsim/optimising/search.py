"""Search from known gaits, by the gradient where there is one, then by CMA-ES (Hansen 2016).

Ascents from known gaits find a hill's top in few evaluations, CMA-ES the hills that none leads to.
"""

from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.gait import Gait
from mjsim.files.extras import optional
from mjsim.optimising.ascent import ascents, known_gaits
from mjsim.optimising.objective import Objective
from mjsim.optimising.space import Space
from mjsim.optimising.valve_times import within_supply

Array = NDArray[np.float64]

POPULATION = 16  # of a generation; chosen: a multiple of the cores
_SIGMA = 0.25  # of the unit cube, the first steps; chosen
_FAILED = 1e6  # loss of a gait whose objective is minus infinity


class Generation(NamedTuple):
    """Result of the known gaits, of a generation, or of an ascent along the gradient.

    Attributes:
        evaluations: number so far.
        best: gait of the largest objective so far.
        value: objective of the best gait.
        median: of the objectives of this generation.
    """

    evaluations: int
    best: Gait
    value: float
    median: float


def search(
    objective: Objective,
    space: Space,
    evaluations: int,
    seed: int,
    pool: ProcessPoolExecutor | None = None,
    begin: Iterable[Array] = (),
) -> Iterator[Generation]:
    """Look for the best gait: known ones, by the gradient if there is one, then by CMA-ES.

    Args:
        objective: to be maximised.
        space: of gaits.
        evaluations: number after which the search ends, to a generation.
        seed: of the random numbers.
        pool: processes, if there are any.
        begin: points that CMA-ES begins at, in turn as restarts; the middle of the space if none.

    Raises:
        ModuleNotFoundError: cma is not installed.
    """
    optional("cma", "the search")
    gaits = known_gaits(objective, space)[:evaluations]
    values = list((pool.map if pool else map)(objective, gaits))
    top = int(np.argmax(values))
    best = Generation(len(values), gaits[top], values[top], float(np.median(values)))
    yield best
    if objective.has_gradient:
        for ascent in ascents(objective, gaits, values, evaluations - len(values), pool):
            count, value = best.evaluations + ascent.evaluations, max(ascent.values)
            gait = best.best if best.value > value else ascent.best
            best = Generation(count, gait, max(value, best.value), float(np.median(ascent.values)))
            yield best
    left = evaluations - best.evaluations
    for generation in by_strategy(objective, space, left, seed, pool, begin) if left > 0 else ():
        count = best.evaluations + generation.evaluations
        better = generation if generation.value > best.value else best
        yield Generation(count, better.best, better.value, generation.median)


def by_strategy(
    objective: Objective,
    space: Space,
    evaluations: int,
    seed: int,
    pool: ProcessPoolExecutor | None = None,
    begin: Iterable[Array] = (),
) -> Iterator[Generation]:
    """Look for the best gait by CMA-ES alone; see search."""
    cma = optional("cma", "the search")
    evaluate = pool.map if pool else map
    starts = list(begin) or [space.middle()]
    robot, valves = objective.scene.robot, objective.scene.valves
    best, most, count = within_supply(space.gait(starts[0]), robot, valves), -np.inf, 0
    low = [None] * space.lags + [0.0] * (space.size - space.lags)
    high = [None] * space.lags + [1.0] * (space.size - space.lags)
    for run, start in enumerate(_all_starts(starts, space, seed)):
        strategy = cma.CMAEvolutionStrategy(
            start, _SIGMA,
            {"bounds": [low, high], "popsize": POPULATION, "seed": seed + run + 1, "verbose": -9,
             "tolfun": 1e-5, "tolx": 2e-3, "tolflatfitness": 5},
        )  # fmt: skip
        while not strategy.stop():
            points = strategy.ask()
            gaits = [within_supply(space.gait(point, "best"), robot, valves) for point in points]
            values = list(evaluate(objective, gaits))
            strategy.tell(points, [-v if np.isfinite(v) else _FAILED for v in values])
            count += len(values)
            top = int(np.argmax(values))
            if values[top] > most:
                best, most = gaits[top], values[top]
            yield Generation(count, best, most, float(np.median(values)))
            if count >= evaluations:
                return


def _all_starts(starts: list[Array], space: Space, seed: int) -> Iterator[Array]:
    """Points to begin at, then random ones."""
    yield from starts
    rng = np.random.default_rng(seed)
    while True:
        yield rng.random(space.size)
