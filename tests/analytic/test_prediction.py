"""A cycle's distance by any solver, resolved where the anchor changes."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, SOLVERS, SURFACES, Flag, Friction, Gait, Robot, Surface, predict
from analytic.scene.ground import Patches
from analytic.scene.pneunet import with_load
from analytic.solvers.models import Elastica


def distance(solver, surface="felt", **options):
    walked = predict(Robot(), GAITS["wave"], SURFACES[surface], solver, **options)
    return walked.locomotion.per_cycle / Robot().length


@pytest.mark.parametrize("solver", list(SOLVERS))
def test_changes_of_anchor_are_located_whatever_the_states(solver):
    fine = distance(solver, states_per_ramp=200)
    for states in (6, 13, 25):
        assert distance(solver, states_per_ramp=states) == pytest.approx(fine, abs=2e-6)


@pytest.mark.parametrize("tension", [0.0, 1.0])
@pytest.mark.parametrize("surface", list(SURFACES))
def test_segments_that_are_all_but_equal_go_as_equal_ones_do(surface, tension):
    equal, nearly = (
        predict(
            Robot(segments=segments), GAITS["wave"], SURFACES[surface],
            friction=Friction(tension=tension),
        ).locomotion.per_cycle
        for segments in ((1.0, 1.0, 1.0), (1.0, 1.0, 1.0 + 1e-6))
    )  # fmt: skip
    assert nearly == pytest.approx(equal, abs=1e-6 * Robot().length)


@pytest.mark.parametrize("solver", list(SOLVERS))
def test_felt_and_gelatin_are_equal_and_opposite_by_every_solver(solver):
    assert distance(solver) == pytest.approx(-distance(solver, "gelatin"), abs=1e-4)


def test_the_solvers_agree_on_the_distance_as_far_as_small_slopes_go():
    modes, lifted, obstacle, elastica = (distance(solver) for solver in SOLVERS)
    assert modes == pytest.approx(obstacle, abs=2e-4)
    assert modes == pytest.approx(elastica, rel=0.05)
    assert lifted == pytest.approx(elastica, rel=0.005)


def test_flags_tell_what_was_met_on_the_way():
    heavy = Robot(weight_per_length=2.0, chamber_height=4.1e-3, peak_pressure=70e3)
    walked = predict(heavy, GAITS["wave"], SURFACES["felt"])
    assert walked.flags == Flag.BRANCH_END
    assert walked.locomotion.per_cycle != walked.locomotion.per_cycle  # NaN


def test_an_unknown_solver_is_refused_by_name():
    with pytest.raises(ValueError, match="modes, lifted, obstacle, elastica"):
        predict(Robot(), GAITS["wave"], SURFACES["felt"], "ladder")


def test_a_change_of_anchor_between_states_of_one_separation_is_located():
    """At odd states per ramp one increment goes as far out as back."""
    coulomb = Friction(law="coulomb")
    fine = distance("elastica", "gelatin", states_per_ramp=40, friction=coulomb)
    for states in (7, 13):
        assert distance(
            "elastica", "gelatin", states_per_ramp=states, friction=coulomb
        ) == pytest.approx(fine, abs=2e-6)


def test_states_and_times_that_mean_nothing_are_refused():
    robot, gait, felt = Robot(), GAITS["wave"], SURFACES["felt"]
    path = robot.peak_pressure * gait.path(4)[0]
    with pytest.raises(ValueError, match="states per ramp"):
        predict(robot, gait, felt, states_per_ramp=0)
    with pytest.raises(ValueError, match="not decrease"):
        predict(robot, gait, felt, path=path, times=-np.arange(len(path)))
    with pytest.raises(ValueError, match="one for each row"):
        predict(robot, gait, felt, path=path, times=[0.0, 1.0])


FOUR = Gait(
    "four",
    ((0,) * 4, (1, 0, 0, 0), (1, 1, 0, 0), (0, 1, 1, 0), (0, 0, 1, 1), (0, 0, 0, 1), (0,) * 4),
    8.0,
)


@pytest.mark.parametrize(
    ("robot", "gait"),
    [
        (Robot(segments=(1.0,) * 4), FOUR),  # a side that slides as it becomes a tip, then stays
        (with_load(replace(Robot(), peak_pressure=55e3), 4.0), GAITS["wave"]),
        (Robot(), GAITS["pulse"]),  # contacts that come to a stop within a ramp
    ],
    ids=["four segments", "light", "pulse"],
)
def test_where_tips_resist_and_sides_do_not_the_distance_is_of_no_number_of_states(robot, gait):
    distances = [
        predict(
            robot, gait, SURFACES["gelatin"], states_per_ramp=states, friction=Friction(tension=1.0)
        ).locomotion.per_cycle / robot.length
        for states in (7, 12, 25)
    ]  # fmt: skip
    assert distances == pytest.approx([distances[0]] * 3, abs=1e-6)


def test_a_tip_that_slides_up_to_a_border_that_it_cannot_pass_stays_there():
    """Its bound is any between those on both sides, and it may not slip back by a rounding."""
    robot = Robot(length=0.13, weight_per_length=0.9031, peak_pressure=54.24e3)
    gait = Gait("seams", ((0,) * 3, (0, 0, 1), (0, 1, 1), (1, 1, 0), (1, 0, 0), (0,) * 3), 8.0)
    surfaces = [
        Surface(f"patch-{i}", tip_force=tip, shear_strength=side, friction=0.0)
        for i, (tip, side) in enumerate([(0, 1.96), (6.8e-3, 0.588), (3.4e-3, 0), (3.4e-4, 3.92)])
    ]
    ground = Patches("seams", (0.0302, 0.0662, 0.1149), tuple(surfaces))
    distances = [
        predict(
            robot, gait, ground, Elastica(links), states, Friction(tension=1.0)
        ).locomotion.per_cycle / robot.length
        for links, states in [(30, 6), (60, 12), (60, 25)]
    ]  # fmt: skip
    assert distances == pytest.approx([0.2318] * 3, abs=3e-4)  # MuJoCo at fine steps
    assert distances[1:] == pytest.approx([distances[1]] * 2, abs=1e-6)
