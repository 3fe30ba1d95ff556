"""Print how far MuJoCo is from the elastica over random scenes: `make scenes`.

Robots with Gamma from 4 to 40, every gait, both directions, ratios V_t / (tau q L) from 0 to 1 and
pressures that keep the height between 0.05 and 0.35 L, from a fixed seed. `sens` is what 5 % of the
ratio changes in the reference, the measure of how far it can be trusted itself.
"""

from typing import NamedTuple

import numpy as np

from analytic import GAITS, Friction, Gait, Robot, Surface, predict
from analytic.friction.laws import neutral_ratio
from analytic.scene import pneunet
from analytic.scene.surface import from_ratios
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import simulate

COUNT, WORST, SEED = 40, 8, 11
BENT = Friction(tension=1.0)
PER_RAMP = 50  # states of the reference


class Case(NamedTuple):
    robot: Robot
    gait: Gait
    surface: Surface
    gamma: float
    height: float
    reference: float
    sensitivity: float


def reference(robot: Robot, gait: Gait, surface: Surface) -> float:
    walked = predict(robot, gait, surface, states_per_ramp=PER_RAMP,
                     friction=BENT)  # fmt: skip
    return walked.locomotion.per_cycle / robot.length


def cases(seed: int = SEED, count: int = COUNT, sensitive: bool = True) -> list[Case]:
    rng = np.random.default_rng(seed)
    drawn: list[Case] = []
    while len(drawn) < count:
        gamma = float(np.exp(rng.uniform(np.log(4), np.log(40))))
        gait = GAITS[str(rng.choice(list(GAITS)))]
        gait = gait.reversed() if rng.random() < 0.5 else gait
        robot = Robot(peak_pressure=float(rng.uniform(15e3, 70e3)), chamber_height=4.1e-3)
        robot = pneunet.with_load(robot, gamma)
        tip = float(3 * rng.uniform(0, 1))
        ground = from_ratios("any", tip, 1.0)
        low = predict(robot, gait, ground, states_per_ramp=10)
        if low.flags or not 0.05 < low.shapes.amplitude.max() / robot.length < 0.35:
            continue  # without friction, at a hundredth of the cost
        walked = predict(robot, gait, ground, states_per_ramp=PER_RAMP,
                         friction=BENT)  # fmt: skip
        height = walked.shapes.amplitude.max() / robot.length
        if walked.flags or not 0.05 < height < 0.35:
            continue
        exact = walked.locomotion.per_cycle / robot.length
        sensitivity = float("nan")
        if sensitive:
            nearby = (from_ratios("any", f * tip, 1.0) for f in (0.95, 1.05))
            sensitivity = max(abs(reference(robot, gait, g) - exact) for g in nearby)
        drawn.append(Case(robot, gait, ground, gamma, height, exact, sensitivity))
    return drawn


def spread(error: np.ndarray) -> tuple[float, float]:
    """Median and 95th percentile."""
    return float(np.nanmedian(error)), float(np.nanquantile(error, 0.95))


def report(all_cases: list[Case], ramp: float, numerics: Numerics) -> np.ndarray:
    """Print how far the walks are off; their errors over L, in the order of the cases."""
    rows = []
    for case in all_cases:
        gait = Gait(case.gait.name, case.gait.stages, ramp)
        scene = Scene(case.robot, gait, case.surface)
        chosen = resolved(scene, numerics)
        measures = measure(simulate(scene, chosen))
        shift = measures.displacement if measures else float("nan")
        rows.append(
            (abs(shift - case.reference), shift, measures.unexplained if measures else 0.0, case)
        )
    error = np.array([row[0] for row in rows])
    part = error / np.abs([case.reference for case in all_cases])
    middle, high = spread(part)
    near, far = spread(error)
    print(
        f"\n{chosen.links} links, {1e3 * chosen.timestep:g} ms, {ramp:g} s a ramp: error over "
        f"|distance| median {middle:.1%}, 95 % {high:.1%}; over L median {near:.5f}, "
        f"95 % {far:.5f}"
    )
    for _, shift, slip, case in sorted(rows, key=lambda row: -row[0])[:WORST]:
        ratio = neutral_ratio(case.surface, case.robot)
        print(
            f"  Γ {case.gamma:5.1f}  {case.gait.name:<19} ratio {ratio:.2f}  "
            f"height {case.height:.2f}  elastica {case.reference:+.4f}  MuJoCo {shift:+.4f}  "
            f"unexplained {slip:+.4f}  sens {case.sensitivity:.4f}"
        )
    return error


def main() -> None:
    drawn = cases()
    for ramp in (2.0, 4.0, 8.0):
        report(drawn, ramp, Numerics())


if __name__ == "__main__":
    main()
