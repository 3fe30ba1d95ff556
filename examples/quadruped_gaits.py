"""Gaits of the quadruped by search: crawling by one leg at a time, and turning on the spot.

    python examples/quadruped_gaits.py [SURFACE]

Crawling: every order of the four legs, each pressed alone, the torso with some of them or not.
Turning: when each limb is pressed and let go, by CMA-ES, for the most turn that does not walk. A
robot that stands on two limbs may rock, which coarse steps make a long walk of: it does not count.
"""

import sys
from dataclasses import replace
from itertools import permutations, product

import cma
import numpy as np

from analytic.gait import Gait
from analytic.surface import SURFACES
from analytic.tree.limbs import ORDER
from mjsim.tree.scene import TreeNumerics, TreeScene
from mjsim.tree.simulation import simulate

NUMERICS = TreeNumerics(timestep=0.02, elements=4)
FINE = TreeNumerics(timestep=0.01, elements=4)
RAMP = 8.0  # s
PERIOD, PARTS = 48.0, 24  # s, ramps of a turning gait
WALKING = 60.0  # degrees that a length of walking costs a turn


def walked(gait: Gait, surface: str, numerics: TreeNumerics = NUMERICS) -> tuple[float, float]:
    """Displacement ahead over L and turn to the left in degrees; NaN if it fell or rocked."""
    walk = simulate(TreeScene(gait=gait, ground=SURFACES[surface]), numerics)
    if walk.status != "ok" or walk.contacts.min() < 3:
        return float("nan"), float("nan")
    return float(walk.displacement[0] / walk.length), float(np.degrees(walk.turn))


def crawls() -> list[Gait]:
    """One leg after the other, in every order but for mirror images; the torso with some."""
    legs, found = ORDER[1:], []
    for order in permutations(legs):
        if not order[0].endswith("left"):
            continue
        for torso in product((0.0, 1.0), repeat=3):
            rows = [[0.0] * 5]
            # the torso is pressed between one leg and the next
            for place, leg in enumerate(order):
                row = [0.0] * 5
                row[ORDER.index(leg)] = 1.0
                rows.append(row)
                if place < 3 and torso[place]:
                    rows.append([1.0, *row[1:]])
            rows.append([0.0] * 5)
            found.append(Gait("crawl", tuple(map(tuple, rows)), RAMP))
    return found


def pressed(when: np.ndarray) -> Gait:
    """Each limb from a time to another, both parts of the cycle, softly."""
    begin, last = np.sort(np.clip(when.reshape(5, 2), 0.08, 0.92), axis=1).T
    time = np.linspace(0, 1, PARTS + 1)[:, None]
    rise = np.clip((time - begin + 0.06) / 0.12, 0, 1)
    fall = np.clip((last + 0.06 - time) / 0.12, 0, 1)
    rows = np.round(np.minimum(rise, fall) * (last - begin > 0.1), 3)
    rows[[0, -1]] = 0.0
    return Gait("spin", tuple(map(tuple, rows.tolist())), PERIOD / PARTS)


def crawl(surface: str, most: int | None = None) -> tuple[Gait, float]:
    """The crawl that goes farthest, either way, and how far over L."""
    best, far = crawls()[0], 0.0
    for gait in crawls()[:most]:
        ahead, _ = walked(gait, surface)
        if abs(ahead) > abs(far):
            best, far = gait, ahead
    return best, far


def spin(surface: str, evaluations: int = 150, seed: int = 1) -> tuple[Gait, float, float]:
    """A gait that turns it, how far it goes ahead over L, and the turn in degrees."""
    start = np.array([0.2, 0.6, 0.1, 0.4, 0.3, 0.7, 0.4, 0.8, 0.1, 0.5])
    search = cma.CMAEvolutionStrategy(
        start, 0.2, {"bounds": [0, 1], "maxfevals": evaluations, "seed": seed, "verbose": -9}
    )
    best, cost = start, 0.0
    while not search.stop():
        asked = search.ask()
        costs = []
        for when in asked:
            ahead, turn = walked(pressed(when), surface, FINE)
            value = WALKING * abs(ahead) - abs(turn)
            costs.append(value if np.isfinite(value) else 10.0)
            if costs[-1] < cost:
                best, cost = when, costs[-1]
        search.tell(asked, costs)
    gait = pressed(best)
    return gait, *walked(gait, surface, FINE)


def main(surfaces: tuple[str, ...] = tuple(SURFACES), most: int | None = None, spins: int = 150):
    """Print the gaits found."""
    found = {}
    for surface in surfaces:
        gait, far = crawl(surface, most)
        print(f"{surface}: crawls {far:+.4f} L by", gait.stages, flush=True)
        spun, ahead, turn = spin(surface, spins)
        print(f"{surface}: turns {turn:+.2f} degrees, {ahead:+.4f} L ahead, by", flush=True)
        print(replace(spun, name=f"spin-{surface}").stages, flush=True)
        found[surface] = far, ahead, turn
    return found


if __name__ == "__main__":
    main(tuple(sys.argv[1:]) or tuple(SURFACES))
