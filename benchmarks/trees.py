"""Random trees of limbs: MuJoCo by default against finer MuJoCo and against a finer reference.

    python benchmarks/trees.py [TREES] [FIRST]

Trees of 2 to 8 limbs, with angles, lengths, widths, weights, gaits, both friction laws and four
grounds at random: by default numerics, by a quarter of the step and twice the links, and by the
reference with twice the links and states. Prints a line a tree and how many agree within 5 % or
0.003 L and within 5 % or 0.3 degrees; a walk or a reference that fails is a miss.
"""

import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from analytic.scene.gait import Gait
from analytic.scene.limbs import Limb, LimbedRobot
from analytic.scene.robot import Robot
from analytic.scene.surface import FRICTION, SHEAR_STRENGTH, SURFACES, TIP_FORCE, Surface
from mjsim.results.measures import measure
from mjsim.results.prediction import HALF, error_bars, reference
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import simulate

MIXED = Surface("mixed", 0.7 * TIP_FORCE, 0.5 * SHEAR_STRENGTH, 0.5 * FRICTION, 0.7 * FRICTION)
GROUNDS = (*SURFACES.values(), MIXED)
WITHIN, WITHIN_LENGTH, WITHIN_TURN = 0.05, 0.003, 0.3  # relative, L, degrees
RAMP = 4.0  # s


def draw(seed: int) -> Scene:
    """A random tree and its gait."""
    rng = np.random.default_rng(seed)

    def strip(short: float, width: tuple[float, float]) -> Robot:
        return Robot(length=float(rng.uniform(short, 0.06)), width=float(rng.uniform(*width)),
                     weight_per_length=float(rng.uniform(0.5, 2.0)), segments=(1.0,))  # fmt: skip

    limbs = [Limb("trunk", strip(0.04, (0.02, 0.035)))]
    for number in range(int(rng.integers(1, 8))):
        longer = number and rng.random() < 0.25  # a limb that goes on from another
        on = str(rng.choice([limb.name for limb in limbs[1:]])) if longer else "trunk"
        carrier = next(limb for limb in limbs if limb.name == on)
        at = "end" if longer or rng.random() < 0.5 else "begin"
        turn = rng.uniform(-30, 30) if longer else rng.uniform(-80, 80) + 180 * (at == "begin")
        limbs.append(Limb(f"limb-{number}", strip(0.03, (0.012, 0.018)), on, at,
                          carrier.angle + float(np.radians(turn))))  # fmt: skip
    count = len(limbs)
    rows = np.round(rng.uniform(0.4, 1, (3, count)) * (rng.random((3, count)) < 0.6), 2)
    stages = ((0.0,) * count, *map(tuple, rows.tolist()), (0.0,) * count)
    law = "coulomb" if rng.random() < 0.5 else "constant"
    ground = GROUNDS[int(rng.integers(3 if law == "constant" else 4))]
    if law == "constant" and rng.random() < 0.25:
        ground = MIXED
    return Scene(LimbedRobot(tuple(limbs)), Gait("random", stages, RAMP), ground, friction=law)


def walked(scene: Scene, numerics: Numerics) -> np.ndarray:
    """Displacement over L, (2,), and turn in degrees; NaN if it failed."""
    numbers = measure(simulate(scene, numerics))
    if numbers is None:
        return np.full(3, np.nan)
    return np.array([numbers.displacement, numbers.aside, np.degrees(numbers.turn)])


def agrees(one: np.ndarray, other: np.ndarray) -> bool:
    """Tell whether both displacement and turn do."""
    off, far = np.hypot(*(one - other)[:2]), np.hypot(*other[:2])
    near = off <= max(WITHIN * far, WITHIN_LENGTH)
    return bool(near and abs(one[2] - other[2]) <= max(WITHIN * abs(other[2]), WITHIN_TURN))


def compare(seed: int) -> tuple[str, list[bool]]:
    """A line on a tree; whether finer MuJoCo and theory agree, and whether the bar covers."""
    scene = draw(seed)
    usual = resolved(scene)
    fine = Numerics(links=2 * usual.links, timestep=usual.timestep / 4)
    walk, finer = walked(scene, Numerics()), walked(scene, fine)
    theory, coarse = reference(scene), reference(scene, finer=HALF)
    best = reference(scene, Numerics(links=2 * usual.links), finer=2)
    bar, turn_bar = error_bars(scene, theory, coarse)
    rows = [np.array([*each.displacement, np.degrees(each.turn)]) for each in (theory, best)]
    error = np.abs(rows[0] - rows[1])
    covers = (float(np.hypot(*error[:2])) <= (bar or 0.0) + 1e-4
              and error[2] <= np.degrees(turn_bar) + 0.02)  # fmt: skip
    good = [agrees(walk, finer), agrees(walk, rows[1]), bool(covers)]
    name = f"{seed:3d} {len(scene.robot.limbs)} limbs {scene.ground.name:12s} {scene.friction:8s}"
    numbers = (np.array2string(row, precision=4, suppress_small=True, sign="+")
               for row in (walk, finer, *rows))  # fmt: skip
    marks = "".join("." if ok else "X" for ok in good)
    return f"{name} {' '.join(numbers)} ±{bar or np.nan:.4f} {' '.join(best.flags)} {marks}", good


def main(count: int, first: int) -> None:
    """Print the table."""
    outcomes = []
    with ProcessPoolExecutor(2) as pool:
        for line, good in pool.map(compare, range(first, first + count)):
            outcomes.append(good)
            print(line, flush=True)
    finer, theory, covered = np.mean(outcomes, axis=0)
    print(f"of {count}: as finer MuJoCo {finer:.0%}, as the finer reference {theory:.0%}, "
          f"error bar covers {covered:.0%}")  # fmt: skip


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 60, int(sys.argv[2]) if sys.argv[2:] else 0)
