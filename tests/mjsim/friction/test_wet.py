"""Wet ground in MuJoCo: closed forms, and beside the theory at several speeds."""

import math
from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Friction, Robot, Surface, predict
from mjsim.results.measures import measure
from mjsim.scene import Scene
from mjsim.simulation.simulation import Simulation, simulate

WET = Surface("wet", tip_force=0.010, viscosity=2000.0)


def test_a_strip_lying_on_a_wet_slope_slides_at_the_speed_of_its_film():
    """Weight along the slope = viscosity times area times speed."""
    film, slope = Surface("film", viscosity=500.0), 0.05
    scene = Scene(ground=film, slope=slope)
    simulation = Simulation(scene)
    at = [simulation.step(np.zeros(3)).left for _ in range(400)]
    robot = scene.robot
    speed = robot.weight * math.sin(slope) / (film.viscosity * robot.width * robot.length)
    assert (at[-1] - at[-101]) / 0.5 == pytest.approx(-speed, rel=0.01)


@pytest.mark.parametrize(
    "ramp_time", [0.5, *(pytest.param(t, marks=pytest.mark.slow) for t in (1.0, 8.0))]
)
def test_wet_ground_turns_a_slow_robot_round_as_theory_says(ramp_time):
    gait = replace(GAITS["wave"], ramp_time=ramp_time)
    theory = predict(Robot(), gait, WET, friction=Friction(tension=1.0)).locomotion.per_cycle
    numbers = measure(simulate(Scene(gait=gait, ground=WET)))
    assert numbers.displacement == pytest.approx(theory / Robot().length, abs=0.001)
    assert math.isnan(numbers.unexplained)  # no end is an anchor there


def test_sides_of_static_friction_hold_as_those_of_felt():
    """Tips have none, so that nothing ties, and a side that holds never slides."""
    felt = SURFACES["felt"]
    stiction = replace(felt, static_ratio=1.5, stribeck_speed=1e-3)
    sticking, plain = (measure(simulate(Scene(ground=ground))) for ground in (stiction, felt))
    assert sticking.displacement == pytest.approx(plain.displacement, abs=1e-3)


def test_friction_by_load_and_by_speed_do_not_go_together():
    with pytest.raises(ValueError, match="must be constant"):
        Scene(ground=replace(WET, friction=0.3), friction="coulomb")
