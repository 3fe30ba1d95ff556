"""The elastica solver against exact and independent solutions, and where its branch ends."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from scipy.integrate import solve_bvp
from strategies import batches, groups, robot_from_groups, robots

from analytic import (
    GAITS,
    SURFACES,
    Flag,
    Friction,
    Mode,
    Robot,
    displacements,
    solve_elastica,
    solve_modes,
    solve_obstacle,
)
from analytic.scene import pneunet
from analytic.scene.chain import joint_springs, link_lengths
from analytic.solvers.elastica.cantilever import solve_cantilever

# heavier and more curved than the default robot: its stable branch ends at 65 kPa
HEAVIER = Robot(weight_per_length=2.0, chamber_height=4.1e-3)


def along(gait, robot=None, n=50, links=60):
    robot = robot or Robot()
    return solve_elastica(robot, GAITS[gait].pressures(n) * robot.peak_pressure, links=links)


def cantilever_tip(load):
    """Tip of the heavy elastica, theta'' = load (1 - s) cos(theta), by collocation."""
    s = np.linspace(0, 1, 200)
    u = np.array([-1.3 * s, s - 1, s, -s])
    for part in np.linspace(0.05, 1, 20) * load:
        solution = solve_bvp(
            lambda s, u, g=part: np.array([u[1], g * (1 - s) * np.cos(u[0]), np.cos(u[0]),
                                           np.sin(u[0])]),
            lambda a, b: np.array([a[0], b[1], a[2], a[3]]), s, u, tol=1e-9, max_nodes=20000,
        )  # fmt: skip
        s, u = solution.x, solution.y
    return u[2:, -1]


def heavy(load):
    base = Robot()
    return Robot(weight_per_length=load * pneunet.base_rigidity(base) / base.length**3)


@pytest.mark.parametrize("sizes", [(12, 24, 48, 96), (10, 20, 40, 80)])
def test_the_heavy_clamped_elastica_is_met_at_second_order(sizes):
    exact = cantilever_tip(33.5)
    robot = heavy(33.5)
    errors = []
    for links in sizes:
        x, y = solve_cantilever(robot, [0, 0, 0], links)
        errors.append(np.hypot(x[-1] / robot.length - exact[0], y[-1] / robot.length - exact[1]))
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (rates > 1.9).all()
    assert errors[-1] < 3e-4


def test_the_published_tip_belongs_to_a_load_of_32_96():
    """(0.32218, -0.88079): both coordinates meet at one load."""
    assert cantilever_tip(32.955) == pytest.approx([0.32218, -0.88079], abs=1e-5)
    robot = heavy(32.955)
    x, y = solve_cantilever(robot, [0, 0, 0], 240)
    assert [x[-1] / robot.length, y[-1] / robot.length] == pytest.approx(
        [0.32218, -0.88079], abs=1e-4
    )


def test_pure_natural_curvature_is_a_circle():
    light = Robot(weight_per_length=1e-9)
    kappa = float(pneunet.natural_curvature(light, light.peak_pressure))
    for links, bound in ((24, 1e-4), (48, 1e-5)):
        x, y = solve_cantilever(light, [light.peak_pressure] * 3, links)
        angle = kappa * light.length
        assert x[-1] == pytest.approx(np.sin(angle) / kappa, abs=bound)
        assert y[-1] == pytest.approx((np.cos(angle) - 1) / kappa, abs=bound)


def test_small_slopes_are_those_of_the_obstacle():
    gaps = []
    for scale in (0.2, 0.1):
        # curvature and load shrink together, so that the shape stays and its slopes fall
        robot = Robot(peak_pressure=scale * Robot().peak_pressure, weight_per_length=2 * scale)
        p = np.array([[1, 0, 0], [1, 1, 0], [0.5, 1, 0.5]]) * robot.peak_pressure
        elastica = solve_elastica(robot, p, links=120)
        obstacle = solve_obstacle(robot, p, elements=120)
        short = 1 - obstacle.separation / robot.length
        gaps.append(np.abs(elastica.separation - obstacle.separation) / robot.length / short)
    assert (gaps[1] < 0.01).all()
    assert (gaps[1] < 0.4 * gaps[0]).all()  # the slopes' square, so a quarter but for chain error


def test_the_distance_converges_at_second_order_in_links():
    shifts = {}
    for links in (12, 24, 48, 192):
        shapes = along("wave", HEAVIER, n=400, links=links)
        shifts[links] = displacements(shapes, SURFACES["felt"]).per_cycle / HEAVIER.length
    errors = np.array([abs(shifts[n] - shifts[192]) for n in (12, 24, 48)])
    assert (np.log2(errors[:-1] / errors[1:]) > 1.7).all()
    assert errors[1] < 2e-4
    # by collocation of the boundary value problem and by an interior point method, made elsewhere
    assert shifts[192] == pytest.approx(0.04179, abs=2e-4)


def test_residuals_of_contact_and_balance_are_rounding():
    for gait in GAITS:
        shapes = along(gait)
        assert (shapes.status == Flag.OK).all()
        assert shapes.residual.max() < 1e-9
        weight = Robot().weight_per_length * Robot().length
        assert np.allclose(shapes.force.sum(axis=1), weight)
        assert shapes.force.min() >= -1e-9 * weight


@pytest.mark.parametrize("gait", list(GAITS))
def test_felt_and_gelatin_are_equal_and_opposite(gait):
    shapes = along(gait)
    felt = displacements(shapes, SURFACES["felt"]).per_cycle
    gelatin = displacements(shapes, SURFACES["gelatin"]).per_cycle
    assert felt == pytest.approx(-gelatin, abs=2e-4 * Robot().length)


def test_the_reversed_gait_passes_the_same_shapes():
    there = along("wave")
    robot = Robot()
    back = solve_elastica(robot, GAITS["wave"].reversed().pressures(50) * robot.peak_pressure)
    assert np.allclose(there.separation, back.separation[::-1], atol=1e-9)
    felt = SURFACES["felt"]
    assert displacements(back, felt).per_cycle == pytest.approx(
        -displacements(there, felt).per_cycle
    )


@given(robots, batches)
def test_mirroring_the_pressures_mirrors_the_shape(robot, fractions):
    p = 0.3 * fractions[:4] * robot.peak_pressure
    one, other = solve_elastica(robot, p, 24), solve_elastica(robot, p[:, ::-1], 24)
    assert (one.status == other.status).all()
    assert np.allclose(one.separation, other.separation, atol=1e-7 * robot.length, equal_nan=True)


@given(robots, batches)
def test_only_the_dimensionless_groups_enter(robot, fractions):
    p = 0.3 * fractions[:3]
    other = robot_from_groups(*groups(robot), length=2 * robot.length)
    one = solve_elastica(robot, p * robot.peak_pressure, 24)
    two = solve_elastica(other, p * other.peak_pressure, 24)
    assert np.allclose(
        one.separation / robot.length, two.separation / other.length, atol=1e-6, equal_nan=True
    )


def test_the_lift_off_point_is_the_closed_form_s_at_small_slopes():
    """One inflated end, the rest flat: there the modes are exact but for slopes of 0.1."""
    small = 0.3
    robot = Robot(weight_per_length=2 * small, peak_pressure=small * Robot().peak_pressure)
    p = np.linspace(0.3, 1, 8)[:, None] * np.array([1.0, 0, 0]) * robot.peak_pressure
    exact, elastica = solve_modes(robot, p), solve_elastica(robot, p, links=240)
    assert (exact.status == Flag.OK).all()
    assert (exact.contact_right > 0).all()
    assert np.abs(elastica.contact_right - exact.contact_right).max() < 0.003 * robot.length
    assert (elastica.contact_left == 0).all()


@pytest.mark.parametrize("fraction", [(1, 0, 0), (1, 1, 0), (0.5, 1, 0.5), (0, 0.4, 0), (1, 0, 1)])
def test_no_feasible_shape_nearby_has_less_energy(fraction):
    robot, links = Robot(), 30
    path = np.linspace(0, 1, 30)[1:, None] * np.array(fraction) * robot.peak_pressure
    shape = solve_elastica(robot, path, links)
    stiffness, rest = joint_springs(robot, links, path[-1:])
    lengths = link_lengths(robot, links)
    x, y = (values[-1] for values in shape.curve(shape.nodes))
    theta = np.arctan2(np.diff(y), np.diff(x))
    rng = np.random.default_rng(5)

    def energy(theta):
        height = np.concatenate([[0.0], np.cumsum(lengths * np.sin(theta))])
        height -= height.min()  # the lowest that the ground allows
        bending = 0.5 * stiffness[0] @ (np.diff(theta) - rest[0]) ** 2
        middle = 0.5 * (height[1:] + height[:-1])
        return bending + robot.weight_per_length * lengths @ middle

    least = energy(theta)
    for size in (1e-1, 1e-2, 1e-3):
        smooth = np.cos(np.pi * np.arange(6)[:, None] * np.linspace(0, 1, links + 1))
        for _ in range(50):
            for change in (rng.normal(size=6) @ smooth, rng.normal(size=links + 1)):
                assert energy(theta + size * change) >= least * (1 - 1e-9)


def test_past_its_stable_branch_it_says_so_and_gives_no_number():
    robot = replace(HEAVIER, peak_pressure=70e3)
    shapes = along("wave", robot)
    lost = shapes.status == Flag.BRANCH_END
    first = int(np.argmax(lost))
    assert 50 < first < 150  # on the second ramp, as the middle segment inflates
    assert lost[first:].all()
    for values in (shapes.separation, shapes.contact_left, shapes.contact_right, shapes.amplitude):
        assert np.isnan(values[first:]).all()
    assert np.isfinite(shapes.separation[:first]).all()
    assert np.isnan(displacements(shapes, SURFACES["felt"]).per_cycle)


def test_an_end_that_curls_off_the_ground_is_called_rolled_up():
    robot = replace(HEAVIER, peak_pressure=75e3, weight_per_length=2 / 3)
    shapes = along("wave", robot)
    rolled = shapes.status == Flag.ROLLED_UP
    assert rolled.any()
    assert np.isnan(shapes.separation[rolled]).all()
    assert np.isfinite(shapes.separation[shapes.status == Flag.OK]).all()


def test_the_branch_ends_at_a_pressure_that_does_not_depend_on_steps_or_links():
    ends = []
    for n, links in ((50, 60), (200, 60), (50, 120)):
        robot = replace(HEAVIER, peak_pressure=70e3)
        path = GAITS["wave"].pressures(n) * robot.peak_pressure
        shapes = solve_elastica(robot, path, links)
        ends.append(path[int(np.argmax(shapes.status == Flag.BRANCH_END)), 1])
    assert np.ptp(ends) < 0.03 * 70e3


def test_a_strip_without_pressure_lies_flat():
    shape = solve_elastica(Robot(), [0, 0, 0])
    assert shape.mode[0] == Mode.FLAT
    assert shape.separation[0] == pytest.approx(Robot().length, rel=1e-12)
    assert shape.amplitude[0] == pytest.approx(0, abs=1e-12)


def test_a_chain_needs_6_links():
    with pytest.raises(ValueError, match="links"):
        solve_elastica(Robot(), [0, 0, 0], links=5)


def test_a_segment_that_curls_up_is_the_arch_upside_down():
    """Held at its middle by its weight, both ends up by kappa s^2 / 2, less what they weigh."""
    robot = replace(Robot(), weight_per_length=0.02)
    part = np.linspace(0, -0.1, 20)
    path = part[:, None] * np.ones(3) * robot.peak_pressure
    shapes = solve_elastica(robot, path, 120, friction=Friction(contacts="all"))
    assert (shapes.status == 0).all()
    kappa = float(pneunet.natural_curvature(robot, -path[-1, 0]))
    _, y = shapes.curve(shapes.nodes)
    assert y[-1, 0] == pytest.approx(kappa * (robot.length / 2) ** 2 / 2, rel=0.05)
    assert y[-1, 0] == pytest.approx(y[-1, -1], abs=1e-6)


def test_a_strip_that_is_mirrored_top_to_bottom_without_weight_bends_the_other_way():
    robot = replace(Robot(), segments=(1.0,))
    up, down = (
        solve_cantilever(replace(robot, weight_per_length=1e-9), np.array([p]), 24)[1]
        for p in (2e4, -2e4)
    )
    assert up == pytest.approx(-down, abs=1e-9)
