"""Contacts of limbs over length and width: where they resist, what they carry, how they turn."""

from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from analytic.scene.gait import Gait
from analytic.scene.limbs import LENGTH, Limb, LimbedRobot, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES, Surface
from analytic.solvers.limbs.contact_search import SHORT
from analytic.solvers.limbs.contacts import Contacts
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.statics import Statics
from analytic.solvers.limbs.walk import walk

FELT = SURFACES["felt"]


def at_rest(robot, parts, elements=6, twists=0):
    """Tree, state and pressures at parts of the peak, approached from none."""
    statics = Statics(Tree(robot, elements, twists))
    rest, pressures = statics.flat(), robot.peak_pressure * np.array(parts, dtype=float)
    for part in np.linspace(0, 1, 5)[1:]:
        rest = statics.equilibrium(part * pressures, rest)
    return statics.tree, rest, pressures


def with_torso(factor):
    torso, *legs = quadruped().limbs
    weight = factor * torso.strip.weight_per_length
    return LimbedRobot(
        (replace(torso, strip=replace(torso.strip, weight_per_length=weight)), *legs)
    )


def mean_distance(length, width):
    """Mean distance of a rectangle's points from its middle, by midpoints."""
    x, y = ((np.arange(400) + 0.5) / 400 - 0.5) * length, ((np.arange(400) + 0.5) / 400 - 0.5)
    return np.hypot(x[:, None], width * y[None]).mean()


def test_a_side_resists_turning_by_the_mean_distance_of_its_area_and_a_tip_by_that_of_its_line():
    tree, rest, pressures = at_rest(quadruped(), [0, 1, 1, 0, 0])
    finder = Contacts(tree)
    for contact in finder.find(rest, pressures):
        width = tree.robot.limbs[contact.limb].strip.width
        expected = mean_distance(contact.length, width)
        assert finder.radius(contact) == pytest.approx(expected if contact.length else 0, rel=1e-4)
        arms = np.hypot(np.subtract(contact.at, contact.middle), contact.aside)
        assert arms.mean() == pytest.approx(expected, rel=0.11)  # of a few points


def test_a_torso_that_lies_flat_between_legs_on_their_tips_resists_by_its_area():
    tree, rest, pressures = at_rest(with_torso(8.0), [0, 0.4, 0.4, 0.4, 0.4])
    finder = Contacts(tree)
    (torso,) = (contact for contact in finder.find(rest, pressures) if contact.limb == 0)
    strip = tree.robot.limbs[0].strip
    nodes = tree.vertices[0]
    lying = tree.arclength[nodes][rest.force[nodes] > 0]
    assert torso.part == "between"
    # it lifts off between two nodes, at either end of those that push
    assert np.ptp(lying) - 0.5 * strip.length / 6 < torso.length < np.ptp(lying) + strip.length / 6
    bound, _ = finder.resistance(torso, FELT)
    assert bound == pytest.approx(FELT.shear_strength * strip.width * torso.length)


def test_a_torso_that_stands_on_its_ends_resists_by_nothing():
    tree, rest, pressures = at_rest(with_torso(8.0), [1, 0, 0, 0, 0])
    finder = Contacts(tree)
    torso = [contact for contact in finder.find(rest, pressures) if contact.part == "between"]
    assert all(contact.length <= SHORT * LENGTH for contact in torso)


@pytest.mark.parametrize("parts", [(0, 0, 0.8, 0.2), (0.5, 0, 0.8, 0), (0.6, 0, 0.9, 0.3)])
def test_the_side_of_a_limb_that_twists_as_it_lies_on_an_edge_depends_little_on_its_links(parts):
    """Two legs pressed unlike roll the trunk, and the limb ahead lies on its right edge."""

    def limb(name, length, width, weight, *place):
        strip = Robot(length=length, width=width, weight_per_length=weight, segments=(1.0,))
        return Limb(name, strip, *place)

    robot = LimbedRobot((
        limb("trunk", 0.050, 0.026, 0.7),
        limb("ahead", 0.035, 0.016, 1.9, "trunk", "end", np.radians(30)),
        limb("left", 0.045, 0.014, 1.0, "trunk", "begin", np.radians(110)),
        limb("right", 0.045, 0.014, 1.0, "trunk", "begin", np.radians(190)),
    ))  # fmt: skip
    sides = []
    for links in (6, 12):
        tree, rest, pressures = at_rest(robot, parts, links, links // 2)
        edges = rest.force.reshape(2, -1)[:, tree.vertices[1]].sum(axis=1)
        assert edges[0] > 0.9 * edges.sum()
        (side,) = (contact for contact in Contacts(tree).find(rest, pressures) if contact.limb == 1)
        assert side.load == pytest.approx(edges.sum())
        sides.append(side.length)
    assert sides[0] > 0.2 * 0.035
    assert sides[0] == pytest.approx(sides[1], rel=0.1)


@pytest.mark.parametrize(
    "parts", [(0, 0, 0, 0, 0), (0, 0.1, 0.1, 0, 0), (1, 1, 0.7, 0, 0), (0, 0.05, 1, 0.3, 0.3)]
)
def test_under_friction_by_load_contacts_carry_the_robot_s_weight_together(parts):
    robot = quadruped()
    tree, rest, pressures = at_rest(robot, parts)
    contacts = Contacts(tree, "coulomb").find(rest, pressures)
    assert sum(contact.load for contact in contacts) == pytest.approx(robot.weight, rel=1e-6)


def test_a_torso_that_never_lifts_its_middle_goes_nowhere_on_ground_that_holds_sides():
    legs, up = [0, 1, 1, 1, 1], [0, 0, 0, 1, 1]
    rows = [[0] * 5, [0, 1, 1, 0, 0], legs, up, [0] * 5]
    gait = Gait("legs", tuple(tuple(map(float, row)) for row in rows))
    heavy = walk(with_torso(40.0), gait, FELT, 4, 4)
    assert abs(heavy.displacement[0]) < 1e-4 * LENGTH


@pytest.fixture
def model(monkeypatch):
    """The independent model."""
    monkeypatch.syspath_prepend(Path(__file__).parents[4] / "benchmarks" / "peers")
    return import_module("friction_by_area")


@pytest.mark.slow
@pytest.mark.parametrize(("name", "degrees"), [("felt", 0.06), ("gelatin", 0.2)])
def test_one_side_pressed_less_it_goes_and_turns_as_by_friction_of_many_patches(
    model, name, degrees
):
    ground = SURFACES[name]
    rig = model.Model(
        model.quadruped(), ground.tip_force, ground.shear_strength, elements=8, behind=False
    )
    place, angle = rig.walk(model.wave(0.7), 20)
    path = walk(quadruped(), undulation("wave", left=0.7), ground, 20, 6, twists=0)
    assert path.displacement[0] == pytest.approx(place[0], rel=0.04, abs=0.001 * LENGTH)
    assert np.degrees(path.turn) == pytest.approx(np.degrees(angle), abs=degrees)


@pytest.mark.slow
def test_two_legs_by_load_go_as_far_as_node_by_node(model):
    half = np.radians(40)
    limbs = [
        model.Limb(0.06, 0.02, 0.006),
        *(model.Limb(0.05, 0.0135, 0.005, 0, True, s * half, s * 0.004) for s in (1, -1)),
    ]
    rows = [[0, 0, 0], [0, 0.15, 0.15], [1, 0.15, 0.15], [1, 0, 0], [0, 0, 0]]
    place, _ = model.Model(limbs, 0.0, 0.37, coulomb=True).walk(rows, 15)
    ground = Surface("felt", tip_force=0.0, shear_strength=1.0, friction=0.37, tip_friction=0.0)
    torso = replace(quadruped().limbs[0].strip, length=0.06, width=0.02, weight_per_length=0.981)
    leg = replace(torso, length=0.05, width=0.0135)
    trunk, *_, left, right = quadruped().limbs
    robot = LimbedRobot(
        (
            replace(trunk, strip=torso),
            replace(left, strip=leg, angle=half, offset=0.004),
            replace(right, strip=leg, angle=-half, offset=-0.004),
        )
    )
    gait = Gait("kick", tuple(tuple(map(float, row)) for row in rows))
    shared, alone = (
        walk(robot, gait, ground, 15, 6, law="coulomb", all_on_tips=way, twists=0).displacement[0]
        for way in (False, True)
    )
    assert abs(shared - place[0]) < 0.1 * abs(place[0])
    assert abs(shared - place[0]) < abs(alone - place[0])
