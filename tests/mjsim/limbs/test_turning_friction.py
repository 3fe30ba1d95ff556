"""Friction of a flat limb against turning about its middle, in MuJoCo."""

import numpy as np
import pytest

from analytic.scene.gait import Gait
from analytic.scene.limbs import Limb, LimbedRobot
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation

STRIP = Robot(length=0.09, width=0.03, segments=(1.0,))


@pytest.mark.parametrize(("part", "turns"), [(0.9, False), (1.1, True)])
def test_a_flat_limb_begins_to_turn_where_the_moment_is_that_of_its_area(part, turns):
    robot = LimbedRobot((Limb("solo", STRIP, angle=0.5),))
    gait = Gait("still", ((0.0,), (0.0,)))
    simulation = Simulation(Scene(robot, gait, SURFACES["felt"]), Numerics(timestep=0.01))
    x, y = ((np.arange(300) + 0.5) / 300 - 0.5) * STRIP.length, np.linspace(-0.5, 0.5, 201)
    arms = np.hypot(x[:, None], STRIP.width * y[None]).mean()
    area = STRIP.length * STRIP.width
    moment = part * SURFACES["felt"].shear_strength * area * arms
    middle = simulation.model.nbody // 2
    simulation.data.xfrc_applied[middle, 5] = moment
    for _ in range(100):
        simulation.step(np.zeros(1))
    yaw = simulation.trajectory().coordinates[:, 3]
    assert bool(abs(yaw[-1] - yaw[0]) > np.radians(1)) is turns
