"""Friction of a flat limb against turning about its middle, in MuJoCo."""

from dataclasses import replace

import numpy as np
import pytest

from analytic.scene.gait import Gait
from analytic.scene.limbs import Limb, LimbedRobot
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation

TURNED = 0.5  # the limb from the robot's ahead [rad]
STRIP = Robot(length=0.09, width=0.03, segments=(1.0,))


FELT = SURFACES["felt"]
TAU = FELT.shear_strength


def bristles(across, nap="robot"):
    """Felt that resists otherwise across."""
    return replace(FELT, shear_strength_across=across * TAU, nap=nap)


@pytest.mark.parametrize(("part", "turns"), [(0.9, False), (1.1, True)])
@pytest.mark.parametrize(("ground", "along", "across"), [
    (FELT, 1.0, 1.0), (bristles(3.0), 1.0, 3.0), (bristles(0.2), 1.0, 0.2),
    (bristles(3.0, "ground"), 1.0, 3.0),
])  # fmt: skip
def test_a_flat_limb_begins_to_turn_where_the_moment_is_that_of_its_area(
    part, turns, ground, along, across
):
    robot = LimbedRobot((Limb("solo", STRIP, angle=TURNED),))
    gait = Gait("still", ((0.0,), (0.0,)))
    simulation = Simulation(Scene(robot, gait, ground), Numerics(timestep=0.01))
    x, y = ((np.arange(300) + 0.5) / 300 - 0.5) * STRIP.length, np.linspace(-0.5, 0.5, 201)
    x, y = np.meshgrid(x, STRIP.width * y)
    c, s = np.cos(TURNED), np.sin(TURNED)  # bristles are the robot's or the ground's: along +x
    arms = np.hypot(along * (s * x + c * y), across * (c * x - s * y)).mean()
    area = STRIP.length * STRIP.width
    moment = part * TAU * area * arms
    middle = simulation.model.nbody // 2
    simulation.data.xfrc_applied[middle, 5] = moment
    for _ in range(100):
        simulation.step(np.zeros(1))
    yaw = simulation.trajectory().coordinates[:, 3]
    assert bool(abs(yaw[-1] - yaw[0]) > np.radians(1)) is turns
