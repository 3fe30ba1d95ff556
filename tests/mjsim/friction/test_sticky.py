"""Adhesive ground in MuJoCo, by its own adhesion of geoms, beside the theory."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Friction, Patches, Robot, predict
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation, simulate

SLOW = replace(GAITS["wave"], ramp_time=8.0)


@pytest.mark.parametrize("adhesion", [pytest.param(0.01, marks=pytest.mark.slow), 0.05])
@pytest.mark.parametrize("surface", ["felt", "gelatin"])
def test_a_robot_on_sticky_ground_goes_as_far_as_theory_says(surface, adhesion):
    ground = replace(SURFACES[surface], adhesion=adhesion)
    theory = predict(Robot(), SLOW, ground, friction=Friction(tension=1.0)).locomotion.per_cycle
    numbers = measure(simulate(Scene(gait=SLOW, ground=ground), Numerics(links=48)))
    assert numbers.displacement == pytest.approx(theory / Robot().length, rel=0.03)


def test_the_ground_pushes_as_much_as_weight_and_adhesion_pull():
    ground = replace(SURFACES["felt"], adhesion=0.05)
    simulation = Simulation(Scene(ground=ground))
    simulation.step(np.zeros(3))
    push = simulation.data.efc_force[simulation.data.contact.efc_address].sum()
    robot = Robot()
    assert push == pytest.approx(robot.weight + ground.press(robot.width) * robot.length, rel=1e-3)


def test_adhesion_on_patches_is_refused():
    sticky = replace(SURFACES["felt"], adhesion=0.1)
    with pytest.raises(ValueError, match="uniform ground"):
        Scene(ground=Patches("two", (0.1,), (sticky, SURFACES["felt"])))
