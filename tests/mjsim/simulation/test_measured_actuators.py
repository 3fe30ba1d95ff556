"""Robots whose actuators were measured walk in MuJoCo as far as in theory."""

import copy

import numpy as np
import pytest

from analytic import Actuator, Robot
from analytic.scene.limbs import quadruped
from mjsim import Scene, measure, simulate
from mjsim.results.prediction import reference
from mjsim.scene import Numerics
from mjsim.simulation.simulation import Simulation

PEAK = Robot().peak_pressure


def random_actuator(rng, power):
    x, plays = np.linspace(0, 1, 17), rng.integers(0, 3)
    shape = x**power if power > 1 else (2 - power) * x - (1 - power) * x**2
    return Actuator(
        tuple(PEAK * x), tuple(27 * rng.uniform(0.75, 0.98) * shape), None,
        tuple(PEAK * rng.uniform(0.03, 0.4, plays)), tuple(rng.uniform(0.05, 0.3, plays)),
    )  # fmt: skip


@pytest.mark.slow
def test_random_curves_with_hysteresis_one_per_segment_go_as_far_in_theory():
    rng = np.random.default_rng(11)
    for number in range(12):
        power = rng.uniform(0.1, 2.2)
        robot = Robot(actuator=tuple(random_actuator(rng, power) for _ in range(3)))
        gait = ("wave", "full-wave")[number % 4 // 2]
        scene = Scene(robot, gait, ("felt", "gelatin")[number % 2])
        walk = simulate(scene)
        assert walk.status == "ok"
        theory = reference(scene).displacement[0]
        assert measure(walk).displacement == pytest.approx(theory, rel=0.02)


@pytest.mark.slow
def test_limbs_with_a_measured_curve_go_as_far_in_theory():
    curve = Actuator((0, 10e3, 20e3, 30e3, 40e3, 50e3), (0, 2.5, 6.5, 12, 19, 27))
    scene = Scene(quadruped(Robot(actuator=curve)), ground="felt")
    theory = reference(scene).displacement[0]
    assert measure(simulate(scene)).displacement == pytest.approx(theory, rel=0.02)


def test_the_memory_of_a_simulation_is_copied_with_it():
    curve = Actuator((0, PEAK), (0, 25.0), play=(8e3,), share=(0.5,))
    one = Simulation(Scene(Robot(actuator=curve)), Numerics(links=12, timestep=0.02))
    one.play(np.full((20, 3), 30e3))
    two = copy.deepcopy(one)
    for simulation in (one, two):
        simulation.play(np.full((20, 3), 27e3))
    fresh = Simulation(one.scene, one.numerics)
    fresh.play(np.full((40, 3), 27e3))
    assert np.array_equal(one.data.qpos, two.data.qpos)
    assert np.abs(one.data.qpos[3:] - fresh.data.qpos[3:]).max() > 1e-3
