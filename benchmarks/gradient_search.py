"""Distance by evaluations: ascents along the gradient, and CMA-ES alone, friction at the ends.

python benchmarks/gradient_search.py [EVALUATIONS] [SEEDS]

Two to ten CPU minutes.
"""

import sys

from analytic.scene.surface import SURFACES
from mjsim.optimising.ascent import ascents
from mjsim.optimising.objective import Objective
from mjsim.optimising.search import by_strategy
from mjsim.optimising.space import Space
from mjsim.scene import Scene

SPACE = Space(3, 10.0)
AT = (32, 80, 160, 320)
CASES = {name: (surface,) for name, surface in SURFACES.items()} | {"all": tuple(SURFACES.values())}


def main(evaluations: int = 320, seeds: int = 1) -> None:
    for name, surfaces in CASES.items():
        objective = Objective(Scene(contacts="ends"), surfaces)
        count, best = 0, -1.0
        for ascent in ascents(objective, SPACE, evaluations):
            count += ascent.evaluations
            best = max(best, *ascent.values)
            print(f"{name}, by the gradient, {count} evaluations: {best:+.4f} L", flush=True)
        for seed in range(seeds):
            course = {g.evaluations: g.value
                      for g in by_strategy(objective, SPACE, evaluations, seed)}  # fmt: skip
            values = ", ".join(f"{course[at]:+.4f}" for at in AT if at in course)
            print(f"{name}, CMA-ES alone, seed {seed}: {values} L", flush=True)


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:]))
