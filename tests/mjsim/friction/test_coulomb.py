"""Coulomb friction by MuJoCo's own contacts, against the quasi-static theory of the same law."""

import numpy as np
import pytest
import walks
from walks import measured, walk

from analytic import SURFACES, Friction, Gait, Robot, predict
from analytic.locomotion import undecided
from analytic.scene.surface import from_ratios
from mjsim.results.record import record, table
from mjsim.results.status import Status
from mjsim.scene import Scene, registry

SLOW = 8.0  # s a ramp: no inertia to speak of


SCENE = Scene()


def predicted(surface, strength=1.0, gait=SCENE.gait):
    """Distance by the elastica, bent by friction so many times as strong as the surface's."""
    friction = Friction("coulomb", 1.0 if strength else 0.0)
    return walks.predicted(Robot(), gait, surface.scaled(strength or 1.0), friction)


@pytest.mark.parametrize("surface", ["polyethylene", "gelatin"])
@pytest.mark.parametrize("strength", [1.0, 2.0])
def test_the_distance_is_that_of_the_elastica_bent_by_the_same_friction(surface, strength):
    ground = SURFACES[surface].scaled(strength)
    numbers = measured(ground, ramp_time=SLOW, friction="coulomb")
    exact = predicted(SURFACES[surface], strength)
    assert numbers.displacement == pytest.approx(exact, rel=0.02, abs=0.002)


@pytest.mark.slow
def test_weak_friction_needs_a_slower_gait_and_firmer_contacts():
    """A third of the friction: inertia weighs more, and so does the depth that pads sink to."""
    weak = SURFACES["polyethylene"].scaled(1 / 3)
    exact = predicted(weak)
    gaps = [
        abs(measured(weak, ramp_time=ramp, friction="coulomb", contact_depth=depth).displacement
            - exact)
        for ramp, depth in ((4.0, 8e-5), (SLOW, 4e-5), (16.0, 1.5e-5))
    ]  # fmt: skip
    assert gaps[0] > gaps[1] > gaps[2]
    assert gaps[2] < 0.02 * abs(exact)


@pytest.mark.parametrize("gait", ["full-wave", "pulse"])
@pytest.mark.parametrize("reverse", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_other_gaits_meet_it_too(gait, reverse):
    result = walk("gelatin", gait, ramp_time=SLOW, reverse=reverse, friction="coulomb", links=12)
    numbers = measured(
        "gelatin", gait, ramp_time=SLOW, reverse=reverse, friction="coulomb", links=12
    )
    exact = predicted(SURFACES["gelatin"], gait=result.scene.gait)
    assert numbers.displacement == pytest.approx(exact, rel=0.05, abs=0.002)


@pytest.mark.parametrize("body", registry.names())
def test_every_body_meets_it(body):
    numbers = measured("gelatin", ramp_time=SLOW, friction="coulomb", links=12, body=body)
    assert numbers.displacement == pytest.approx(predicted(SURFACES["gelatin"]), rel=0.03)


def anchor_creep(impratio):
    """Way that the left tip, the heavier one, is dragged while the right one slides, over L."""
    result = walk("gelatin", ramp_time=SLOW, friction="coulomb", impratio=impratio)
    x, _ = result.nodes()
    held = (result.time > 12.0) & (result.time <= 16.0)
    return np.ptp(x[held, 0]) / Robot().length


def test_creep_goes_as_one_over_impratio_and_is_negligible_at_the_default():
    soft, firm, firmer = (anchor_creep(ratio) for ratio in (1.0, 10.0, 100.0))
    assert soft == pytest.approx(10 * firm, rel=0.3)
    assert firm == pytest.approx(10 * firmer, rel=0.3)
    assert firmer < 5e-4


def test_pyramids_diverge_where_a_pad_has_no_friction():
    """MuJoCo raises a coefficient of 0 to 1e-5, and a pyramid so thin has rows all but parallel."""
    result = walk("gelatin", ramp_time=SLOW, friction="coulomb", links=12, cone="pyramidal")
    assert result.status in (Status.DIVERGED, Status.TOPPLED)


@pytest.mark.slow
def test_scaling_all_friction_only_changes_how_much_the_strip_is_bent():
    """As Phi goes to 0 the distance goes to the one of no bending."""
    exact = predicted(SURFACES["gelatin"], strength=0.0)
    gaps = [abs(predicted(SURFACES["gelatin"], part) - exact) for part in (0.12, 0.06, 0.03)]
    assert gaps[0] > gaps[1] > gaps[2]
    assert gaps[2] < 0.02 * abs(exact)


def test_the_law_decides_how_far_gelatin_is():
    """Constant resistances give -0.042 L; by load, four times as far, as the lighter tip slides."""
    paper, coulomb = (
        measured("gelatin", ramp_time=SLOW, friction=law).displacement
        for law in ("constant", "coulomb")
    )
    assert coulomb < 3 * paper < 0


@pytest.mark.slow
def test_tips_without_friction_leave_the_distance_on_felt_undecided():
    """Neither tip resists: momentum, speed and links decide, and theory says by how much."""
    walked = predict(Robot(), Scene().gait, SURFACES["felt"], friction=Friction("coulomb"))
    play = undecided(walked.shapes, SURFACES["felt"]) / Robot().length
    assert play > 0.1
    values = [
        measured("felt", ramp_time=ramp, friction="coulomb").displacement
        for ramp in (2.0, 4.0, SLOW)
    ]
    assert np.ptp(values) > 0.02
    exact = walked.locomotion.per_cycle / Robot().length
    assert all(exact - play < value < exact + play for value in values)
    row = record(walk("felt", ramp_time=SLOW, friction="coulomb"))
    assert row["prediction_undecided_over_L"] == pytest.approx(play, rel=0.05)
    assert "undecided by ±0.1" in table([row])


@pytest.mark.slow
def test_tips_with_friction_leave_nothing_undecided():
    for surface in (SURFACES["polyethylene"], SURFACES["gelatin"]):
        walked = predict(Robot(), Scene().gait, surface, friction=Friction("coulomb", 1.0))
        assert undecided(walked.shapes, surface) < 1e-3 * Robot().length


def test_equal_loads_at_equal_tips_leave_it_to_the_last_digit():
    """A gait of one even arch: the tips bear alike all the way, and theory cannot tell."""
    gait = Gait("arch", ((0, 0, 0), (1, 1, 1), (0, 0, 0)), SLOW)
    walked = predict(Robot(), gait, from_ratios("tips", 1.0, 0.0), friction=Friction("coulomb"))
    play = undecided(walked.shapes, from_ratios("tips", 1.0, 0.0))
    path = np.abs(np.diff(walked.shapes.separation)).sum()
    assert play > 0.45 * path


def test_the_coulomb_law_is_refused_to_rungs_that_know_no_forces():
    with pytest.raises(ValueError, match="coulomb"):
        predict(Robot(), Scene().gait, SURFACES["gelatin"], "modes", friction=Friction("coulomb"))
    with pytest.raises(ValueError, match="elastica alone"):
        predict(
            Robot(), Scene().gait, SURFACES["gelatin"], "obstacle", friction=Friction(tension=1.0)
        )
