"""Least squares with intervals that hold, on models in closed form and on walks."""

import numpy as np
import pytest
from many_seeds import BASE, TRUTH, fits, track

from analytic.scene import pneunet
from mjsim.files.scene_tables.tables import build
from mjsim.fitting.determined import at_bounds, undetermined
from mjsim.fitting.estimate import estimate
from mjsim.fitting.observations import Run, Series
from mjsim.fitting.parameters import parameters, with_values
from mjsim.fitting.walks import Predictor, quasi_static

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
    fit = bent(series)
    x = series.at * 0.05
    slope = x @ series.value / (x @ x)
    left = series.value - slope * x
    error = np.sqrt(left @ left / (len(x) - 1) / (x @ x))
    assert fit.value[0] == pytest.approx(slope, abs=error / 2)
    assert fit.error[0] * slope == pytest.approx(error, rel=0.25)


@pytest.mark.slow
def test_intervals_of_95_per_cent_hold_the_truth_in_90_to_98_of_100_fits():
    fitted = [bent(angles(np.random.default_rng(seed))) for seed in range(300)]
    held = np.mean([fit.low[0] <= ALPHA <= fit.high[0] for fit in fitted])
    assert 0.90 <= held <= 0.98
    assert np.mean([fit.noise["angle"] for fit in fitted]) == pytest.approx(0.02, rel=0.03)


def test_outliers_hardly_move_the_fit():
    fit = bent(angles(np.random.default_rng(1), outliers=5))
    assert fit.value[0] == pytest.approx(ALPHA, rel=0.03)
    assert fit.low[0] <= ALPHA <= fit.high[0]


def test_a_prior_counts_as_a_measurement():
    loose = bent(angles(np.random.default_rng(2), noise=0.3))
    tight = bent(angles(np.random.default_rng(2), noise=0.3),
                 prior="robot.curvature_per_pressure=4.2e-4+-0.01e-4")  # fmt: skip
    assert tight.error[0] == pytest.approx(0.01 / 4.2, rel=0.05)
    assert tight.error[0] < 0.3 * loose.error[0]
    assert tight.value[0] == pytest.approx(4.2e-4, rel=0.005)


def test_a_parameter_at_its_bound_is_named():
    fit = bent(angles(np.random.default_rng(3)),
                 bounds="robot.curvature_per_pressure=4.5e-4..6e-4")  # fmt: skip
    assert at_bounds(fit) == ["robot.curvature_per_pressure"]


def test_what_moves_together_unseen_is_named_with_its_exponents():
    """alpha = 6 H^2 c/(E t^3): bending tells E t^3 alone, and no group that bending knows moves."""
    base = {"robot": {"modulus": 2e6, "thickness": 4e-3}}
    series = angles(np.random.default_rng(4), noise=1e-3)
    fit = estimate(Predictor(base, [series]), parameters(base, "robot.modulus,robot.thickness"))
    (open_,) = undetermined(fit, base)
    assert open_.exponents["robot.thickness"] == pytest.approx(-1 / 3, abs=0.01)
    assert open_.exponents["robot.modulus"] == 1.0
    assert "alpha p L" in open_.same
    scene, _ = build(with_values(base, fit.values))
    assert pneunet.curvature_per_pressure(scene.robot) == pytest.approx(ALPHA, rel=0.01)


def test_two_numbers_do_not_make_three_unknowns():
    series = Series("bend", "angle", 0.0, PRESSURE[:2], PRESSURE[:2], (Run(),), 0.05)
    base = {"robot": {"modulus": 2e6}}
    with pytest.raises(ValueError, match="more than the 3 unknowns, got 2"):
        estimate(Predictor(base, [series]),
                 parameters(base, "robot.modulus,robot.thickness,robot.width"))  # fmt: skip


def test_the_datum_of_x_is_found():
    base = with_values(BASE, TRUTH)
    fit = estimate(Predictor(base, track(noise=1e-5)), parameters(base, "robot.modulus"))
    assert fit.offset[0] == pytest.approx(0.05, abs=1e-4)


@pytest.mark.slow
def test_tracks_of_the_quasi_static_model_are_fitted_by_it(monkeypatch):
    monkeypatch.setattr("mjsim.fitting.walks._STATES", 20)
    once = {"ground": BASE["ground"]}
    fit = estimate(Predictor(once, track(quasi_static, base=once), quasi_static),
                     parameters(once, "robot.modulus"))  # fmt: skip
    assert fit.value[0] == pytest.approx(2.0e6, rel=0.02)


@pytest.mark.slow
def test_tracks_of_two_ends_give_modulus_and_bounds_in_their_intervals_as_often_as_these_say():
    """Five seeds; benchmarks/many_seeds.csv holds a hundred."""
    rows = [row for seed in range(1, 6) for row in fits(seed)]
    allowed = {"modulus": 0.01, "tip_force": 0.05, "shear_strength": 0.05}
    for row in rows:
        assert row.error < allowed[row.claim.rpartition(".")[2]], row
    assert sum(row.holds for row in rows) >= 12  # of 15; chance gives fewer once in 200
