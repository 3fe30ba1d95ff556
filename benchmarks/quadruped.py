"""The quadruped in MuJoCo against the quasi-static reference, on random scenes.

    python benchmarks/quadruped.py [SCENES [TWISTS]]

Pressures of torso and legs, sides and ends unlike, gait and its order, ground and friction law are
drawn; 8 s a ramp. Prints a line a scene and how many agree within 5 % or 0.004 L and within 5 % or
0.5 degrees; then what half the links and a third of the step change. Limbs twist as they do by
default, or at so many places.
"""

import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from analytic.scene.gait import Gait
from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import UNDULATIONS, undulation
from analytic.scene.surface import SHEAR_STRENGTH, SURFACES, TIP_FORCE, Surface
from mjsim.results.measures import measure
from mjsim.results.prediction import HALF, error_bars, reference
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

NUMERICS = Numerics(timestep=0.03)
FINE = Numerics(timestep=0.01, links=12)
RAMP = 8.0  # s
WITHIN, WITHIN_LENGTH, WITHIN_TURN = 0.05, 0.004, 0.5  # relative, L, degrees


class Outcome(NamedTuple):
    """One scene: displacement over L and turn in degrees, by MuJoCo, finer, and by theory."""

    name: str
    walked: np.ndarray
    finer: np.ndarray
    predicted: np.ndarray
    unsure: np.ndarray
    status: str
    real_time: float

    def agrees(self) -> tuple[bool, bool]:
        """Agreement in displacement and in turn."""
        off = np.hypot(*(self.walked - self.predicted)[:2])
        far = np.hypot(*self.predicted[:2])
        turned = abs(self.walked[2] - self.predicted[2])
        return (
            bool(off <= max(WITHIN * far, WITHIN_LENGTH)),
            bool(turned <= max(WITHIN * abs(self.predicted[2]), WITHIN_TURN)),
        )


def draw(seed: int) -> Scene:
    """A random scene."""
    rng = np.random.default_rng(seed)
    left, right = rng.uniform(0.5, 1.0, 2) if rng.random() < 0.6 else (1.0, 1.0)
    gait = undulation(str(rng.choice(UNDULATIONS)), float(left), float(right))
    torso, rear, front = rng.uniform(0.6, 1.0, 3)
    parts = np.array([torso, rear, rear, front, front])
    stages = tuple(map(tuple, (np.array(gait.stages) * parts).tolist()))
    gait = Gait(gait.name, stages, RAMP)
    if rng.random() < 0.5:
        gait = gait.reversed()
    names = list(SURFACES)
    ground = SURFACES[str(rng.choice(names))]
    if rng.random() < 0.5:
        tip, side = rng.uniform(0.1, 1.0, 2)
        ground = Surface("random", tip * TIP_FORCE, side * SHEAR_STRENGTH,
                         side * 0.37, tip * 0.37)  # fmt: skip
    law = "coulomb" if rng.random() < 0.5 else "constant"
    return Scene(quadruped(), gait=gait, ground=ground, friction=law)


def _numbers(walk: Trajectory) -> np.ndarray:
    numbers = measure(walk)
    if numbers is None:
        return np.full(3, np.nan)
    return np.array([numbers.displacement, numbers.aside, np.degrees(numbers.turn)])


def compare(seed: int, twists: int | None = None) -> Outcome:
    """Walk a scene by both."""
    scene, usual = draw(seed), replace(NUMERICS, twists=twists)
    walk, fine = simulate(scene, usual), simulate(scene, replace(FINE, twists=twists))
    theory = reference(scene, usual)
    bar, turn_bar = error_bars(scene, theory, reference(scene, usual, finer=HALF))
    ground = scene.ground
    return Outcome(
        f"{seed:3d} {scene.gait.name:28s} {ground.name:12s} {scene.friction:8s}",
        _numbers(walk),
        _numbers(fine),
        np.array([*theory.displacement, np.degrees(theory.turn)]),
        np.array([bar, np.degrees(turn_bar)]),
        " ".join([str(walk.status), *theory.flags]),
        scene.duration / walk.wall_time,
    )


def main(count: int, twists: int | None = None) -> None:
    """Print the table."""
    with ProcessPoolExecutor(2) as pool:
        comparisons = []
        for one in pool.map(partial(compare, twists=twists), range(count)):
            comparisons.append(one)
            good = "".join("." if ok else "X" for ok in one.agrees())
            print(one.name, *(np.array2string(v, precision=4, suppress_small=True, sign="+")
                              for v in (one.walked, one.predicted, one.unsure, one.finer)),
                  one.status, f"{one.real_time:.0f}x", good, flush=True)  # fmt: skip
    both = np.array([one.agrees() for one in comparisons])
    print(f"displacement {both[:, 0].mean():.0%}, turn {both[:, 1].mean():.0%}, "
          f"both {both.all(axis=1).mean():.0%} of {count}")  # fmt: skip
    changed = np.array([np.hypot(*(one.finer - one.walked)[:2]) for one in comparisons])
    far = np.array([np.hypot(*one.walked[:2]) for one in comparisons])
    print(
        f"finer: within 3 % or 0.002 L in {np.mean(changed <= np.maximum(0.03 * far, 0.002)):.0%}"
    )
    wrong = sum(one.walked[0] * one.predicted[0] < 0 and min(abs(one.walked[0]),
                abs(one.predicted[0])) > 0.005 for one in comparisons)  # fmt: skip
    print(f"wrong direction: {wrong}")


if __name__ == "__main__":
    main(*(map(int, sys.argv[1:]) if len(sys.argv) > 1 else (30,)))
