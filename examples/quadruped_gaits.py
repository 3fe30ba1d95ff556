"""Gaits of the quadruped by search: crawling by one leg at a time, and turning on the spot.

    python examples/quadruped_gaits.py [SURFACE ...]

Crawling: every order of the four legs, each pressed alone, the torso with some of them or not.
Turning: an undulation with one side pressed less, then its mirror image backwards, which turns it
again and takes it back; over undulations and parts of the pressure. A robot that stands on two
limbs may rock, which coarse steps make a long walk of: it does not count.
"""

import sys
from itertools import permutations, product

import numpy as np

from analytic.scene.gait import Gait
from analytic.scene.limbs import ORDER, quadruped
from analytic.scene.quadruped_gaits import UNDULATIONS, on_the_spot
from analytic.scene.surface import SURFACES
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

NUMERICS = Numerics(timestep=0.02, twists=0)  # by which the order of the crawl was chosen
RAMP = 8.0  # s
PARTS = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7)


def walked(gait: Gait, surface: str) -> tuple[float, float]:
    """Displacement over L, ahead, and turn to the left in degrees; NaN if it fell or rocked."""
    scene = Scene(quadruped(), gait=gait, ground=SURFACES[surface])
    walk = simulate(scene, NUMERICS)
    numbers = measure(walk)
    if numbers is None or walk.contacts.min() < 3:
        return float("nan"), float("nan")
    return numbers.displacement, float(np.degrees(numbers.turn))


def crawls() -> list[Gait]:
    """One leg after the other, in every order but for mirror images; the torso with some."""
    legs, gaits = ORDER[1:], []
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
            gaits.append(Gait("crawl", tuple(map(tuple, rows)), RAMP))
    return gaits


def spins() -> list[Gait]:
    """Turns on the spot."""
    return [on_the_spot(name, part, RAMP) for name in UNDULATIONS for part in PARTS]


def main(surfaces: tuple[str, ...] = tuple(SURFACES), most: int | None = None):
    """Print and return the gaits that go farthest and turn most, with what they do."""
    best_gaits = {}
    for surface in surfaces:
        for kind, gaits in (("crawls", crawls()[:most]), ("turns", spins()[:most])):
            went = np.array([walked(gait, surface) for gait in gaits])
            most_of = np.abs(went[:, 0 if kind == "crawls" else 1])
            best = int(np.argmax(np.nan_to_num(most_of, nan=-1.0)))
            ahead, turn = went[best]
            print(f"{surface}: {kind}, {ahead:+.4f} L ahead and {turn:+.2f} degrees, by "
                  f"{gaits[best].name}", *gaits[best].stages, sep="\n  ", flush=True)  # fmt: skip
            best_gaits[surface, kind] = gaits[best], ahead, turn
    return best_gaits


if __name__ == "__main__":
    main(tuple(sys.argv[1:]) or tuple(SURFACES))
