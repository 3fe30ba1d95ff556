"""Identities, limits and failures of the contact modes."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from strategies import batches, groups, robot_from_groups, robots

from analytic import Flag, Mode, Robot, solve_modes
from analytic.scene import pneunet

MEASURES = ("separation", "contact_left", "contact_right", "amplitude")


def same(a, b, tolerance):
    return np.allclose(a, b, rtol=0, atol=tolerance, equal_nan=True)


@given(robots, batches)
def test_mirroring_the_pressures_mirrors_the_shape(robot, fractions):
    p = fractions * robot.peak_pressure
    one, other = solve_modes(robot, p), solve_modes(robot, p[:, ::-1])
    # where both ends want to lie flat alike, the choice of the left one is not symmetric
    clear = np.abs(p[:, 0] - p[:, 2]) > 1e-6 * robot.peak_pressure
    tol = 1e-9 * robot.length
    assert same(one.separation[clear], other.separation[clear], tol)
    assert same(one.amplitude[clear], other.amplitude[clear], tol)
    assert same(one.contact_left[clear], other.contact_right[clear], tol)


@given(robots, batches, st.floats(0.2, 5.0))
def test_only_the_dimensionless_groups_enter(robot, fractions, scale):
    other = robot_from_groups(*groups(robot), length=robot.length * scale)
    assert groups(other) == pytest.approx(groups(robot), rel=1e-9)
    one = solve_modes(robot, fractions * robot.peak_pressure)
    two = solve_modes(other, fractions * other.peak_pressure)
    for name in MEASURES:
        a, b = getattr(one, name) / robot.length, getattr(two, name) / other.length
        assert same(a, b, 1e-7)


@given(robots, st.floats(0.01, 1.0))
def test_a_uniform_arch_lifts_off_sqrt_12_d_kappa_over_w(robot, fraction):
    p = fraction * robot.peak_pressure
    kappa = float(pneunet.natural_curvature(robot, p))
    stiff = float(pneunet.rigidity(robot, p))
    lifted = np.sqrt(12 * stiff * kappa / robot.weight_per_length)
    assume(abs(lifted / robot.length - 1) > 1e-3)
    shape = solve_modes(robot, [p] * 3)
    if lifted > robot.length:
        assert shape.mode[0] == Mode.TIP
    else:
        assert robot.length - shape.contact_left[0] == pytest.approx(lifted, rel=1e-9)
        # y = -kappa s^2/2 (1 - s/l)^2 from there on: balanced, but wholly below the ground
        s = np.linspace(0, robot.length, 1001)
        y = shape.curve(s)[1][0]
        t = np.clip(s - shape.contact_left[0], 0, lifted)
        expected = -0.5 * kappa * t**2 * (1 - t / lifted) ** 2
        assert same(y, expected, 1e-12 * robot.length)
        assert shape.status[0] & Flag.PENETRATES
        # and int (y')^2 / 2 = kappa^2 l^3 / 420
        assert robot.length - shape.separation[0] == pytest.approx(
            kappa**2 * lifted**3 / 420, rel=1e-9
        )


@given(robots, batches)
def test_separation_10_and_amplitude_are_those_of_the_curve(robot, fractions):
    shapes = solve_modes(robot, fractions * robot.peak_pressure)
    s = np.linspace(0, robot.length, 1501)
    x, y = shapes.curve(s)
    slope = np.gradient(y, s, axis=1)
    length = robot.length - np.trapezoid(0.5 * slope**2, s, axis=1)
    assert same(length, shapes.separation, 3e-4 * robot.length)
    assert same(x[:, -1], shapes.separation, 1e-12 * robot.length)
    assert same(y.max(axis=1), shapes.amplitude, 2e-5 * robot.length)


@given(robots, batches)
def test_a_curve_that_dips_below_the_ground_is_always_flagged(robot, fractions):
    shapes = solve_modes(robot, fractions * robot.peak_pressure)
    _, y = shapes.curve(np.linspace(0, robot.length, 501))
    dips = np.nan_to_num(y.min(axis=1)) < -1e-8 * robot.length
    assert ((shapes.status[dips] & Flag.PENETRATES) != 0).all()


def test_a_strip_without_pressure_lies_flat():
    shape = solve_modes(Robot(), [0.0, 0.0, 0.0])
    assert shape.mode[0] == Mode.FLAT
    assert shape.status[0] == Flag.OK
    assert shape.separation[0] == Robot().length
    assert shape.contact_left[0] + shape.contact_right[0] == Robot().length
    assert shape.amplitude[0] == 0


def test_a_weak_middle_arch_has_no_solution_with_one_flat_end():
    heavy = Robot(weight_per_length=20.0)
    shape = solve_modes(heavy, [0.0, 0.05 * heavy.peak_pressure, 0.0])
    assert shape.status[0] & Flag.NO_ROOT
    assert np.isnan(shape.separation[0])


def test_a_middle_arch_wants_both_ends_flat():
    shape = solve_modes(Robot(), [0.0, 0.5 * Robot().peak_pressure, 0.0])
    assert shape.status[0] & Flag.BOTH_FLAT
    assert shape.status[0] & Flag.PENETRATES


def test_two_arches_at_the_ends_press_the_middle_into_the_ground():
    heavy = Robot(weight_per_length=4.0)
    shape = solve_modes(heavy, np.array([1.0, 0.0, 1.0]) * heavy.peak_pressure)
    assert shape.mode[0] == Mode.TIP
    assert shape.status[0] == Flag.PENETRATES
    _, y = shape.curve(np.linspace(0, heavy.length, 101))
    assert y[0, 50] < -0.05 * heavy.length


def test_an_inflated_segment_does_not_lie_flat_by_itself():
    p = 0.1 * Robot().peak_pressure
    assert solve_modes(Robot(), [p, p, p]).status[0] & Flag.HELD_FLAT
    assert not solve_modes(Robot(), [0, 0, 10 * p]).status[0] & Flag.HELD_FLAT


def test_several_lift_off_points_are_reported_and_the_least_contact_is_taken():
    # a stiffly arched right segment and a faint left one: lifting off pays in both
    rng = np.random.default_rng(1)
    robot = Robot(weight_per_length=30.0)
    fractions = rng.uniform(0, 1, (20000, 3))
    shapes = solve_modes(robot, fractions * robot.peak_pressure)
    several = (shapes.status & Flag.SEVERAL_ROOTS) != 0
    assert several.any()
    assert (shapes.separation[several] > 0).all()


@pytest.mark.parametrize(
    "pressures", [[1.0, 2.0], [[1.0, 2.0, 3.0, 4.0]], [-1.0, 0, 0], [np.nan, 0, 0], [np.inf, 0, 0]]
)
def test_bad_pressures_are_refused(pressures):
    with pytest.raises(ValueError, match="pressures"):
        solve_modes(Robot(), pressures)
