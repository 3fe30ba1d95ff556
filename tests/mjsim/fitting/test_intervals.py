"""Intervals where slopes mislead: kinks, flats, parameters seen together, models that miss."""

import math

import numpy as np
import pytest

from mjsim.fitting.estimate import estimate
from mjsim.fitting.observations import Run, Series
from mjsim.fitting.parameters import parameters
from mjsim.fitting.report import doubts_of
from mjsim.fitting.walks import Motion, Predictor

GROUND = {"ground": {"friction": 0.4, "tip_friction": 0.6}, "numerics": {"friction": "coulomb"}}
TIME = np.linspace(0.0, 10.0, 200)
NOISE = 2e-4
BENDING = {"robot": {"curvature_per_pressure": 5e-4}}
PRESSURE = np.linspace(1e3, 5e4, 60)
ALPHA, LENGTH = 4.2e-4, 0.05


def motion(places, distance):
    x = np.outer(distance * TIME / TIME[-1], np.ones(len(places)))
    return Motion(TIME, x, 0 * x, places, distance, 0.0, 0.0, TIME[-1])


def track(walk, scene_values, seed=0):
    rng = np.random.default_rng(seed)
    x = walk(scene_values)
    return [Series("left", "left", 0.0, TIME, x * TIME / TIME[-1] + rng.normal(0, NOISE, len(TIME)),
                   (Run(),), 0.0, 0)]  # fmt: skip


def saturating(friction):
    """Distance that grows with friction until another end begins to slide, and no more then [m]."""
    return 0.02 * min(friction / 0.5, 1.0)


def bends(angle, pressure=PRESSURE):
    return Series("bend", "angle", 0.0, pressure, angle, (Run(),), LENGTH)


def slope(angle, pressure=PRESSURE, **more):
    free = parameters(BENDING, "robot.curvature_per_pressure", **more)
    return estimate(Predictor(BENDING, [bends(angle, pressure)]), free)


@pytest.mark.parametrize("seed", range(3))
def test_a_cost_that_is_flat_beyond_a_kink_sets_no_upper_limit(seed):
    """Slopes at the kink tell 0.5 within 2 %; the truth is 0.8."""

    def walk(scene, numerics, places):
        return motion(places, saturating(scene.ground.friction))

    data = track(saturating, 0.8, seed)
    fit = estimate(Predictor(GROUND, data, walk),
                   parameters(GROUND, "surface.friction", "surface.friction=0.3"))  # fmt: skip
    assert fit.low[0] == pytest.approx(0.5, rel=0.03)
    assert fit.high[0] == math.inf
    assert any("no upper limit" in note for note in doubts_of(fit, GROUND).notes)


@pytest.mark.parametrize("seed", range(3))
def test_a_minimum_at_a_kink_has_the_interval_of_the_cost_itself(seed):
    """Distance that falls on either side of the truth: the likelihood in closed form."""

    def tent(friction):
        return 0.02 - 0.004 * abs(math.log(friction / 0.8))

    def walk(scene, numerics, places):
        return motion(places, tent(scene.ground.friction))

    fit = estimate(Predictor(GROUND, track(tent, 0.8, seed), walk),
                   parameters(GROUND, "surface.friction", "surface.friction=0.5"))  # fmt: skip
    assert fit.low[0] <= 0.8 <= fit.high[0]
    assert 0.5 < fit.low[0] < 0.81
    assert 0.79 < fit.high[0] < 1.3


def test_a_parameter_at_its_bound_leaves_the_interval_of_another_open_on_both_sides():
    """Both make the distance, and friction cannot go on where it should for the other's sake."""

    def along(modulus, friction):
        ramp = TIME / TIME[-1]
        return 0.02 * friction * ramp + 0.004 * math.log(modulus / 2e6) * (
            ramp + 0.2 * np.sin(TIME)
        )

    def walk(scene, numerics, places):
        x = along(scene.robot.modulus, scene.ground.friction)
        return motion(places, 0.0)._replace(x=np.outer(x, np.ones(len(places))))

    measured = along(2.1e6, 0.7) + np.random.default_rng(0).normal(0, NOISE, len(TIME))
    data = [Series("left", "left", 0.0, TIME, measured, (Run(),), 0.0, 0)]
    free = parameters(GROUND, "robot.modulus,surface.friction", "robot.modulus=2MPa",
                      "surface.friction=0.3..0.7")  # fmt: skip
    fit = estimate(Predictor(GROUND, data, walk), free)
    assert fit.low[0] < 0.999 * fit.value[0]
    assert fit.high[0] > 1.001 * fit.value[0]
    assert fit.low[0] <= 2.1e6 <= fit.high[0]


def test_of_parameters_seen_together_the_combination_alone_is_told():
    """Distance goes by the ratio of both bounds, and hardly anything by their product."""
    base = {"ground": {"tip_force": 0.03, "shear_strength": 20.0}}

    def places_along(tip, shear):
        return (0.02 * math.log(1e4 * tip / shear) * TIME / TIME[-1]
                + 4e-4 * math.log(tip * shear) * np.sin(TIME))  # fmt: skip

    def walk(scene, numerics, places):
        x = places_along(scene.ground.tip_force, scene.ground.shear_strength)
        return motion(places, 0.0)._replace(x=np.outer(x, np.ones(len(places))))

    measured = places_along(0.034, 19.6) + np.random.default_rng(0).normal(0, NOISE, len(TIME))
    data = [Series("left", "left", 0.0, TIME, measured, (Run(),), 0.0, 0)]
    fit = estimate(Predictor(base, data, walk),
                   parameters(base, "surface.tip_force,surface.shear_strength"))  # fmt: skip
    doubts = doubts_of(fit, base)
    (combination,) = doubts.combinations
    tip, shear = (combination.exponents[f"surface.{n}"] for n in ("tip_force", "shear_strength"))
    assert (abs(tip), abs(shear), tip * shear) == (1.0, 1.0, -1.0)
    true = (0.034 / 19.6) ** tip
    assert abs(combination.value / true - 1) < 3 * combination.error < 0.3 * fit.error.min()
    assert doubts.withheld == {"surface.tip_force", "surface.shear_strength"}


def test_a_law_that_misses_the_data_has_no_interval():
    """Bending that softens, beside a law of constant slope."""
    angle = ALPHA * LENGTH * PRESSURE * (1 + PRESSURE / 5e4)
    fit = slope(angle + np.random.default_rng(0).normal(0, 0.01, len(PRESSURE)))
    assert fit.misfit.withheld
    assert np.isnan([fit.low[0], fit.high[0]]).all()
    assert "intervals are withheld" in doubts_of(fit, BENDING).notes[0]


def test_hysteresis_along_a_log_is_a_misfit_though_pressures_order_hides_it():
    up_and_down = np.concatenate([PRESSURE, PRESSURE[::-1]])
    lag = np.repeat([-0.05, 0.05], len(PRESSURE))
    noise = np.random.default_rng(0).normal(0, 0.01, len(lag))
    fit = slope(ALPHA * LENGTH * up_and_down + lag + noise, up_and_down)
    assert fit.misfit.withheld


def test_residuals_of_the_numerics_are_no_misfit():
    fit = slope(ALPHA * LENGTH * PRESSURE + 1e-7 * (PRESSURE / 5e4) ** 2)
    assert not fit.misfit.withheld
    assert fit.misfit.inflation == 1.0
    assert doubts_of(fit, BENDING).notes == []


def test_noise_that_a_filter_smoothed_widens_the_interval_by_what_is_known_of_it():
    """Moving averages of 5 tell a fifth as much: intervals are sqrt(5) as wide."""
    pressure = np.linspace(1e3, 5e4, 2000)
    white = np.random.default_rng(0).normal(0, 0.02, len(pressure) + 4)
    smooth = np.convolve(white, np.full(5, 0.2), "valid")
    fit = slope(ALPHA * LENGTH * pressure + smooth, pressure)
    assert not fit.misfit.withheld
    assert fit.misfit.inflation == pytest.approx(5, rel=0.3)
    assert fit.low[0] <= ALPHA <= fit.high[0]


@pytest.mark.slow
def test_intervals_from_smoothed_noise_hold_the_truth_in_90_to_99_of_100_fits():
    pressure = np.linspace(1e3, 5e4, 600)
    held = []
    for seed in range(200):
        white = np.random.default_rng(seed).normal(0, 0.02, len(pressure) + 3)
        fit = slope(ALPHA * LENGTH * pressure + np.convolve(white, np.full(4, 0.25), "valid"),
                    pressure)  # fmt: skip
        held.append(fit.low[0] <= ALPHA <= fit.high[0])
    assert 0.90 <= np.mean(held) <= 0.99


def test_few_independent_errors_are_seldom_called_a_misfit():
    held = [slope(ALPHA * LENGTH * PRESSURE[::5] + np.random.default_rng(s).normal(0, 0.03, 12),
                  PRESSURE[::5]).misfit.withheld for s in range(8)]  # fmt: skip
    assert sum(held) == 0
