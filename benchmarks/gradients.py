"""Derivatives of the distance beside central differences, on random scenes.

    python benchmarks/gradients.py [SCENES [CORES]]

Writes gradients.csv beside this file, a row a scene, and prints how many are within 1e-5 of the
largest component where friction is weak and 1e-3 where it bends. Scenes: robots of three to five
unlike segments, Gamma from 4 to 30, gaits of three to five random stages, both bounds from 0.1 to 3
times the named surfaces'; those whose walk jumps or ends are drawn again, and those that go less
than a thousandth of their length. Of each scene six numbers are compared, of fields that are drawn,
one of the stages among them. Differences are those of the distance with its changes of contacts
solved for, by a step of 1e-4, or where that is off by 1e-5, since a change of contacts may come or
go within a step; where neither exists the number is not compared. Ten minutes of CPU.
"""

import csv
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np

from analytic import Friction, Gait, Robot, predict
from analytic.gradient.distance import distance, terms
from analytic.gradient.inputs import Inputs, Number
from analytic.gradient.solved import UnclearError
from analytic.scene import pneunet
from analytic.scene.surface import from_ratios

ROWS = Path(__file__).with_name("gradients.csv")
COUNT, CORES = 100, 2
GOALS = {"weak": 1e-5, "bends": 1e-3}
TENSIONS = {"weak": 0.0, "bends": 1.0}
FIELDS = (
    "robot.length", "robot.width", "robot.modulus", "robot.thickness", "robot.chamber_height",
    "robot.weight_per_length", "robot.peak_pressure", "surface.tip_force",
    "surface.shear_strength", "robot.segments", "gait.stages",
)  # fmt: skip
STEPS = (1e-4, 1e-5)
NUMBERS = 5  # beside one of the stages


class Row(NamedTuple):
    """One scene: its distance over L, what was compared, and the worst of it."""

    friction: str
    seed: int
    distance: float
    compared: int
    error: float
    field: str
    reason: str


def scene(seed: int, tension: float) -> Inputs:
    """A random scene whose walk has no flag."""
    for attempt in range(100):
        rng = np.random.default_rng([seed, attempt])
        count = int(rng.integers(3, 6))
        segments = tuple(rng.uniform(0.6, 1.4, count).tolist())
        stages = [tuple(float(rng.choice([0, 1, rng.uniform(0.1, 1)])) for _ in range(count))
                  for _ in range(int(rng.integers(3, 6)))]  # fmt: skip
        rest = (0.0,) * count
        robot = Robot(segments=segments, peak_pressure=float(rng.uniform(15e3, 60e3)))
        robot = pneunet.with_load(robot, float(np.exp(rng.uniform(np.log(4), np.log(30)))))
        ground = from_ratios("any", *rng.uniform(0.1, 3, 2).tolist())
        gait = Gait("any", (rest, *stages, rest))
        inputs = Inputs(robot, gait, ground, Friction(tension=tension))
        walk = predict(robot, gait, ground, friction=inputs.friction)
        if not walk.flags and abs(walk.locomotion.per_cycle) > 1e-3 * robot.length:
            return inputs
    raise AssertionError("no scene without a jump")


def located(inputs: Inputs) -> float:
    """Distance per cycle with its changes of contacts solved for [m]."""
    walk = predict(inputs.robot, inputs.gait, inputs.surface, friction=inputs.friction)
    return distance(terms(inputs, walk.shapes, walk.locomotion.left, walk.times, 1))


def off(inputs: Inputs, number: Number, exact: float, goal: float) -> float:
    """Error of a derivative by a number's logarithm against its differences, inf if unknown."""
    weights = ((-1, -0.5), (1, 0.5))
    if number.way:
        weights = ((0, -1.5 * number.way), (number.way, 2.0 * number.way),
                   (2 * number.way, -0.5 * number.way))  # type: ignore[assignment]  # fmt: skip
    best = np.inf
    for step in STEPS:
        by = step * (abs(number.value) or 1.0)
        try:
            value = sum(weight * located(inputs.changed(number.name, number.place, place * by))
                        for place, weight in weights) / step  # fmt: skip
        except UnclearError:
            continue
        best = min(best, abs(value - exact))
        if best <= goal:
            break
    return best


def compared(friction: str, seed: int) -> Row:
    """One scene by its derivatives and by differences."""
    inputs = scene(seed, TENSIONS[friction])
    walk = predict(inputs.robot, inputs.gait, inputs.surface, friction=inputs.friction,
                   gradient=FIELDS)  # fmt: skip
    travel = walk.locomotion.per_cycle / inputs.robot.length
    numbers = {name: inputs.numbers(name) for name in FIELDS}
    exact = {number: float(walk.gradient[name].value[number.place]) * (abs(number.value) or 1.0)
             for name in FIELDS for number in numbers[name]}  # fmt: skip
    finite = [value for value in exact.values() if np.isfinite(value)]
    reasons = {each.reason for each in walk.gradient.values() if not np.isfinite(each.value).all()}
    if not finite:
        return Row(friction, seed, travel, 0, np.nan, "", "; ".join(sorted(reasons)))
    largest = max(map(abs, finite))
    rng = np.random.default_rng(seed)
    worst, field, count = 0.0, "", 0
    for name in [*rng.choice(FIELDS[:-1], NUMBERS, replace=False).tolist(), FIELDS[-1]]:
        number = numbers[name][int(rng.integers(len(numbers[name])))]
        if not np.isfinite(exact[number]):
            continue
        error = off(inputs, number, exact[number], 0.1 * GOALS["weak"] * largest) / largest
        if np.isfinite(error):
            count += 1
            if error >= worst:
                worst, field = error, f"{name} {number.place}"
    return Row(friction, seed, travel, count, worst, field, "; ".join(sorted(reasons)))


def main(count: int = COUNT, cores: int = CORES) -> None:
    """Compare, write and print."""
    jobs = [(friction, seed) for friction in TENSIONS for seed in range(count)]
    with ProcessPoolExecutor(cores) as pool:
        rows = list(pool.map(compared, *zip(*jobs, strict=True)))
    with ROWS.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(Row._fields)
        writer.writerows(
            [r.friction, r.seed, f"{r.distance:.6f}", r.compared, f"{r.error:.1e}", r.field,
             r.reason] for r in rows
        )  # fmt: skip
    for friction, goal in GOALS.items():
        mine = [row for row in rows if row.friction == friction]
        told = [row for row in mine if row.compared]
        within = [row for row in told if row.error <= goal]
        print(f"{friction}: {len(within)} of {len(told)} scenes within {goal:g} of the largest "
              f"component, worst {max(row.error for row in told):.1e}, median "
              f"{np.median([row.error for row in told]):.1e}; {len(mine) - len(told)} without a "
              "derivative, said so")  # fmt: skip


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
