"""Feet of limbs that resist viscously, by least squares, by scaling, and in MuJoCo."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import Robot
from analytic.scene.feet import Foot
from analytic.scene.limbs import quadruped, rotation
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES, Surface
from analytic.solvers.limbs.contacts import Contacts
from analytic.solvers.limbs.walk import follow, shapes, walk
from mjsim.files.scene_tables.tables import build
from mjsim.files.scene_tables.written import as_tables
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate
from tests.mjsim.limbs.test_feet_of_limbs import shod

SMOOTH = Surface("smooth", tip_force=1e-9)
GAIT = undulation("wave", left=0.7)


def test_tips_that_resist_viscously_alone_move_the_hub_by_least_squares():
    """Legs that stand on their tips, two points each; the torso's ends have no foot."""
    legs = quadruped().outer
    dampings = dict(zip(legs, (1.0, 2.0, 3.0, 4.0), strict=True))
    robot = quadruped()
    for name, value in dampings.items():
        robot = shod(robot, Foot(0, 1, grip=0.0, damping=value), limbs=[name])
    robot = shod(robot, Foot(0, 1, grip=0.0), limbs=["torso"])
    pressures = robot.peak_pressure * np.array(
        [[0.0, 0.9, 0.9, 0.9, 0.9], [0.0, 1.0, 0.9, 0.8, 1.0]]
    )
    tree, rests = shapes(robot, pressures, 4, twists=0)
    path = follow(tree, rests, pressures, SMOOTH, times=np.array([0.0, 2.0]))
    finder, expected = Contacts(tree), np.zeros(3)
    for rest, row in zip(rests, pressures, strict=True):  # both are asked, and their mean is taken
        contacts = [c for c in finder.find(rest, row) if tree.robot.limbs[c.limb].name in legs]
        assert [c.length for c in contacts] == [0.0] * 4
        weights = finder.weights(contacts)
        names = [tree.robot.limbs[c.limb].name for c in contacts for _ in c.at]
        root = np.sqrt([dampings[name] for name in names])
        before, after = (100 * weights @ each.nodes[:, :2] for each in rests)
        rows = np.zeros((len(root), 2, 3))
        rows[:, 0, 0] = rows[:, 1, 1] = 1.0
        middle = 0.5 * (before + after)
        rows[:, 0, 2], rows[:, 1, 2] = -middle[:, 1], middle[:, 0]
        pulls = root[:, None] * (before - after)
        scaled = (root[:, None, None] * rows).reshape(-1, 3)
        expected += 0.5 * np.linalg.lstsq(scaled, pulls.ravel(), rcond=None)[0]
    expected[:2] = rotation(0.5 * expected[2]) @ expected[:2]
    assert [*100 * path.place[-1], path.heading[-1]] == pytest.approx(expected, rel=1e-3, abs=1e-6)


def test_a_walk_by_weak_friction_is_of_second_order_in_its_increments():
    """Tips that resist viscously, on which all stands, so that nothing jumps."""
    robot = shod(quadruped(), Foot(0, 1, grip=0.0, damping=1.0), limbs=quadruped().outer)
    ends = robot.peak_pressure * np.array([[0.0, 0.8, 0.9, 0.9, 0.9], [0.0, 1.0, 0.9, 0.7, 1.0]])
    speeds = []
    for count in (1, 2, 4, 8, 64):
        pressures = np.linspace(*ends, count + 1)
        tree, rests = shapes(robot, pressures, 4, twists=0)
        path = follow(tree, rests, pressures, SMOOTH, times=np.linspace(0, 1, count + 1))
        speeds.append([*path.place[-1] / robot.length, path.heading[-1]])
    errors = np.abs(np.array(speeds[:-1]) - speeds[-1]).max(axis=1)
    assert errors[0] < 2e-4
    assert (errors[:-1] / errors[1:] > 3.0).all(), errors


@pytest.mark.parametrize("bent", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_twice_the_damping_at_half_the_speed_is_the_same_walk(bent):
    slow = replace(GAIT, ramp_time=tuple(2 * time for time in GAIT.ramp_times))
    paths = [
        walk(shod(quadruped(), Foot(1, 1, damping=value), limbs=quadruped().outer), gait,
             SURFACES["felt"], states=3, elements=4, twists=0, bent=bent).place
        for value, gait in ((1.0, GAIT), (2.0, slow))
    ]  # fmt: skip
    assert paths[0] == pytest.approx(paths[1], abs=1e-9)


def test_damping_of_a_foot_is_switched_by_its_chamber():
    robot = shod(quadruped(), Foot(1, 1, damping=2.0, chamber="torso"), limbs=quadruped().outer)
    bare, on = quadruped(), shod(quadruped(), Foot(1, 1, damping=2.0), limbs=quadruped().outer)
    for torso, alike in ((0.0, bare), (1.0, on)):
        stages = tuple((torso, *stage[1:]) for stage in GAIT.stages)
        gait = replace(GAIT, name="stiff torso", stages=stages)
        places = [
            walk(each, gait, SURFACES["felt"], states=2, elements=4, twists=0, bent=False).place
            for each in (robot, alike)
        ]
        assert np.array_equal(*places)


@pytest.mark.parametrize("ground", ["felt", pytest.param("polyethylene", marks=pytest.mark.slow)])
def test_mujoco_walks_on_damped_feet_as_the_reference_does(ground):
    robot = shod(quadruped(), Foot(1, 1, damping=2.0), limbs=quadruped().outer)
    path = walk(robot, undulation(), SURFACES[ground], states=10, elements=4, twists=0)
    walked = measure(simulate(Scene(robot, undulation(), SURFACES[ground]),
                              Numerics(links=4, twists=0)))  # fmt: skip
    assert walked.displacement == pytest.approx(path.displacement[0] / robot.length, abs=0.0015)


def test_damping_is_written_as_it_is_read_and_takes_a_unit():
    robot = shod(quadruped(), Foot(1, 1, damping="20 mN s/m"), limbs=["front-left"])
    again, _ = build(as_tables(Scene(robot, GAIT, SURFACES["felt"]), Numerics()))
    limb = again.robot.limbs[robot.place("front-left")]
    assert limb.strip.feet == (Foot(1, 1, damping=0.02),)


def test_what_damped_feet_cannot_do_is_refused_in_one_line():
    damped = shod(quadruped(), Foot(1, 1, damping=1.0))
    felt = SURFACES["felt"]
    with pytest.raises(ValueError, match="damping of a foot must be 0 for a strip, got 1 N s/m"):
        Scene(replace(Robot(), feet=(Foot(1, 1, damping=1.0),)))
    with pytest.raises(ValueError, match="a foot with damping resists by speed"):
        Scene(damped, GAIT, felt, friction="coulomb")
    with pytest.raises(ValueError, match="must be 0 where feet of limbs grip otherwise back"):
        Scene(shod(quadruped(), Foot(1, 1, grip_back=2.0, damping=1.0)), GAIT, felt)
    with pytest.raises(ValueError, match="damping must be one for a robot of 0"):
        Scene(shod(quadruped(), Foot(1, 1, damping=1e6)), GAIT, felt)
    with pytest.raises(ValueError, match="where ground or a foot resists by speed, got None"):
        walk(damped, GAIT, felt, path=np.zeros((2, 5)))
