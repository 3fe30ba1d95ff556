"""The time step of a gait by how fast its chambers fill."""

from dataclasses import replace

import pytest

from analytic import GAITS, SURFACES, Gait, Robot
from analytic.scene.feet import Foot
from analytic.scene.limbs import quadruped
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene, resolved
from mjsim.scene.valves import Valves
from mjsim.simulation.simulation import simulate


def step(ramp, stages=GAITS["wave"].stages, **more):
    gait = Gait("any", stages, ramp)
    return resolved(Scene(gait=gait, **more)).timestep


@pytest.mark.parametrize("ramp", [1.0, 2.0, 8.0])
def test_slow_gaits_have_the_usual_time_step(ramp):
    assert step(ramp) == 0.005
    assert step(ramp, robot=quadruped(), stages=((0.0,) * 5, (1.0,) * 5, (0.0,) * 5)) == 0.01


@pytest.mark.parametrize("ramp", [0.05, 0.069, 0.155, 0.533, 0.9])
def test_a_chamber_that_fills_fast_does_so_in_200_time_steps(ramp):
    assert 200 <= ramp / step(ramp) < 600


def test_half_of_the_pressure_in_half_of_the_time_is_as_fast():
    stages = tuple(tuple(0.5 * part for part in stage) for stage in GAITS["wave"].stages)
    assert step(0.2, stages) == step(0.4)
    assert step((0.2, 1.0), ((0.0,) * 3, (0.1,) * 3, (0.0,) * 3)) == 0.005


def test_the_time_step_that_is_asked_for_is_taken():
    scene = Scene(gait=replace(GAITS["wave"], ramp_time=0.1))
    assert resolved(scene, Numerics(timestep=0.005)).timestep == 0.005
    assert resolved(scene, Numerics(links=12)).timestep == 0.0005


def test_a_strip_that_starts_on_a_nap_has_short_steps():
    """Of which it is within 1 % of half as long ones; 5 ms are 11 % off there."""
    stiction = replace(SURFACES["gelatin"], static_ratio=1.5, stribeck_speed=1e-3)
    nap = replace(stiction, tip_force=0.8 * stiction.tip_force,
                  tip_force_back=1.2 * stiction.tip_force)  # fmt: skip
    bristles = Robot(feet=(Foot(0, 0.1, grip_back=1.5),))
    assert step(2.0, ground=stiction) == 0.005
    assert step(2.0, ground=nap) == step(2.0, ground=stiction, robot=bristles) == 0.001
    walks = [measure(simulate(Scene(ground=nap), Numerics(timestep=dt))).displacement
             for dt in (None, 0.0005)]  # fmt: skip
    assert walks[0] == pytest.approx(walks[1], rel=0.01)


def test_chambers_that_fill_slowly_make_a_gait_slow():
    """Valves that open within 0.05 s, on chambers whose pressure follows in 1 s."""
    assert step(0.05) == 0.00025
    assert step(0.05, valves=Valves(fill_time=1.0)) == 0.005
    assert step(0.05, valves=Valves(fill_time=1.0, vent_time=0.3)) == 0.001


def test_the_fastest_of_unlike_chambers_counts():
    late = Valves(fill_time=0.5, vent_time=(1.0, 0.3, 2.0))
    assert step(0.05, valves=late) == step(0.3)
