"""Slopes: the chain under tilted weight, and who slides when the weight helps one end."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from analytic import GAITS, SURFACES, Flag, Friction, Gait, Robot, predict, solve_elastica
from analytic.friction.laws import slip_fraction
from analytic.locomotion import undecided
from analytic.scene import pneunet
from analytic.scene.surface import from_ratios
from analytic.solvers.elastica.newton import Chain

ROBOT = Robot()
GROUND = SURFACES["polyethylene"]


@pytest.mark.parametrize("slope", [0.3, -0.5])
def test_a_tilted_cantilever_is_the_boundary_value_problem_of_tilted_weight(slope):
    load, parts = 12.0, np.linspace(0.1, 1.0, 10)

    def slopes(s, u):
        return np.array([u[1], load * (1 - s) * np.cos(u[0] + slope)])

    def ends(left, right):
        return np.array([left[0], right[1]])

    s = np.linspace(0, 1, 200)
    sagging = -np.outer([1.0, 0.0], s)
    exact = solve_bvp(slopes, ends, s, sagging, tol=1e-10).sol
    unit = pneunet.base_rigidity(ROBOT) / ROBOT.length**3
    errors = []
    for links in (12, 48):
        state = None
        for weight in load * parts:
            robot = Robot(weight_per_length=weight * unit)
            chain = Chain(robot, links, clamped=True, slope=slope)
            chain.load_at(np.zeros(3))
            pull = np.full(links + 1, -weight * np.sin(slope))  # so that the free end has none
            state = chain.equilibrium((state or chain.flat())._replace(tension=pull))
        at = np.linspace(0, 1, links + 1)
        errors.append(np.abs(state.theta - exact(at)[0]).max())
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] > 4**1.8


def test_the_end_that_slides_downhill_has_the_weight_s_help():
    assert slip_fraction(1.2, 1.0) == 0
    assert slip_fraction(1.2, 1.0, downhill=0.3, growing=True) == 1
    assert slip_fraction(1.2, 1.0, downhill=0.3, growing=False) == 0
    assert slip_fraction(1.0, 1.0, downhill=0.3, growing=False) == 0
    assert slip_fraction(1.0, 1.4, downhill=0.3, growing=False) == 1


def travel(friction, gait=GAITS["wave"], ground=GROUND):
    return predict(ROBOT, gait, ground, friction=friction).locomotion.per_cycle / ROBOT.length


@pytest.mark.slow
def test_the_least_slope_decides_the_ties_of_the_paper_s_law_downhill():
    """Tips that resist alike share on level ground; now the lower one slides out, the upper in."""
    weak = GROUND.scaled(1e-3)
    level = predict(ROBOT, GAITS["wave"], weak, friction=Friction(tension=1.0))
    ties = undecided(level.shapes, weak, law="constant") / ROBOT.length
    assert ties > 0.1
    least = travel(Friction(tension=1.0, slope=1e-9), ground=weak)
    assert least == pytest.approx(level.locomotion.per_cycle / ROBOT.length - ties, abs=1e-3)


@pytest.mark.parametrize("surface", [GROUND, from_ratios("mud", 1.0, 0.3)], ids=lambda s: s.name)
@pytest.mark.slow
def test_under_coulomb_s_law_the_least_slope_is_level_ground(surface):
    level, least = (
        predict(ROBOT, GAITS["wave"], surface, friction=Friction("coulomb", 1.0, slope))
        for slope in (0.0, 1e-7)
    )
    gap = (least.locomotion.per_cycle - level.locomotion.per_cycle) / ROBOT.length
    assert abs(gap) < 1e-3


def mirrored(gait):
    return Gait(f"{gait.name}-mirrored", tuple(s[::-1] for s in gait.stages), gait.ramp_time)


@pytest.mark.parametrize("gait", list(GAITS))
@pytest.mark.parametrize("law", ["constant", "coulomb"])
@pytest.mark.slow
def test_the_mirrored_scene_goes_the_mirrored_way(gait, law):
    up = travel(Friction(law, 1.0, 0.04), GAITS[gait])
    down = travel(Friction(law, 1.0, -0.04), mirrored(GAITS[gait]))
    assert up == pytest.approx(-down, abs=2e-4)


@pytest.mark.slow
def test_the_steeper_the_ground_the_less_it_climbs():
    climbs = [travel(Friction(tension=1.0, slope=slope)) for slope in (0.0, 0.03, 0.06)]
    assert climbs[0] > climbs[1] > climbs[2]


def test_where_the_ground_cannot_hold_the_weight_there_is_no_number():
    """Two tips hold 2 V0 V_t; here the weight's part downhill is more."""
    steep = Friction(tension=1.0, slope=0.3)
    assert steep.downhill(ROBOT) > 2 * GROUND.tip_force
    walked = predict(ROBOT, GAITS["wave"], GROUND, friction=steep)
    assert Flag.BRANCH_END in walked.flags
    assert np.isnan(walked.locomotion.per_cycle)


def test_forces_of_the_ground_are_those_of_the_tilted_weight():
    path = GAITS["wave"].pressures(20) * ROBOT.peak_pressure
    shapes = solve_elastica(ROBOT, path, ground=GROUND, friction=Friction("constant", 1.0, 0.05))
    weight = ROBOT.weight_per_length * ROBOT.length * np.cos(0.05)
    assert shapes.force.sum(axis=1) == pytest.approx(np.full(len(shapes), weight))
    assert shapes.residual.max() < 1e-9


def test_a_slope_needs_friction_and_is_no_wall():
    with pytest.raises(ValueError, match="tension must be above 0"):
        Friction(slope=0.1)
    with pytest.raises(ValueError, match="90 degrees"):
        Friction(tension=1.0, slope=1.6)
