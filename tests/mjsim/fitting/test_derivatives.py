"""Derivatives of the quasi-static distance in a fit."""

import numpy as np
import pytest

from mjsim.fitting.derivatives import distance_slopes
from mjsim.fitting.observations import Run, Series
from mjsim.fitting.parameters import parameters
from mjsim.fitting.problem import Problem
from mjsim.fitting.walks import Predictor, by_mujoco, quasi_static

BASE = {"ground": {"tip_force": 0.030, "shear_strength": 25.0}}
NAMES = "robot.modulus,surface.tip_force"


def series(quantity="displacement"):
    run = Run(None, (("robot.peak_pressure", 40e3),))
    return Series("runs.csv", quantity, 0.0, np.zeros(1), np.array([2e-3]), (run,), 0.0, None)


def problem(base=BASE, quantity="displacement", walk=quasi_static):
    return Problem(Predictor(base, [series(quantity)], walk), tuple(parameters(base, NAMES)))


def test_the_sensitivity_of_distances_is_exact_and_costs_a_walk_a_run():
    exact = problem()
    point = np.log([p.start for p in exact.parameters])
    slopes = exact.sensitivity(point)
    assert exact.predictor.walks == 1
    for i in range(2):
        step = 0.01 * np.eye(2)[i]
        low, high = (exact.differences(point + way * step) for way in (-1, 1))
        assert slopes[0, i] == pytest.approx((high - low)[0] / 0.02, rel=0.01)


def test_a_speed_is_a_distance_over_the_period():
    distance, speed = problem(), problem(quantity="speed")
    point = np.log([p.start for p in distance.parameters])
    assert speed.sensitivity(point) * 10.0 == pytest.approx(distance.sensitivity(point))


@pytest.mark.parametrize(
    ("base", "names"),
    [({**BASE, "numerics": {"friction": "coulomb"}, "ground": {"friction": 0.4}}, ["robot.width"]),
     ({**BASE, "robot": {"mass": "20 g"}}, ["robot.length"]),
     ({**BASE, "robot": {"rigidity": 4e-4}}, ["robot.thickness"]),
     (BASE, ["valves.fill_time"])],
)  # fmt: skip
def test_where_other_fields_follow_from_a_parameter_nothing_is_told(base, names):
    assert distance_slopes(base, names, None, 12) is None


def test_walks_in_mujoco_have_no_derivatives():
    assert problem(walk=by_mujoco).predictor.derivatives({"robot.modulus": 2e6}) is None


def test_a_parameter_of_another_surface_changes_nothing():
    base = {"ground": {"surface": "gelatin"}}
    slopes = distance_slopes(base, ["felt.shear_strength", "robot.modulus"], "gelatin", 12)
    assert slopes["felt.shear_strength"] == 0.0
    assert slopes["robot.modulus"] != 0.0
