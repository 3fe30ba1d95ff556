"""What is said of the error of a prediction holds: against exact contact, on random gaits."""

import math
from dataclasses import replace

import numpy as np
import pytest
from strategies import robot_from_groups

from analytic import GAITS, SURFACES, Gait, Robot, Status, predict
from analytic.scene.surface import from_ratios
from analytic.uncertainty import UNSOUND, modes_error

FINE = 1e-4  # of L: discretization of both solvers


def random_scene(seed):
    rng = np.random.default_rng([23, seed])
    gamma = float(np.exp(rng.uniform(np.log(2), np.log(60))))
    robot = robot_from_groups(gamma, rng.uniform(0.5, 4.5), rng.uniform(0.01, 0.2), 0.13)
    middle = rng.choice([0.0, 0.5, 1.0], (int(rng.integers(1, 6)), 3))
    stages = ((0.0,) * 3, *map(tuple, middle.tolist()), (0.0,) * 3)
    ground = from_ratios("any", *rng.uniform(0, 2, 2)) if seed % 2 else SURFACES["felt"]
    return robot, Gait("any", stages), ground


def beyond(seeds):
    """Scenes whose modes are farther from exact contact than their bound, and how many have one."""
    worst, known, sharp = [], 0, 0
    for seed in seeds:
        robot, gait, ground = random_scene(seed)
        modes = predict(robot, gait, ground, "modes", 12, 16)
        bound = modes_error(modes)
        if math.isinf(bound):
            continue
        known += 1
        sharp += bound < 0.005 * robot.length
        exact = predict(robot, gait, ground, "obstacle", 12, 16).locomotion.per_cycle
        if abs(modes.locomotion.per_cycle - exact) > bound + FINE * robot.length:
            worst.append(seed)
    return worst, known, sharp


@pytest.mark.slow
def test_modes_are_within_their_bound_of_exact_contact():
    assert beyond(range(100))[0] == []


@pytest.mark.slow
def test_modes_are_within_their_bound_on_a_thousand_random_gaits():
    worst, known, sharp = beyond(range(100, 1100))
    assert worst == []
    assert known > 800
    assert sharp > 0.5 * known  # a bound that says nothing is easy


@pytest.mark.parametrize("weight", [0.7, 1.0, 2.0])
def test_flags_of_states_that_hardly_shorten_it_do_not_matter(weight):
    """The default gait raises two flags, as its segments begin to rise: the distance is right."""
    robot = replace(Robot(), weight_per_length=weight * Robot().weight_per_length)
    walk = predict(robot, GAITS["wave"], SURFACES["felt"], "modes")
    assert walk.flags & UNSOUND
    assert modes_error(walk) < 1e-5 * robot.length
    exact = predict(robot, GAITS["wave"], SURFACES["felt"], "obstacle").locomotion.per_cycle
    assert walk.locomotion.per_cycle == pytest.approx(exact, abs=FINE * robot.length)


def test_modes_without_a_root_have_no_bound():
    for seed in range(200):
        robot, gait, ground = random_scene(seed)
        walk = predict(robot, gait, ground, "modes", 12, 1)
        if walk.flags & Status.NO_ROOT:
            assert math.isinf(modes_error(walk))
            return
    raise AssertionError("no scene without a root among them")


def test_exact_contact_has_no_such_error():
    assert modes_error(predict(Robot(), GAITS["wave"], SURFACES["felt"])) == 0
