"""A run that fails says so, and leaves what is needed to see why."""

from dataclasses import replace

import numpy as np
import pytest
from walks import HEAVIER, walk

import mjsim.simulation.simulation as simulation
from analytic.scene.gait import Gait
from analytic.scene.robot import Robot
from analytic.scene.surface import SHEAR_STRENGTH, TIP_FORCE, Surface
from mjsim.results.measures import measure
from mjsim.results.record import record
from mjsim.results.status import Status
from mjsim.results.trajectory import load
from mjsim.scene import Numerics, Scene

TOO_MUCH = replace(HEAVIER, peak_pressure=72e3)  # kappa L = 5.7


def test_past_kappa_l_of_5_the_robot_topples():
    result = walk("felt", robot=TOO_MUCH)
    assert result.status is Status.TOPPLED
    assert 2.0 < result.time[-1] < 10.0
    assert np.isfinite(result.coordinates).all()


def test_a_toppled_robot_has_no_displacement():
    result = walk("felt", robot=TOO_MUCH)
    assert measure(result) is None
    row = record(result)
    assert row["displacement_over_L"] is None
    assert row["direction"] is None
    assert row["status"] == "toppled"


STAGES = ((0, 0, 0), (0.2, 0.47, 0), (0.7, 0.57, 0.82), (0.26, 0, 0), (0.93, 0.53, 0),
          (0.02, 0.95, 0.42), (0, 0, 0))  # fmt: skip


@pytest.mark.parametrize("timestep", [0.005, 0.0025])
def test_a_strip_that_is_thrown_into_the_air_is_no_walk_though_both_ends_stay_low(timestep):
    robot = Robot(weight_per_length=1.36218760827, peak_pressure=59149.68567)
    firm = Surface("firm", TIP_FORCE, SHEAR_STRENGTH)
    scene = Scene(robot, Gait("kick", STAGES, 0.0691822), firm)
    result = simulation.simulate(scene, Numerics(timestep=timestep))
    assert result.status is Status.TOPPLED
    assert measure(result) is None
    lowest = result.line[..., 2].min(axis=1) / robot.length
    assert lowest.max() > 0.01


@pytest.mark.parametrize("poison", [np.nan, 1e6])
def test_coordinates_that_run_away_are_called_diverged(monkeypatch, poison):
    step = simulation.mujoco.mj_step

    def broken(model, data):
        step(model, data)
        if data.time > 1.0:
            data.qpos[1] = poison

    monkeypatch.setattr(simulation.mujoco, "mj_step", broken)
    result = simulation.simulate(Scene(), Numerics(links=6))
    assert result.status is Status.DIVERGED
    assert result.time[-1] == pytest.approx(0.5 + 0.01, abs=0.011)


def test_a_saved_failure_can_be_loaded_and_shows_the_same_states(tmp_path):
    result = walk("felt", robot=TOO_MUCH)
    from mjsim.results.provenance import provenance

    path = tmp_path / "failed.nc"
    result.save(path, provenance(result.scene, result.numerics))
    again = load(path)
    assert again.status is Status.TOPPLED
    assert again.scene == result.scene
    assert again.numerics == result.numerics
    assert np.array_equal(again.coordinates, result.coordinates)
