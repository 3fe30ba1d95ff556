"""Print the answers of the benchmark of engines by two theories that share no code.

    python benchmarks/peers/engines_answers.py

`analytic`, and the least of energy and friction node by node (friction_by_area); see
docs/benchmark.md. About 10 minutes.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1])]

import limb_mechanics  # noqa: E402
from friction_by_area import Model, quadruped  # noqa: E402
from limb_mechanics import PEAK, Limb  # noqa: E402

from benchmarks.engines.specification import GRAVITY, QUADRUPED, STRIP  # noqa: E402
from benchmarks.engines.undulator_engine import scene  # noqa: E402
from mjsim.results.prediction import reference  # noqa: E402
from mjsim.scene import Numerics  # noqa: E402

FINE = (8, 15), (8, 30), (16, 15), (24, 15)  # elements of a limb, states of a ramp


def by_nodes(name, limbs, bent, stages, tip, side, length):
    """Print the least-energy walks of limbs of a natural curvature."""
    limb_mechanics.ETA, limb_mechanics.ALPHA = 0.0, bent / PEAK
    for elements, states in FINE:
        model = Model(limbs, tip, side, coulomb=True, elements=elements, wide=False)
        place, _ = model.walk(stages, states)
        print(f"{name}, {elements} elements a limb, {states} states a ramp: "
              f"{place[0] / length:+.5f}", flush=True)  # fmt: skip


def main():
    """Print all."""
    strip = STRIP.limbs[0]
    for finer in (1.0, 4.0):
        walk = reference(scene(STRIP), finer=finer)
        print(f"strip, {60 * finer:g} links: {walk.displacement[0]:+.5f}", flush=True)
    for links in (6, 12):
        walk = reference(scene(QUADRUPED), Numerics(links=links, twists=0))
        print(f"quadruped, {links} links a limb: {walk.displacement[0]:+.5f}", flush=True)
    third = strip.length / 3
    places = ((-1, True, 0.0), (0, False, np.pi), (0, True, 0.0))
    thirds = [Limb(third, strip.width, strip.mass * third, *place) for place in places]
    stages = [(middle, rear, front) for rear, middle, front in STRIP.pressed]
    by_nodes("strip", thirds, strip.bent, stages, STRIP.friction, 0.0, STRIP.length)
    stages = [(0, rear, rear, front, front) for rear, front in QUADRUPED.pressed]
    by_nodes("quadruped", quadruped(), QUADRUPED.limbs[1].bent, stages, QUADRUPED.friction,
             QUADRUPED.friction_between, QUADRUPED.length)  # fmt: skip


if __name__ == "__main__":
    print(f"gravity {GRAVITY} m/s^2")
    main()
