"""Contacts follow from forces: an end that hardly arches does not hide what lies flat behind it."""

import math
from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Gait, Robot
from analytic.friction.contact_length import arches
from analytic.friction.contacts import contacts_of
from analytic.friction.laws import Friction
from analytic.friction.motion import undecided_motion
from analytic.scene import pneunet
from analytic.scene.chain import node_positions
from analytic.scene.ground import Patches
from analytic.scene.surface import from_ratios
from analytic.solvers.elastica import solve_elastica
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate

ROBOT, LINKS = Robot(), 120
ALL = Friction(contacts="all")


def contacts(fractions, robot=ROBOT, links=LINKS):
    """Contacts of a strip that is inflated from rest."""
    path = robot.peak_pressure * np.linspace(0.0, 1.0, 20)[:, None] * np.array(fractions)
    shapes = solve_elastica(robot, path, links)
    return contacts_of(shapes, shapes.curve(shapes.nodes)[1], len(shapes) - 1)


@pytest.mark.parametrize("part", [0.005, 0.02, 0.05])
def test_an_end_arches_over_the_length_that_beam_theory_gives_and_a_side_begins_there(part):
    """D y'''' = -w between a free end and ground that it touches without a moment or a kink."""
    robot = replace(ROBOT, segments=(1.0,))
    pressure = part * robot.peak_pressure
    rigidity = pneunet.base_rigidity(robot) + pneunet.rigidity_per_pressure(robot) * pressure
    curvature = pneunet.curvature_per_pressure(robot) * pressure
    arch = 2 * math.sqrt(rigidity * curvature / robot.weight_per_length)
    left, side, right = contacts([part], robot)
    assert left.length == right.length == 0
    nodes = node_positions(robot, LINKS)
    assert nodes[side.nodes[0]] == pytest.approx(arch, abs=2 * np.diff(nodes).max())
    assert side.length == pytest.approx(robot.length - 2 * arch, abs=0.02 * robot.length)
    assert arches(robot, pressure, 0.99 * arch)
    assert not arches(robot, pressure, 1.01 * arch)


@pytest.mark.parametrize("part", [0.0, 0.03])
def test_the_contacts_carry_the_whole_weight_and_an_end_with_pressure_is_a_tip(part):
    found = contacts([1.0, 0.0, part], links=60)
    assert sum(contact.load for contact in found) == pytest.approx(ROBOT.weight)
    assert (found[-1].length > 0) == (part == 0)


def test_without_pressure_at_its_end_a_strip_has_a_side_as_before_and_no_more_contacts():
    assert [contact.length > 0 for contact in contacts([1.0, 0.0, 0.0])] == [False, True]


@pytest.mark.parametrize("gait", [*GAITS.values(), *(gait.reversed() for gait in GAITS.values())])
def test_the_named_gaits_do_not_linger_at_low_pressures(gait):
    assert not gait.lingers()


@pytest.mark.parametrize("low", [0.02, 0.1])
def test_a_gait_lingers_if_an_end_stays_low_while_others_change(low):
    assert Gait("any", ((0, 1, 0), (1, 1, low), (1, 0, 0), (0, 1, 0))).lingers()
    assert not Gait("any", ((0, 1, 0), (1, 1, 1), (1, 0, 0), (0, 1, 0))).lingers()
    # the whole strip at rest under a low pressure changes nothing
    assert not Gait("any", ((0, 1, low), (0, 1, 0), (0, 1, low))).lingers()


# the independent minimiser of benchmarks/minimiser: -0.0086 at 96 and at 144 links
BEHIND = Scene(
    Robot(weight_per_length=1.46667, peak_pressure=28304.5),
    Gait("behind", ((1, 0, 0), (0, 0, 1), (0, 1, 0), (1, 0, 0)), 8.0),
    from_ratios("weak", 0.17, 0.1),
)


@pytest.mark.slow
def test_theory_and_simulation_count_what_lies_flat_behind_an_end():
    assert reference(BEHIND).displacement[0] == pytest.approx(-0.0086, rel=0.03)
    assert measure(simulate(BEHIND)).displacement == pytest.approx(-0.0086, rel=0.05)


LONG = Robot(length=8 / 3 * 0.13, weight_per_length=2.0, chamber_height=4.1e-3, segments=(1.0,) * 8)


STAGES = tuple(tuple(float((j - k) % 4 in (0, 1)) for j in range(8)) for k in range(9))


def test_where_none_of_many_contacts_resists_the_motion_is_open_on_patches_too():
    path = LONG.peak_pressure * Gait("waves", STAGES).pressures(4)
    shapes = solve_elastica(LONG, path, 48)
    felt, gelatin = SURFACES["felt"], SURFACES["gelatin"]
    amount = undecided_motion(shapes, felt, ALL)
    assert amount > 0.05 * LONG.length
    assert undecided_motion(shapes, Patches("two", (0.1,), (felt, felt)), ALL) == amount
    assert undecided_motion(shapes, gelatin, ALL) < 0.2 * amount
    assert undecided_motion(shapes, from_ratios("weak", 1e-3, 1.0), ALL) == 0.0


def test_two_ends_that_resist_alike_are_decided_by_the_paper_s_rule():
    shapes = solve_elastica(ROBOT, ROBOT.peak_pressure * GAITS["wave"].pressures(6))
    assert undecided_motion(shapes, SURFACES["felt"], ALL) == 0.0
