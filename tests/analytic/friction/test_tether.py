"""Tethers of strips: closed forms, feet that are tethers, and what is no tether."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import (
    GAITS,
    SURFACES,
    Foot,
    Friction,
    Gait,
    Payload,
    Robot,
    Tether,
    predict,
)
from analytic.friction.contacts import of_tether
from analytic.scene.chain import node_positions
from analytic.scene.surface import Surface

LENGTH = Robot().length
ARCH = Gait("arch", ((0, 0, 0), (1, 1, 1), (0, 0, 0)))
BENDS = Friction(tension=1.0)
TIPS = Surface("tips", tip_force=0.01)


def walk(tether, gait=ARCH, ground=TIPS, friction=BENDS, cycles=1, **robot):
    strip = Robot(tether=tether, **robot)
    return predict(strip, gait, ground, friction=friction, states_per_ramp=10, cycles=cycles)


def place(walked, at):
    """x of a material point along a walk, over L."""
    return (walked.locomotion.left + walked.shapes.curve(np.array([at * LENGTH]))[0][:, 0]) / LENGTH


@pytest.mark.parametrize("contacts", ["ends", "all"])
@pytest.mark.parametrize("at", [0.0, 0.37, 0.5, 1.0])
def test_a_strip_without_other_friction_turns_about_its_tether(at, contacts):
    walked = walk(Tether(at, drag=0.001), GAITS["wave"], Surface("ice", shear_strength=1e-6),
                 replace(BENDS, contacts=contacts))  # fmt: skip
    assert place(walked, at) == pytest.approx(at, abs=1e-5)
    assert np.ptp(walked.locomotion.left) > 0.01 * LENGTH or at == 0


@pytest.mark.parametrize("at", [0.0, 0.6])
@pytest.mark.parametrize("ground", SURFACES.values(), ids=lambda surface: surface.name)
def test_a_drag_above_all_bounds_stops_the_robot(ground, at):
    """A side of the whole strip and two tips hold less."""
    most = ground.shear_strength * Robot().width * LENGTH + 2 * ground.tip_force
    walked = walk(Tether(at, drag=1.01 * most), GAITS["wave"], ground)
    assert place(walked, at) == pytest.approx(at, abs=1e-5)
    assert abs(walked.locomotion.per_cycle) < 1e-6 * LENGTH


@pytest.mark.parametrize(("drag", "anchored"), [(0.0098, 0.0), (0.0102, 1.0)])
def test_a_tether_and_a_tip_hold_together_against_the_other_tip(drag, anchored):
    """Left tip 20 mN; right tip 10 mN and the drag: the end that holds more stays."""
    walked = walk(Tether(1.0, drag=drag), feet=[Foot(0, 0.01, grip=2.0)])
    still = place(walked, anchored)[1:-1]
    assert np.ptp(still) < 1e-5
    assert np.ptp(place(walked, 1.0 - anchored)[1:-1]) > 0.01


@pytest.mark.parametrize("ground", SURFACES.values(), ids=lambda surface: surface.name)
@pytest.mark.parametrize(("end", "contacts"), [(0.0, "ends"), (1.0, "all")])
def test_a_tether_at_an_end_is_a_foot_that_holds_there(ground, end, contacts):
    friction = replace(BENDS, contacts=contacts)
    tied = walk(Tether(end, drag=0.004), GAITS["wave"], ground, friction)
    shod = walk(None, GAITS["wave"], ground, friction, feet=[Foot(end, end, hold=0.004)])
    assert tied.locomotion.per_cycle / LENGTH == pytest.approx(
        shod.locomotion.per_cycle / LENGTH, abs=2e-4
    )
    assert abs(tied.locomotion.per_cycle) > 0.001 * LENGTH


def test_under_mu_n_a_tether_at_an_end_is_a_foot_too():
    friction = Friction("coulomb", tension=1.0)
    ground = SURFACES["polyethylene"]
    tied = walk(Tether(0.0, drag=0.01), GAITS["wave"], ground, friction)
    shod = walk(None, GAITS["wave"], ground, friction, feet=[Foot(0, 0, hold=0.01)])
    assert tied.locomotion.per_cycle / LENGTH == pytest.approx(
        shod.locomotion.per_cycle / LENGTH, abs=2e-4
    )


def test_a_spring_stops_a_crawler_where_its_feet_hold_no_more():
    """Its left foot slides ahead while the right one holds back: b_R - a_L, over the stiffness."""
    feet = [Foot(end, end + 0.01, grip=0.5, grip_back=2.0) for end in (0.0, 0.99)]
    ground, stops = replace(TIPS, shear_strength=100.0), 0.9
    tether = Tether(0.0, stiffness=0.015 / (stops * LENGTH))
    held, free = (
        walk(tied, ground=ground, cycles=5, feet=feet).by_cycle / LENGTH for tied in (tether, None)
    )
    assert held.sum() == pytest.approx(stops, abs=1e-5)
    assert held[:2] == pytest.approx(free[:2], rel=0.1)
    assert np.abs(held[3:]).max() < 1e-5


def test_what_it_carries_of_a_tether_is_a_payload():
    ways = [
        predict(robot, GAITS["wave"], SURFACES["felt"], friction=BENDS, states_per_ramp=6)
        for robot in (Robot(tether=Tether(0.3, mass=0.004)), Robot(payload=[Payload(0.004, 0.3)]))
    ]
    assert ways[0].locomotion.per_cycle == ways[1].locomotion.per_cycle
    assert Robot(tether=Tether(0.3, mass="4 g")).weight == pytest.approx(Robot().weight + 0.03924)


def test_friction_that_bends_nothing_refuses_it():
    with pytest.raises(ValueError, match="for elastica with friction that bends the strip"):
        walk(Tether(0.5, drag=0.01), friction=Friction())


@pytest.mark.parametrize(("values", "words"), [
    ({"at": 1.5, "drag": 1}, r"at of a tether must lie in \[0, 1\], got 1.5"),
    ({"at": 0.5}, "must have drag, stiffness or mass"),
    ({"at": 0.5, "drag": -1}, "drag of a tether must be a finite number, at least 0"),
    ({"at": 0.5, "drag": "5 mm"}, "drag must be a number of N"),
    ({"at": 0.5, "dragg": 1}, "key of a tether must be one of at, drag"),
    ({"drag": 1}, "at of a tether is missing"),
])  # fmt: skip
def test_what_is_no_tether_is_refused(values, words):
    with pytest.raises(ValueError, match=words):
        Robot(tether=values)


@pytest.mark.parametrize("at", [0.0, 1.0])
def test_at_a_node_but_for_rounding_it_is_tied_to_that_node_alone(at):
    for length in np.linspace(0.06, 0.2, 60):
        robot = Robot(length=length, tether=Tether(at, drag=0.005))
        (contact,) = of_tether(robot, node_positions(robot, 24))
        assert contact.share == [1.0]
