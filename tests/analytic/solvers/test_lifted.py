"""The contact modes with finite rotations, against the elastica, the paper's modes and symmetry."""

import numpy as np
import pytest
from hypothesis import given, settings
from many_seeds import lifted
from strategies import batches, robot_from_groups, robots

from analytic import (
    GAITS,
    Flag,
    Robot,
    solve_elastica,
    solve_lifted,
    solve_modes,
)
from analytic.uncertainty import UNSOUND

FINE = 3e-4  # of L: what the elastica's own links and the changes of anchor are worth


def random_robots(count, seed=7):
    rng = np.random.default_rng(seed)
    for k in range(count):
        gamma = float(np.exp(rng.uniform(np.log(2), np.log(30))))
        robot = robot_from_groups(gamma, rng.uniform(0.5, 4.0), rng.uniform(0.01, 0.2), 0.13)
        yield robot, GAITS[list(GAITS)[k % 3]]


def sound(shapes):
    return (shapes.status & int(UNSOUND | Flag.NOT_CONVERGED)) == 0


def test_the_distance_is_the_elastica_s_within_a_percent_beyond_its_bound():
    """Ten random robots; benchmarks/many_seeds.csv holds two hundred."""
    rows = [row for seed in range(10) for row in lifted(seed)]
    assert all(row.holds for row in rows)
    assert len(rows) > 6
    assert sum(row.bound < 1e-3 for row in rows) > 0.5 * len(rows)  # most are exact


def test_sound_shapes_are_the_elastica_s():
    for robot, gait in random_robots(6, seed=3):
        pressures = robot.peak_pressure * gait.pressures(12)
        lifted, exact = solve_lifted(robot, pressures), solve_elastica(robot, pressures, 120)
        rows = sound(lifted) & np.isfinite(exact.separation)
        assert rows.mean() > 0.3
        s = np.linspace(0, robot.length, 41)
        for one, two in zip(lifted.curve(s), exact.curve(s), strict=True):
            assert np.abs(one - two)[rows].max() < 5e-4 * robot.length
        off = np.abs(lifted.contact_left - exact.contact_left)[rows]
        assert np.median(off) < 1e-3 * robot.length


@settings(deadline=None, max_examples=25)
@given(robots, batches)
def test_small_slopes_are_the_paper_s_modes(robot, fractions):
    """A hundredth of the pressure and of the weight: a hundredth of the slopes."""
    flat = Robot(length=robot.length, modulus=robot.modulus, chamber_height=robot.chamber_height,
                 weight_per_length=0.01 * robot.weight_per_length)  # fmt: skip
    pressures = 0.01 * robot.peak_pressure * fractions
    lifted, modes = solve_lifted(flat, pressures), solve_modes(flat, pressures)
    rows = sound(lifted) & sound(modes)
    shortening = flat.length - modes.separation[rows]
    allowed = 0.01 * shortening + 1e-9 * flat.length
    assert (np.abs(lifted.separation - modes.separation)[rows] <= allowed).all()
    off = np.abs(lifted.contact_left - modes.contact_left)[rows]
    assert (off <= 0.01 * flat.length).all()


@settings(deadline=None, max_examples=25)
@given(robots, batches)
def test_mirrored_pressures_give_mirrored_shapes(robot, fractions):
    pressures = 0.5 * robot.peak_pressure * fractions
    one, two = solve_lifted(robot, pressures), solve_lifted(robot, pressures[:, ::-1])
    rows = sound(one) & sound(two)
    assert np.allclose(one.separation[rows], two.separation[rows], atol=1e-6 * robot.length)
    assert np.allclose(one.contact_left[rows], two.contact_right[rows], atol=1e-4 * robot.length)
    s = np.linspace(0, robot.length, 21)
    (x, y), (turned_x, turned_y) = one.curve(s), two.curve(robot.length - s)
    assert np.allclose(y[rows], turned_y[rows], atol=1e-5 * robot.length)
    span = two.separation[:, None]
    assert np.allclose(x[rows], (span - turned_x)[rows], atol=1e-5 * robot.length)


def test_six_equal_segments_are_three_inflated_in_pairs():
    three, six = Robot(), Robot(segments=(1.0,) * 6)
    pressures = three.peak_pressure * GAITS["wave"].pressures(10)
    one, two = solve_lifted(three, pressures), solve_lifted(six, np.repeat(pressures, 2, axis=1))
    assert np.allclose(one.separation, two.separation, atol=1e-6 * three.length)
    assert np.allclose(one.contact_left, two.contact_left, atol=1e-5 * three.length)


def test_a_strip_without_pressure_lies_flat():
    shapes = solve_lifted(Robot(), np.zeros((2, 3)))
    assert (shapes.separation == Robot().length).all()
    assert (shapes.amplitude == 0).all()
    assert (shapes.contact_left == 0.5 * Robot().length).all()


def test_negative_pressures_are_refused():
    with pytest.raises(ValueError, match="at least 0"):
        solve_lifted(Robot(), [[-1.0, 0.0, 0.0]])
