"""Print how far MuJoCo is from the elastica over robots of 3 to 10 segments: `make reach`.

Random waves, strengths of friction from Phi = 0.3 to 50, both laws, patches and slopes, from a
fixed seed. Scenes whose strip rolls up or topples, or that slide down, are drawn anew and counted.
"""

import math
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from analytic import Elastica, Gait, Patches, Robot, Surface, predict
from analytic.scene import pneunet
from analytic.shapes import Flag
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

COUNT, SEED, WORST = 60, 5, 12
MOST_TURN = 4.0  # rad of a strip whose ends are still feet
LINKS_A_SEGMENT = 8
FAR = 0.002  # of the length: a shorter way is no way to be relative to


class Result(NamedTuple):
    scene: Scene
    phi: float
    theory: float
    flags: list[str]
    mujoco: float
    status: str


def wave(rng: np.random.Generator, segments: int) -> Gait:
    """Blocks of inflated segments that run along, one or several at a time, either way."""
    wide = int(rng.integers(1, 4))
    apart = int(rng.integers(wide + 2, segments + wide + 1))
    stages = [[float((j - k) % apart < wide) for j in range(segments)] for k in range(apart + 1)]
    if apart >= segments + wide:  # a single block that enters and leaves
        stages = [
            [float(k - wide <= j < k) for j in range(segments)] for k in range(segments + wide + 1)
        ]
    rows = stages if rng.random() < 0.5 else stages[::-1]
    return Gait("wave", tuple(map(tuple, rows)), 8.0)


def draw(seed: int) -> tuple[Scene, float]:
    rng = np.random.default_rng([SEED, seed])
    segments = int(rng.integers(3, 11))
    parts = tuple(rng.uniform(0.8, 1.2, segments).round(2)) if rng.random() < 0.3 else (1.0,)
    part = float(rng.uniform(0.6, 1.0))
    robot = Robot(
        length=0.13 * segments / 3,
        segments=parts if len(parts) > 1 else (1.0,) * segments,
        weight_per_length=float(np.exp(rng.uniform(np.log(1.0), np.log(3.0)))),
        peak_pressure=part * Robot().peak_pressure,
    )
    gait = wave(rng, segments)
    parts_ = np.diff(robot.borders)
    turn = max(float(parts_ @ np.array(s)) for s in gait.stages) * pneunet.turn_number(robot)
    robot = replace(robot, peak_pressure=robot.peak_pressure * min(1.0, MOST_TURN / turn))
    phi = float(np.exp(rng.uniform(np.log(0.3), np.log(50.0))))
    unit = phi * pneunet.base_rigidity(robot) / robot.length**2
    law = "coulomb" if rng.random() < 0.3 else "constant"

    def surface() -> Surface:
        tip, side = float(rng.uniform(0, 1)), float(rng.uniform(0, 1))
        area = robot.width * robot.length / segments
        mu = float(rng.uniform(0.2, 1.0))
        return Surface("any", tip * unit, side * unit / area, mu * side, mu * tip)

    kind = rng.random()
    ground: Surface | Patches = surface()
    slope = 0.0
    if kind < 0.25:
        ground = Patches("seam", (float(rng.uniform(0, 1)) * robot.length,), (ground, surface()))
    elif kind < 0.4:
        slope = math.radians(float(rng.uniform(-1, 1)))
    return Scene(robot, gait, ground, friction=law, slope=slope), phi


def walked(seed: int) -> Result:
    scene, phi = draw(seed)
    links = LINKS_A_SEGMENT * len(scene.robot.segments)
    theory = predict(scene.robot, scene.gait, scene.ground, Elastica(links), 50,
                     scene.reference_friction)  # fmt: skip
    exact = theory.locomotion.per_cycle / scene.robot.length
    flags = [flag.name or "" for flag in theory.flags]
    if math.isnan(exact):
        return Result(scene, phi, exact, flags, math.nan, "no prediction")
    walk = simulate(scene, Numerics(links=links))
    numbers = measure(walk)
    shift = numbers.displacement if numbers else math.nan
    return Result(scene, phi, exact, flags, shift, str(walk.status))


def describe(result: Result) -> str:
    scene = result.scene
    ground = "patches" if isinstance(scene.ground, Patches) else f"slope {scene.slope:+.3f}"
    where = "between" if scene.between else "ends"
    return (
        f"  {len(scene.robot.segments):2d} segments, {scene.gait.ramps} ramps, "
        f"Phi {result.phi:5.1f} {scene.friction:<9}{ground:<14}{where:<8}"
        f"elastica {result.theory:+.4f}  MuJoCo {result.mujoco:+.4f}  {result.status} "
        f"{' '.join(result.flags).lower()}"
    )


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else COUNT
    with ProcessPoolExecutor(2) as pool:
        results = list(pool.map(walked, range(count + count // 4)))
    kept = [result for result in results if not math.isnan(result.theory)][:count]
    refused = [result for result in results if math.isnan(result.theory)]
    print(f"{len(refused)} of {len(results)} have no prediction")
    failed = [result for result in kept if math.isnan(result.mujoco)]
    print(f"{len(failed)} of {len(kept)} end otherwise in MuJoCo:")
    for result in failed:
        print(describe(result))
    both = [result for result in kept if not math.isnan(result.mujoco)]
    plain = [r for r in both if Flag.JUMPED.name not in r.flags]
    far = [r for r in both if abs(r.theory) > FAR]
    for name, chosen in (("all", both), ("without a jump", plain), (f"beyond {FAR} L", far)):
        error = np.array([abs(r.mujoco - r.theory) for r in chosen])
        over = error / np.abs([r.theory for r in chosen])
        wrong = [r for r in chosen if r.mujoco * r.theory < 0 and abs(r.theory) > 0.005]
        beyond = (over > 0.06) & (error > 0.002)
        print(
            f"{name}: {len(chosen)} scenes, error over |distance| median {np.median(over):.1%}, "
            f"95 % {np.quantile(over, 0.95):.1%}; over L median {np.median(error):.4f}, 95 % "
            f"{np.quantile(error, 0.95):.4f}; beyond 6 % and 0.002 L {int(beyond.sum())}, "
            f"wrong way {len(wrong)}"
        )
    for result in sorted(both, key=lambda r: -abs(r.mujoco - r.theory))[:WORST]:
        print(describe(result))


if __name__ == "__main__":
    main()
