"""What is said of the error of a prediction holds: against exact contact, on random gaits."""

import math
from dataclasses import replace

import pytest
from many_seeds import from_groups, modes

from analytic import GAITS, SURFACES, Flag, Gait, Robot, predict
from analytic.uncertainty import UNSOUND, modes_error

FINE = 1e-4  # of L: discretization of both solvers


def test_modes_are_within_their_bound_of_exact_contact():
    """Forty random gaits; benchmarks/many_seeds.csv holds a thousand."""
    rows = [row for seed in range(40) for row in modes(seed)]
    assert all(row.holds for row in rows)
    assert len(rows) > 30
    assert sum(row.bound < 0.005 for row in rows) > 0.5 * len(rows)  # else it says nothing


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
    middle = ((0.0, 0.5, 0.0), (0.0, 1.0, 0.5), (0.0, 1.0, 1.0))  # found by chance
    gait = Gait("middle", ((0.0,) * 3, *middle, (0.0,) * 3))
    walk = predict(from_groups(25.4, 2.71, 0.0145), gait, SURFACES["felt"], "modes", 12)
    assert walk.flags & Flag.NO_ROOT
    assert math.isinf(modes_error(walk))


def test_exact_contact_has_no_such_error():
    assert modes_error(predict(Robot(), GAITS["wave"], SURFACES["felt"])) == 0
