"""Least squares with intervals that hold, on models in closed form and on walks."""

from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

from analytic.scene import pneunet
from mjsim.files.tables import build
from mjsim.fitting.determined import at_bounds, undetermined
from mjsim.fitting.estimate import estimate
from mjsim.fitting.observations import Run, Series
from mjsim.fitting.parameters import parameters, with_values
from mjsim.fitting.walks import Predictor, by_mujoco, coarse, quasi_static

BEND = {"robot": {"curvature_per_pressure": 5e-4}}
PRESSURE = np.linspace(2e3, 5e4, 40)
ALPHA = 4.2e-4


def angles(rng, noise=0.02, outliers=0):
    angle = ALPHA * PRESSURE * 0.05 + rng.normal(0, noise, len(PRESSURE))
    angle[: 3 * outliers : 3] += 3.0
    return Series("bend", "angle", 0.0, PRESSURE, angle, (Run(),), 0.05)


def bent(series, **more):
    free = parameters(BEND, "robot.curvature_per_pressure", **more)
    return estimate(Predictor(BEND, [series]), free)


def test_angles_of_a_free_segment_give_the_slope_that_least_squares_has_in_closed_form():
    series = angles(np.random.default_rng(0), noise=1e-4)
    found = bent(series)
    x = series.at * 0.05
    slope = x @ series.value / (x @ x)
    left = series.value - slope * x
    error = np.sqrt(left @ left / (len(x) - 1) / (x @ x))
    assert found.value[0] == pytest.approx(slope, abs=error / 2)
    assert found.error[0] * slope == pytest.approx(error, rel=0.25)


@pytest.mark.slow
def test_intervals_of_95_per_cent_hold_the_truth_in_90_to_98_of_100_fits():
    found = [bent(angles(np.random.default_rng(seed))) for seed in range(300)]
    held = np.mean([fit.low[0] <= ALPHA <= fit.high[0] for fit in found])
    assert 0.90 <= held <= 0.98
    assert np.mean([fit.noise["angle"] for fit in found]) == pytest.approx(0.02, rel=0.03)


def test_outliers_hardly_move_the_fit():
    found = bent(angles(np.random.default_rng(1), outliers=5))
    assert found.value[0] == pytest.approx(ALPHA, rel=0.03)
    assert found.low[0] <= ALPHA <= found.high[0]


def test_a_prior_counts_as_a_measurement():
    loose = bent(angles(np.random.default_rng(2), noise=0.3))
    tight = bent(angles(np.random.default_rng(2), noise=0.3),
                 prior="robot.curvature_per_pressure=4.2e-4+-0.01e-4")  # fmt: skip
    assert tight.error[0] == pytest.approx(0.01 / 4.2, rel=0.05)
    assert tight.error[0] < 0.3 * loose.error[0]
    assert tight.value[0] == pytest.approx(4.2e-4, rel=0.005)


def test_a_parameter_at_its_bound_is_named():
    found = bent(angles(np.random.default_rng(3)),
                 bounds="robot.curvature_per_pressure=4.5e-4..6e-4")  # fmt: skip
    assert at_bounds(found) == ["robot.curvature_per_pressure"]


def test_what_moves_together_unseen_is_named_with_its_exponents():
    """alpha = 6 H^2 c/(E t^3): bending tells E t^3 alone, and no group that bending knows moves."""
    base = {"robot": {"modulus": 2e6, "thickness": 4e-3}}
    series = angles(np.random.default_rng(4), noise=1e-3)
    found = estimate(Predictor(base, [series]), parameters(base, "robot.modulus,robot.thickness"))
    (open_,) = undetermined(found, base)
    assert open_.exponents["robot.thickness"] == pytest.approx(-1 / 3, abs=0.01)
    assert open_.exponents["robot.modulus"] == 1.0
    assert "alpha p L" in open_.same
    scene, _ = build(with_values(base, found.values))
    assert pneunet.curvature_per_pressure(scene.robot) == pytest.approx(ALPHA, rel=0.01)


def test_two_numbers_do_not_make_three_unknowns():
    series = Series("bend", "angle", 0.0, PRESSURE[:2], PRESSURE[:2], (Run(),), 0.05)
    base = {"robot": {"modulus": 2e6}}
    with pytest.raises(ValueError, match="more than the 3 unknowns, got 2"):
        estimate(Predictor(base, [series]),
                 parameters(base, "robot.modulus,robot.thickness,robot.width"))  # fmt: skip


WALK = {"ground": {"tip_force": 0.030, "shear_strength": 25.0},
        "numerics": {"links": 12, "timestep": 0.02, "cycles": 2}}  # fmt: skip
TRUTH = {"robot.modulus": 2.0e6, "surface.tip_force": 0.034, "surface.shear_strength": 20.0}
NOISE = 3e-4


def track(walk=by_mujoco, seed=0, noise=NOISE, offset=0.05, base=WALK):
    scene, numerics = build(with_values(base, TRUTH))
    motion = walk(scene, numerics, (0.0, 0.5, 1.0))
    rng = np.random.default_rng(seed)
    at = np.arange(0, scene.cycles * scene.gait.period, 1 / 30)
    return [
        Series(name, name, 0.0, at,
               offset + np.interp(at, motion.time, motion.x[:, i]) + rng.normal(0, noise, len(at)),
               (Run(),), 0.0, 0)
        for i, name in ((0, "left"), (2, "right"))
    ]  # fmt: skip


def fitted(seed):
    found = estimate(Predictor(WALK, track(seed=seed), numerics=coarse),
                     parameters(WALK, ",".join(TRUTH)))  # fmt: skip
    truth = np.array(list(TRUTH.values()))
    return found.value / truth - 1, (found.low <= truth) & (truth <= found.high)


def test_tracks_of_two_ends_give_modulus_and_both_bounds():
    off, _ = fitted(0)
    assert abs(off[0]) < 0.01
    assert abs(off[1:]).max() < 0.05


def test_the_datum_of_x_is_found():
    base = with_values(WALK, TRUTH)
    found = estimate(Predictor(base, track(noise=1e-5)), parameters(base, "robot.modulus"))
    assert found.offset[0] == pytest.approx(0.05, abs=1e-4)


@pytest.mark.slow
def test_tracks_of_the_quasi_static_model_are_fitted_by_it():
    once = {"ground": WALK["ground"]}
    found = estimate(Predictor(once, track(quasi_static, base=once), quasi_static),
                     parameters(once, "robot.modulus"))  # fmt: skip
    assert found.value[0] == pytest.approx(2.0e6, rel=0.02)


@pytest.mark.slow
def test_modulus_and_bounds_of_100_walks_are_in_their_intervals_as_often_as_these_say():
    with ProcessPoolExecutor(2) as pool:
        off, held = (np.array(part) for part in zip(*pool.map(fitted, range(100)), strict=True))
    assert np.mean(np.abs(off) < [0.01, 0.05, 0.05], axis=0).min() >= 0.95
    assert (held.mean(axis=0) >= 0.90).all()
    assert (held.mean(axis=0) <= 0.99).all()
