"""The search: CMA-ES (Hansen 2016), a generation at a time on all cores."""

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from typing import NamedTuple

import cma
import numpy as np
from numpy.typing import NDArray

from analytic.scene.gait import Gait
from mjsim.optimising.objective import Objective
from mjsim.optimising.space import Space

Array = NDArray[np.float64]

POPULATION = 16  # of a generation; chosen: a multiple of the cores
_SIGMA = 0.25  # of the unit cube, the first steps; chosen
_WORTHLESS = 1e6


class Generation(NamedTuple):
    """What a generation found.

    Attributes:
        evaluations: so far.
        best: gait of the largest worth so far.
        worth: of it.
        median: of this generation's.
    """

    evaluations: int
    best: Gait
    worth: float
    median: float


def search(
    objective: Objective,
    space: Space,
    evaluations: int,
    seed: int,
    pool: ProcessPoolExecutor | None = None,
    begin: Iterable[Array] = (),
) -> Iterator[Generation]:
    """Look for the best gait.

    Args:
        objective: what is to be large.
        space: of gaits.
        evaluations: about how many.
        seed: of the random numbers.
        pool: processes, if there are any.
        begin: points to begin at, in turn as restarts; the middle of the space if none.
    """
    worth: Callable[[Iterable[Gait]], list[float]] = (
        (lambda gaits: list(pool.map(objective, gaits)))
        if pool
        else (lambda gaits: [objective(gait) for gait in gaits])
    )
    starts = list(begin) or [space.middle()]
    best, most, done = space.gait(starts[0]), -np.inf, 0
    low = [None] * space.lags + [0.0] * (space.size - space.lags)
    high = [None] * space.lags + [1.0] * (space.size - space.lags)
    for run, start in enumerate(_for_ever(starts, space, seed)):
        found = cma.CMAEvolutionStrategy(
            start, _SIGMA,
            {"bounds": [low, high], "popsize": POPULATION, "seed": seed + run + 1, "verbose": -9,
             "tolfun": 1e-5, "tolx": 2e-3, "tolflatfitness": 5},
        )  # fmt: skip
        while not found.stop():
            points = found.ask()
            gaits = [space.gait(point, "best") for point in points]
            values = worth(gaits)
            found.tell(points, [-v if np.isfinite(v) else _WORTHLESS for v in values])
            done += len(values)
            top = int(np.argmax(values))
            if values[top] > most:
                best, most = gaits[top], values[top]
            yield Generation(done, best, most, float(np.median(values)))
            if done >= evaluations:
                return


def _for_ever(starts: list[Array], space: Space, seed: int) -> Iterator[Array]:
    """The points to begin at, then random ones."""
    yield from starts
    rng = np.random.default_rng(seed)
    while True:
        yield rng.random(space.size)
