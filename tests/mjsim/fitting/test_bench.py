"""Benches: pressure and angle along time, zeros, actuators that no scene could walk with."""

import numpy as np
import pytest

from analytic.scene.robot import Robot
from mjsim.fitting.estimate import estimate
from mjsim.fitting.observations import read_observations
from mjsim.fitting.parameters import parameters
from mjsim.fitting.walks import Predictor, by_mujoco

RNG = np.random.default_rng(5)
TIME = np.arange(0, 10, 0.05)
PRESSURE = 20 * (1 - np.abs(TIME / 5 - 1))  # kPa, up and down
ANGLE = 2.0 * PRESSURE + RNG.normal(0, 0.5, len(TIME))  # deg


def modulus(slope, length):
    """E = 6 H^2 c / (alpha t^3) of a slope in rad/Pa of a segment."""
    robot = Robot()
    alpha = slope / length
    return 6 * robot.chamber_height**2 * robot.chamber_fraction / (alpha * robot.thickness**3)


def log(path, pressure, angle):
    rows = np.stack([TIME, pressure, angle, np.full(len(TIME), 21.5)], axis=1)
    np.savetxt(path, rows, "%.5f", ",", comments="",
               header="Time [s],Pressure [kPa],Angle [deg],temperature")  # fmt: skip
    return path


def fitted(path, zero=""):
    series = read_observations([path], zero)
    return estimate(Predictor({}, series), parameters({}, "robot.modulus"))


def test_the_log_of_a_bench_is_one_series_of_angles_and_its_other_columns_are_named(tmp_path):
    (angle,) = read_observations([log(tmp_path / "log.csv", PRESSURE, ANGLE)])
    np.testing.assert_allclose(angle.at, 1e3 * PRESSURE, atol=0.01)
    np.testing.assert_allclose(angle.value, np.radians(ANGLE), atol=1e-6)
    assert angle.ignored == ("temperature",)


@pytest.mark.parametrize(("zero", "pressure", "angle"), [
    ("pressure", 1.3, 0.0), ("angle", 0.0, -4.0), ("pressure", 101.3, 0.0)])  # fmt: skip
def test_a_zero_is_that_of_a_straight_line(tmp_path, zero, pressure, angle):
    """Oracle: a line through all samples by numpy; absolute pressure is a zero of 101 kPa."""
    fit = fitted(log(tmp_path / "log.csv", PRESSURE + pressure, ANGLE + angle), zero)
    gradient, level = np.polyfit(PRESSURE + pressure, ANGLE + angle, 1)  # deg/kPa, deg
    expected = np.radians(level) if zero == "angle" else -1e3 * level / gradient
    assert fit.offset[0] == pytest.approx(expected, abs=0.5 * fit.offset_error[0])
    length = Robot().length / 3
    assert fit.value[0] == pytest.approx(modulus(np.radians(gradient) / 1e3, length), rel=3e-3)
    assert fit.low[0] <= modulus(np.radians(2.0) / 1e3, length) <= fit.high[0]
    assert not fit.misfit.withheld


def test_a_zero_without_a_bench_is_refused(tmp_path):
    path = tmp_path / "track.csv"
    path.write_text("time [s],left [mm]\n0,1\n1,2\n")
    with pytest.raises(ValueError, match="zero is of files of pressure and angle"):
        read_observations([path], "pressure")


def test_a_walk_and_a_free_segment_are_not_in_one_file(tmp_path):
    path = tmp_path / "both.csv"
    path.write_text("time [s],pressure [kPa],angle [deg],left [mm]\n0,1,2,3\n")
    with pytest.raises(ValueError, match="'left', of a walk, and angle"):
        read_observations([path])


@pytest.mark.parametrize(("rows", "slope"), [
    ("0,0\n10,20\n20,40\n", 2.0), ("".join(f"{p},{9 * p}\n" for p in range(21)), 9.0)])  # fmt: skip
def test_actuators_that_would_close_a_strip_into_a_circle_are_fitted(tmp_path, rows, slope):
    path = tmp_path / "soft.csv"
    path.write_text("pressure [kPa],angle [deg]\n" + rows)
    expected = modulus(np.radians(slope) / 1e3, Robot().length / 3)
    assert fitted(path).value[0] == pytest.approx(expected, rel=1e-4)


def test_values_that_a_scene_refuses_count_as_walks_that_fail(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("displacement [mm]\n4\n")
    predictor = Predictor({}, read_observations([path]), by_mujoco)
    assert np.isnan(predictor({"robot.modulus": 2e5})[0]).all()
    assert "into a circle" in next(iter(predictor.refused.values()))
    path.write_text("displacement [mm]\n4\n4\n")
    with pytest.raises(ValueError, match=r"at the start fails.*into a circle.*another --start"):
        estimate(Predictor({}, read_observations([path])),
                 parameters({}, "robot.modulus", "robot.modulus=0.2MPa"))  # fmt: skip
