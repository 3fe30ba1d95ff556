"""Which optimiser: worth of the best gait after so many evaluations, by CMA-ES, scipy, by chance.

python benchmarks/optimisers.py [EVALUATIONS] [SEEDS]
"""

import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from scipy.optimize import differential_evolution

from analytic.scene.surface import SURFACES
from mjsim.optimising.objective import Objective
from mjsim.optimising.search import POPULATION, search
from mjsim.optimising.space import Space
from mjsim.scene import Scene

SPACE = Space(3, 10.0)
AIMS = {"gelatin": (SURFACES["gelatin"],)}
_WORTHLESS = 1.0


def by_cma(objective: Objective, evaluations: int, seed: int) -> float:
    return list(search(objective, SPACE, evaluations, seed))[-1].value


def by_evolution(objective: Objective, evaluations: int, seed: int) -> float:
    def cost(point: np.ndarray) -> float:
        worth = objective(SPACE.gait(point))
        return -worth if np.isfinite(worth) else _WORTHLESS

    minimum = differential_evolution(
        cost, [(0, 1)] * SPACE.size, rng=seed, popsize=2, polish=False, tol=0,
        maxiter=max(1, evaluations // (2 * SPACE.size) - 1), x0=SPACE.middle(),
    )  # fmt: skip
    return -float(minimum.fun)


def by_chance(objective: Objective, evaluations: int, seed: int) -> float:
    rng = np.random.default_rng(seed)
    return max(objective(SPACE.gait(rng.random(SPACE.size))) for _ in range(evaluations))


METHODS = {"CMA-ES": by_cma, "differential evolution": by_evolution, "chance": by_chance}


def one(job: tuple[str, str, int, int]) -> float:
    method, aim, evaluations, seed = job
    return METHODS[method](Objective(Scene(), AIMS[aim], model="lifted"), evaluations, seed)


def main(evaluations: int = 480, seeds: int = 4) -> None:
    jobs = [(m, a, evaluations, s) for a in AIMS for m in METHODS for s in range(seeds)]
    with ProcessPoolExecutor() as pool:
        bests = dict(zip(jobs, pool.map(one, jobs), strict=True))
    print(f"best worth [L a cycle] after {evaluations} evaluations, generations of {POPULATION}")
    for aim in AIMS:
        for method in METHODS:
            values = sorted(v for (m, a, *_), v in bests.items() if (m, a) == (method, aim))
            print(f"{aim:<10} {method:<24} " + " ".join(f"{v:+.4f}" for v in values))


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:]))
