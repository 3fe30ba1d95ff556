"""The anchor rule of section 2.2 and what follows from it exactly."""

import numpy as np
import pytest
from hypothesis import assume, given
from strategies import gaits, robots, surfaces

from analytic import GAITS, LAWS, SURFACES, Gait, Robot, direction, displacements, solve_modes
from analytic.friction.laws import neutral_ratio, slip_fraction
from analytic.scene.surface import REFERENCE_AREA, Surface, from_ratios


def walk(robot, gait, surface, states_per_ramp=60, cycles=1):
    shapes = solve_modes(robot, gait.pressures(states_per_ramp, cycles) * robot.peak_pressure)
    return displacements(shapes, surface, cycles)


def solved(result):
    """Leave out the draws in which some state has no solution."""
    assume(not np.isnan(result.per_cycle))
    return result.per_cycle


@given(robots, gaits)
def test_felt_and_gelatin_are_equal_and_opposite(robot, gait):
    felt = solved(walk(robot, gait, SURFACES["felt"]))
    gelatin = solved(walk(robot, gait, SURFACES["gelatin"]))
    assert felt == pytest.approx(-gelatin, abs=1e-12 * robot.length)


@given(robots, gaits, surfaces)
def test_the_reversed_gait_goes_the_opposite_way(robot, gait, surface):
    there = solved(walk(robot, gait, surface))
    back = solved(walk(robot, gait.reversed(), surface))
    assert there == pytest.approx(-back, abs=1e-12 * robot.length)


@given(robots, gaits, surfaces)
def test_the_ends_keep_the_separation_between_them(robot, gait, surface):
    shapes = solve_modes(robot, gait.pressures(20) * robot.peak_pressure)
    assume(not np.isnan(shapes.separation).any())
    result = displacements(shapes, surface)
    change = shapes.separation - shapes.separation[0]
    assert np.allclose(result.right - result.left, change, atol=1e-12 * robot.length)
    assert result.left[-1] == pytest.approx(result.right[-1], abs=1e-12 * robot.length)


@given(robots, surfaces)
def test_every_cycle_travels_alike(robot, surface):
    one = solved(walk(robot, GAITS["wave"], surface))
    three = walk(robot, GAITS["wave"], surface, cycles=3).per_cycle
    assert three == pytest.approx(one, abs=1e-12 * robot.length)


@given(robots, gaits)
def test_scaling_both_resistances_changes_nothing(robot, gait):
    weak = Surface("a", 0.3, 0.8)
    strong = weak.scaled(8.0)
    assert solved(walk(robot, gait, weak)) == solved(walk(robot, gait, strong))


def test_the_paper_s_directions_come_out():
    robot, gait = Robot(), GAITS["wave"]
    felt = walk(robot, gait, SURFACES["felt"], 400).per_cycle
    gelatin = walk(robot, gait, SURFACES["gelatin"], 400).per_cycle
    assert direction(felt, robot.length) == "forward"
    assert direction(gelatin, robot.length) == "backward"


def test_a_ratio_exists_at_which_the_robot_stands_still():
    robot, gait = Robot(), GAITS["wave"]

    def at(ratio):
        return walk(robot, gait, from_ratios("any", 3 * ratio, 1.0), 400).per_cycle

    low, high = 0.0, 10.0
    assert at(low) > 0 > at(high)
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if at(middle) > 0 else (low, middle)
    assert abs(at(low) - at(high)) < 0.002 * robot.length
    # the default robot is the one that stands still on polyethylene, by the elastica
    assert low == pytest.approx(neutral_ratio(SURFACES["polyethylene"], robot), rel=0.1)


def test_finer_increments_converge_at_first_order_at_least():
    robot, gait = Robot(), GAITS["wave"]
    shifts = [walk(robot, gait, SURFACES["felt"], n).per_cycle for n in (50, 100, 200, 3200)]
    errors = np.abs(np.array(shifts[:3]) - shifts[3]) / robot.length
    assert errors[0] < 2e-3
    assert errors[2] < 5e-4


def test_the_larger_resistance_anchors_and_equals_share():
    left, right = np.array([2.0, 1.0, 1.0]), np.array([1.0, 2.0, 1.0])
    assert slip_fraction(left, right).tolist() == [0.0, 1.0, 0.5]
    one_by_one = [slip_fraction(*pair) for pair in zip(left.tolist(), right.tolist(), strict=True)]
    assert one_by_one == [0.0, 1.0, 0.5]


def test_resistance_is_constant_at_a_tip_and_by_area_on_a_side():
    """On polyethylene half a segment of the default robot holds as a tip does."""
    surface, width = SURFACES["polyethylene"], Robot().width
    lengths = np.array([0.0, 0.5, 1.0]) * REFERENCE_AREA / width
    bounds = LAWS["constant"].bound(surface, width, lengths, 0.0)
    assert bounds == pytest.approx([0.017, 0.017, 0.034])
    floats = [LAWS["constant"].bound(surface, width, x, 0.0) for x in lengths.tolist()]
    assert floats == bounds.tolist()


def test_a_state_without_solution_leaves_no_number():
    heavy = Robot(weight_per_length=20.0)
    gait = Gait("middle", ((0, 0, 0), (0, 0.05, 0), (0, 0, 0)))
    shapes = solve_modes(heavy, gait.pressures(10) * heavy.peak_pressure)
    result = displacements(shapes, SURFACES["felt"])
    assert np.isnan(result.per_cycle)
    with pytest.raises(ValueError, match="NaN"):
        direction(result.per_cycle, heavy.length)


def test_one_state_is_no_sequence():
    with pytest.raises(ValueError, match="two states"):
        displacements(solve_modes(Robot(), [0, 0, 0]), SURFACES["felt"])
