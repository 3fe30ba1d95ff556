"""Derivatives of the distance: exact identities, differences, and where there are none."""

from dataclasses import replace

import numpy as np
import pytest
from gradients import GOALS, compared

from analytic import GAITS, SURFACES, Friction, Gait, Robot, Surface, predict
from analytic.gradient.distance import distance, terms
from analytic.gradient.inputs import Inputs

LENGTHS = ("robot.length", "robot.width", "robot.thickness", "robot.chamber_height")
FORCES = ("robot.modulus", "robot.weight_per_length", "robot.peak_pressure", "surface.tip_force",
          "surface.shear_strength")  # fmt: skip
TWO_WAYS = Surface("two-ways", 0.03, 12.0)
BRISTLES = Surface("bristles", 0.02, 15.0, tip_force_back=0.04, shear_strength_back=30.0)
UNLIKE = Robot(segments=(1.2, 0.8, 1.0))


def inputs(surface="polyethylene", tension=1.0, robot=UNLIKE, gait="wave"):
    surface = SURFACES[surface] if isinstance(surface, str) else surface
    gait = GAITS[gait] if isinstance(gait, str) else gait
    return Inputs(robot, gait, surface, Friction(tension=tension))


def walked(given, *names):
    return predict(given.robot, given.gait, given.surface, friction=given.friction, gradient=names)


def elasticities(given, *names):
    """Derivatives by logarithms, over the length; and the distance over it."""
    walk, length = walked(given, *names), given.robot.length
    parts = {n: float(walk.gradient[n].value) * given.of(n) / length for n in names}
    return parts, walk.locomotion.per_cycle / length


def located(given):
    """Distance over the length with changes of contacts solved for."""
    walk = walked(given)
    ends = terms(given, walk.shapes, walk.locomotion.left, walk.times, walk.cycles)
    return distance(ends) / given.robot.length


@pytest.mark.parametrize("tension", [0.0, 1.0])
@pytest.mark.parametrize("surface", ["polyethylene", TWO_WAYS])
def test_all_forces_greater_alike_change_nothing(surface, tension):
    parts, _ = elasticities(inputs(surface, tension), *FORCES)
    assert sum(parts.values()) == pytest.approx(0, abs=1e-7 * max(map(abs, parts.values())))


@pytest.mark.parametrize("tension", [0.0, 1.0])
def test_a_robot_as_large_in_every_way_goes_as_far_over_its_length(tension):
    # by the same pressures and the same material forces grow as areas do
    names = (*LENGTHS, "robot.weight_per_length", "surface.tip_force")
    parts, travel = elasticities(inputs(tension=tension), *names)
    total = (sum(parts[name] for name in LENGTHS) + parts["robot.weight_per_length"]
             + 2 * parts["surface.tip_force"])  # fmt: skip
    assert total == pytest.approx(travel, abs=2e-7 * max(map(abs, parts.values())) + 1e-6)


def test_weak_friction_counts_by_the_ratio_of_its_bounds_alone():
    parts, _ = elasticities(inputs(tension=0.0), "surface.tip_force", "surface.shear_strength")
    tip, side = parts.values()
    assert abs(tip) > 0.01
    assert side == pytest.approx(-tip, rel=1e-8)


def test_a_gait_of_mirrored_stages_has_a_mirrored_gradient():
    given = inputs(
        "gelatin", 1.0, gait=Gait("any", ((0, 0, 0), (1, 0, 0), (0.9, 0.4, 0), (0, 0, 0)))
    )
    mirrored = replace(
        given, robot=replace(given.robot, segments=given.robot.segments[::-1]),
        gait=Gait("any", tuple(stage[::-1] for stage in given.gait.stages)),
    )  # fmt: skip
    one, two = (walked(g, "gait.stages").gradient["gait.stages"].value for g in (given, mirrored))
    assert one == pytest.approx(-two[:, ::-1], abs=1e-6 * np.abs(one).max())


@pytest.mark.parametrize(
    ("surface", "tension", "gait"),
    [("polyethylene", 0.0, "pulse"), ("polyethylene", 1.0, "wave"), ("gelatin", 1.0, "full-wave"),
     (TWO_WAYS, 1.0, "pulse"), (BRISTLES, 0.0, "pulse")],
)  # fmt: skip
def test_derivatives_are_those_by_differences_of_the_located_distance(surface, tension, gait):
    given = inputs(surface, tension, gait=gait)
    names = ("robot.length", "robot.modulus", "surface.tip_force")
    parts, _ = elasticities(given, *names)
    largest = max(map(abs, parts.values()))
    for name in names[1:]:
        step = 1e-4 * given.of(name)
        low, high = (located(given.changed(name, (), way * step)) for way in (-1, 1))
        assert parts[name] == pytest.approx((high - low) / 2e-4, abs=1e-5 * largest)


def test_derivatives_are_those_by_differences_of_the_walk_itself():
    given, name, step = inputs("gelatin"), "robot.chamber_height", 0.01
    parts, _ = elasticities(given, name)
    height = given.of(name)
    low, high = (
        walked(given.changed(name, (), way * step * height)).locomotion.per_cycle
        for way in (-1, 1)
    )  # fmt: skip
    assert parts[name] == pytest.approx((high - low) / (2 * step) / given.robot.length, rel=2e-3)


def test_where_a_stage_is_0_the_derivative_is_of_more_pressure_and_says_so():
    given = inputs("felt", 0.0)
    derivative = walked(given, "gait.stages").gradient["gait.stages"]
    assert derivative.value.shape == (5, 3)
    assert "where a stage is 0, of greater values alone" in derivative.reason
    step = 1e-4
    here, near, far = (located(given.changed("gait.stages", (1, 2), k * step)) for k in (0, 1, 2))
    ahead = (-1.5 * here + 2 * near - 0.5 * far) / step
    assert derivative.value[1, 2] / given.robot.length == pytest.approx(ahead, abs=1e-6)


def test_time_does_not_matter_to_a_quasi_static_walk():
    derivative = walked(inputs(), "gait.ramp_time").gradient["gait.ramp_time"]
    assert (float(derivative.value), derivative.reason) == (0.0, "")


def test_a_cycle_of_a_gait_that_starts_inflated_is_differentiated_once_it_repeats():
    gait = Gait("any", ((1, 0, 0), (1, 1, 0), (0, 1, 1), (0, 0, 1), (1, 0, 0)))
    given = inputs("polyethylene", 0.0, gait=gait)

    def second(changed):
        walk = predict(changed.robot, gait, changed.surface, friction=changed.friction, cycles=2)
        ends = terms(changed, walk.shapes, walk.locomotion.left, walk.times, 2)
        assert distance(ends) == pytest.approx(walk.by_cycle[1], abs=1e-6 * given.robot.length)
        return distance(ends)

    walk = predict(given.robot, gait, given.surface, friction=given.friction, cycles=2,
                   gradient=["robot.modulus"])  # fmt: skip
    step = 1e-4 * given.robot.modulus
    low, high = (second(given.changed("robot.modulus", (), way * step)) for way in (-1, 1))
    derivative = float(walk.gradient["robot.modulus"].value)
    assert derivative == pytest.approx((high - low) / (2 * step), rel=1e-5)


def test_where_a_tie_would_break_there_is_no_derivative_and_the_reason_is_told():
    lifts = Gait("up", ((0, 0, 0), (0, 0.5, 0), (0, 0, 0)))
    given = inputs("polyethylene", 0.0, robot=Robot(), gait=lifts)
    derivatives = walked(given, "robot.length", "gait.stages").gradient
    assert float(derivatives["robot.length"].value) == 0.0  # both ends stay alike
    stages = derivatives["gait.stages"]
    assert stages.value[1, 1] == 0.0
    assert np.isnan(stages.value[1, [0, 2]]).all()
    assert "both ends resist alike" in stages.reason


def test_where_two_changes_of_contacts_meet_there_is_no_derivative_and_it_is_said():
    derivative = walked(inputs("felt"), "surface.tip_force").gradient["surface.tip_force"]
    assert np.isnan(derivative.value)
    assert "two changes of contacts meet" in derivative.reason


def test_a_walk_that_ends_has_no_derivative_and_the_reason_is_told():
    heavy = Robot(weight_per_length=2.0, chamber_height=4.1e-3, peak_pressure=70e3)
    derivative = walked(inputs("felt", 0.0, robot=heavy), "robot.length").gradient["robot.length"]
    assert np.isnan(derivative.value)
    assert "ends" in derivative.reason


@pytest.mark.parametrize(
    ("friction", "robot", "reason"),
    [(Friction("coulomb"), {}, "friction by load"),
     (Friction(contacts="all"), {}, "friction between the ends"),
     (Friction(tension=1.0, slope=0.01), {}, "slopes"),
     (Friction(), {"feet": ({"begin": 0, "end": 0.1, "grip": 2.0},)}, "feet")],
)  # fmt: skip
def test_what_is_not_differentiated_is_told(friction, robot, reason):
    walk = predict(Robot(**robot), GAITS["wave"], SURFACES["felt"], friction=friction,
                   states_per_ramp=4, gradient=["robot.length"])  # fmt: skip
    derivative = walk.gradient["robot.length"]
    assert np.isnan(derivative.value)
    assert reason in derivative.reason


@pytest.mark.parametrize(
    ("name", "words"),
    [("robot.lenght", "did you mean"), ("body.length", "robot.length"), ("robot.mass", "a number"),
     ("robot.material", "a number"), ("gait.name", "a number")],
)  # fmt: skip
def test_a_field_that_cannot_be_changed_is_refused_by_name(name, words):
    with pytest.raises(ValueError, match=words):
        walked(inputs(), name)


@pytest.mark.slow
@pytest.mark.parametrize("friction", list(GOALS))
def test_derivatives_of_random_scenes_are_those_by_differences(friction):
    """Three scenes; benchmarks/gradients.csv holds a hundred."""
    rows = [compared(friction, seed) for seed in (0, 3, 4)]
    assert all(row.compared or row.reason for row in rows)
    assert sum(row.compared for row in rows) >= 10
    assert max(row.error for row in rows if row.compared) < GOALS[friction]
