"""Distance by evaluations: ascents along the gradient, and CMA-ES alone, friction at the ends.

python benchmarks/gradient_search.py [EVALUATIONS] [SEEDS]

Two to ten CPU minutes.
"""

import sys

from analytic.scene.surface import SURFACES
from mjsim.optimising.ascent import ascents, known_gaits
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
        gaits = known_gaits(objective, SPACE)[:evaluations]
        values = list(map(objective, gaits))
        count, best = len(values), max(values)
        print(f"{name}, known gaits, {count} evaluations: {best:+.4f} L", flush=True)
        for ascent in ascents(objective, gaits, values, evaluations - count):
            count += ascent.evaluations
            best = max(best, *ascent.values)
            print(f"{name}, by the gradient, {count} evaluations: {best:+.4f} L", flush=True)
        for seed in range(seeds):
            course = {g.evaluations: g.value
                      for g in by_strategy(objective, SPACE, evaluations, seed)}  # fmt: skip
            shown = ", ".join(f"{course[at]:+.4f}" for at in AT if at in course)
            print(f"{name}, CMA-ES alone, seed {seed}: {shown} L", flush=True)


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:]))
