"""Tips of limbs resist at the two points of their width, in MuJoCo as in the reference."""

import math

import numpy as np
import pytest

from analytic.scene.gait import GAITS, Gait
from analytic.scene.limbs import Limb, LimbedRobot, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from analytic.solvers.limbs.walk import walk
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import simulate


def limb(name, length, width, weight, **place):
    strip = Robot(length=length, width=width, weight_per_length=weight, segments=(1.0,))
    return Limb(name, strip, **place)


def test_unlike_tips_of_equal_bounds_that_turn_share_the_slip_as_the_reference_says():
    """By one ellipsoid a tip the robot goes -0.012 L: all of the slip is the wider tip's."""
    robot = LimbedRobot((limb("wide", 0.058, 0.021, 1.5),
                         limb("narrow", 0.0315, 0.013, 2.0, on="wide", at="begin",
                              angle=1.86)))  # fmt: skip
    gait = Gait("any", ((0.0, 0.0), (0.6, 0.75), (1.0, 0.8), (0.0, 0.0)), 4.0)
    scene = Scene(robot, gait, SURFACES["polyethylene"], cycles=1)
    path = walk(robot, gait, scene.ground, states=20, elements=6, twists=resolved(scene).twists)
    walked = measure(simulate(scene))
    ahead, aside = path.displacement / robot.length
    assert walked.displacement == pytest.approx(ahead, abs=0.002)
    assert walked.aside == pytest.approx(aside, abs=0.002)
    assert math.degrees(walked.turn) == pytest.approx(math.degrees(path.turn), abs=0.1)


@pytest.mark.parametrize("gait", [GAITS["pulse"], GAITS["wave"].reversed()])
def test_gaits_without_left_and_right_go_straight_on_tips_that_hold(gait):
    scene = Scene(quadruped(), undulation(gait), SURFACES["gelatin"], cycles=1)
    moved = simulate(scene, Numerics(timestep=0.02)).coordinates
    assert np.abs(moved[:, 1]).max() < 2e-5 * scene.robot.length
    assert np.abs(moved[:, 3]).max() < 1e-4
