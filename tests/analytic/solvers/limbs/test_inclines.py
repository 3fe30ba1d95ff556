"""Robots of limbs on ground that rises."""

import math
from dataclasses import replace

import numpy as np
import pytest

from analytic.friction.laws import Friction
from analytic.prediction import predict
from analytic.scene.gait import GAITS, Gait
from analytic.scene.ground import Incline
from analytic.scene.limbs import LENGTH, as_strip, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.walk import walk
from analytic.solvers.models import Elastica

QUADRUPED, POLYETHYLENE = quadruped(), SURFACES["polyethylene"]


def went(degrees, uphill, robot=QUADRUPED, states=6):
    """Displacement over the length and turn on polyethylene that rises so [deg], (3,)."""
    incline = Incline(math.radians(degrees), math.radians(uphill))
    path = walk(robot, undulation("wave"), POLYETHYLENE, states, 4, incline=incline, twists=0)
    assert path.converged
    return np.array([*path.displacement / LENGTH, path.turn])


def test_the_pull_by_coordinates_is_that_of_each_node_times_its_slopes():
    tree = Tree(QUADRUPED, 4, 2, Incline(0.3, 0.7))
    pose = tree.pose(np.random.default_rng(1).normal(0, 0.3, len(tree.parent)))
    exact = np.einsum("pi,piq->q", tree.pull, tree.moves(pose)[:, :2])
    assert tree.pulled(pose) == pytest.approx(exact, abs=1e-14)
    total = QUADRUPED.weight * np.array(
        [-math.sin(0.3) * math.cos(0.7), -math.sin(0.3) * math.sin(0.7)]
    )
    assert tree.pull.sum(axis=0) == pytest.approx(total)
    assert tree.weight.sum() == pytest.approx(QUADRUPED.weight * math.cos(0.3))


@pytest.mark.parametrize("degrees", [2.0, pytest.param(-2.0, marks=pytest.mark.slow)])
def test_a_strip_as_a_tree_climbs_as_the_strip_does(degrees):
    """The elastica shares no code with it."""
    robot, gait = Robot(), GAITS["wave"]
    stages = tuple(map(tuple, np.array(gait.stages)[:, [1, 0, 2]].tolist()))
    path = walk(
        as_strip(robot), Gait("wave", stages), POLYETHYLENE, 16, 6,
        incline=Incline(math.radians(degrees)),
    )  # fmt: skip
    friction = Friction(tension=1.0, slope=math.radians(degrees))
    exact = predict(robot, gait, POLYETHYLENE, Elastica(18), friction=friction)
    assert path.converged
    assert abs(exact.locomotion.per_cycle) > 0.01 * robot.length
    assert path.displacement[0] == pytest.approx(exact.locomotion.per_cycle, rel=0.01)


@pytest.mark.slow
def test_robot_and_slope_turned_alike_it_goes_the_same_way_of_its_own():
    turned = replace(
        QUADRUPED,
        limbs=tuple(replace(limb, angle=limb.angle + math.pi / 2) for limb in QUADRUPED.limbs),
    )
    (ahead, aside, turn), (x, y, turn_too) = went(1, 30), went(1, 120, turned)
    assert [y, -x, turn_too] == pytest.approx([ahead, aside, turn], abs=1e-5)


@pytest.mark.slow
def test_slopes_to_the_left_and_to_the_right_are_mirrored():
    left, right = went(1, 90, states=2), went(1, -90, states=2)
    assert right == pytest.approx(left * [1, -1, -1], abs=1e-5)
    assert left[1] < -0.005  # it drifts downhill


@pytest.mark.slow
def test_where_no_bound_holds_its_weight_there_is_no_number():
    path = walk(QUADRUPED, undulation("wave"), POLYETHYLENE, 4, 4, incline=Incline(0.1))
    assert not path.converged


def test_on_a_slope_friction_must_bend_it():
    with pytest.raises(ValueError, match="bent must be true, got False"):
        walk(QUADRUPED, undulation("wave"), POLYETHYLENE, bent=False, incline=Incline(0.1))
