"""Numerics that check themselves keep their word on scenes that nobody measured."""

import itertools
import math
from dataclasses import replace

import pytest

from analytic import GAITS, SURFACES, Gait, Robot, Tether
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.checked import agreement, allowed, closeness, refinements, walk_checked
from mjsim.simulation.simulation import simulate
from studies.accuracy.benchmark_cases import GROUNDS, WALK, exact, scene_of

HIGH = Scene(Robot(peak_pressure=60e3), ground=SURFACES["felt"])
UNEVEN = Scene(Robot(segments=(1.0, 2.0, 3.0)), ground=SURFACES["gelatin"])
FAST = Scene(gait=replace(GAITS["wave"], ramp_time=0.3), ground=SURFACES["felt"])
FOUR = Scene(
    Robot(segments=(1.0,) * 4),
    Gait("four", ((0,) * 4, (1, 0, 0, 0), (1, 1, 0, 0), (0, 0, 1, 1), (0, 0, 0, 1), (0,) * 4)),
    SURFACES["polyethylene"],
)


@pytest.mark.parametrize(
    "scene", [HIGH, UNEVEN, FAST, FOUR], ids=["high", "uneven", "fast", "four"]
)
@pytest.mark.slow
def test_the_distance_is_that_of_fine_numerics_within_the_tolerance(scene):
    check = walk_checked(scene, 0.02)
    fine = measure(simulate(scene, Numerics(links=48, timestep=0.001))).displacement
    assert check.agreed
    assert measure(check.walk).displacement == pytest.approx(fine, rel=0.02, abs=0.001)


def test_a_robot_that_falls_is_said_to_fall_by_two_fine_walks():
    heavy = Scene(Robot(weight_per_length=2.0, chamber_height=4.1e-3, peak_pressure=80e3))
    check = walk_checked(heavy, 0.02)
    assert check.walk.status == "toppled"
    assert check.agreed
    assert check.tried[-1].timestep <= 0.005


def test_each_walk_is_finer_than_the_one_before_and_steps_follow_the_ramps():
    for scene in (HIGH, FAST, FOUR):
        steps = list(refinements(scene))
        assert len(steps) > 2
        for one, two in itertools.pairwise(steps):
            assert two.links >= one.links
            assert two.timestep <= one.timestep
        assert steps[0].timestep <= min(scene.gait.ramp_times) / 25 + 1e-12
    assert all(numerics.links % 4 == 0 for numerics in refinements(FOUR))


@pytest.mark.slow
def test_a_looser_tolerance_never_costs_more():
    for scene in (HIGH, UNEVEN):
        walks = [len(walk_checked(scene, tolerance).tried) for tolerance in (0.005, 0.02, 0.1)]
        assert walks == sorted(walks, reverse=True)


def test_walks_that_agree_are_closer_than_the_tolerance_since_coarse_ones_err_alike():
    check = walk_checked(HIGH, 0.02)
    shift = measure(check.walk).displacement
    assert check.walk.numerics.timestep > 0.002
    assert check.error <= 0.4 * allowed(shift, 0.02)


def test_two_levels_in_a_row_differ_in_links_as_well_as_in_steps():
    for scene in (HIGH, UNEVEN, FAST, FOUR, Scene(FOUR.robot, FOUR.gait, contacts="all")):
        for one, two in itertools.pairwise(refinements(scene)):
            assert two.links > one.links
            assert two.timestep < one.timestep


@pytest.mark.parametrize("timestep", [0.05, 0.02, 0.005])
@pytest.mark.parametrize("unexplained", [1.5, -1.5, math.inf])
def test_steps_are_short_where_the_rule_of_friction_does_not_account_for_the_distance(
    timestep, unexplained
):
    assert closeness(timestep, unexplained) < 0.0 < closeness(timestep, 0.5) < 1.0
    assert closeness(0.002, unexplained) == 1.0
    # of scenes quicker than those that this was chosen on less is believed
    assert closeness(0.02, 0.5, beyond=True) < 0.0 < closeness(0.02, 0.2, beyond=True)
    assert closeness(0.002, unexplained, beyond=True) < 1.0


def test_where_no_rule_of_friction_is_known_coarse_walks_are_not_believed():
    assert closeness(0.02, math.nan) < 0.0 < closeness(0.005, math.nan)


def test_coarse_walks_of_a_gait_with_inertia_are_not_believed_though_they_agree():
    coarse = Numerics(links=12, timestep=0.02)
    calm = simulate(Scene(ground="felt"), coarse)
    hurled = simulate(replace(FAST, gait=replace(FAST.gait, ramp_time=0.1)), coarse)
    assert agreement(calm, calm, 0.02) == (0.0, True)
    assert abs(measure(hurled).unexplained) > allowed(measure(hurled).displacement, 0.02)
    assert agreement(hurled, hurled, 0.02) == (0.0, False)


def test_coarse_walks_are_not_believed_where_momentum_decides():
    """Beside the pull of a tether, see mjsim.results.coasting.unbraked."""
    walk = simulate(
        Scene(Robot(tether=Tether(at=0.5, drag=1e-3))), Numerics(links=12, timestep=0.02)
    )
    assert walk.status == "ok"
    assert not agreement(walk, walk, 0.02)[1]


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [0.1, 0.02])
@pytest.mark.parametrize("ground", GROUNDS[WALK])
def test_auto_meets_its_tolerance_on_the_benchmark_scene(ground, tolerance):
    check = walk_checked(scene_of(WALK, ground), tolerance)
    assert measure(check.walk).displacement == pytest.approx(exact(WALK, ground), rel=tolerance)
