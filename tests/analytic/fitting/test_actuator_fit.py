"""Curves and loops made by plain, independent code are found again by the fit."""

import numpy as np
import pytest

from analytic import Bench, fit_actuator
from analytic.fitting.bench import check_function

TOP = 60e3  # Pa
TRIANGLES = TOP * np.interp(
    np.linspace(0, 6, 301), np.arange(7), [0.0, 1.0, 0.4, 0.8, 0.0, 1.0, 0.0]
)


def loop(path, plays):
    """Acting pressures by plays that stay within half their width of the pressure, from rest."""
    acting = np.zeros(len(path))
    for width, share in plays:
        state = width / 2
        for i, p in enumerate(path):
            if p - state > width / 2:
                state = p - width / 2
            elif state - p > width / 2:
                state = p + width / 2
            acting[i] += share * (state - p - width / 2)
    return path + acting


def bench(plays=(), noise=0.0, zero=0.0, seed=0, path=TRIANGLES):
    x = loop(path, plays) / TOP
    angle = 1.2 * x - 0.25 * x**2 + np.random.default_rng(seed).normal(0, noise, len(x)) + zero
    return Bench("bench.csv", path, angle)


def test_numbers_without_noise_are_those_that_the_data_were_made_with():
    fit = fit_actuator([bench([(12e3, 0.3)], zero=0.1)], zero="angle")
    assert fit.law == "quadratic"
    assert fit.shape == pytest.approx((1.2, 0.7), rel=1e-5)
    assert fit.play == pytest.approx((12e3,), rel=1e-5)
    assert fit.share == pytest.approx((0.3,), rel=1e-5)
    assert fit.zeros == pytest.approx((0.1,), abs=1e-6)
    actuator = fit.actuator(length=0.04)
    x = np.linspace(0, 1, 50)
    np.testing.assert_allclose(
        0.04 * actuator.curvature_at(TOP * x), 1.2 * x - 0.25 * x**2, atol=1e-4
    )


@pytest.mark.parametrize(
    ("width", "share", "noise"),
    [(3e3, 0.08, 0.001), (12e3, 0.3, 0.005), (24e3, 0.2, 0.01)],  # 0.4, 6, 8 % of the range
)
def test_intervals_hold_the_numbers_of_loops_with_noise(width, share, noise):
    inside = 0
    for seed in range(2):
        fit = fit_actuator([bench([(width, share)], noise, seed=seed)])
        assert len(fit.play) == 1
        numbers = {number.name: number for number in fit.numbers}
        for name, true in (("play 1", width), ("share 1", share)):
            low, high = numbers[name].interval
            inside += low <= true <= high
            assert high - low < 0.5 * true
        assert fit.rms == pytest.approx(noise, rel=0.2)
    assert inside >= 3  # of 4; one in twenty is outside


def test_as_many_plays_as_the_data_need_and_none_where_the_pressure_only_rises():
    two = [(3e3, 0.25), (25e3, 0.25)]
    assert len(fit_actuator([bench(two, 0.0005)]).play) == 2
    assert len(fit_actuator([bench(noise=0.005)]).play) == 0
    rising = np.linspace(0, TOP, 40)
    assert fit_actuator([bench([(12e3, 0.3)], 0.001, path=rising)]).play == ()


def test_files_share_a_curve_and_have_zeros_of_their_own():
    files = [bench(noise=0.002, zero=zero, seed=i) for i, zero in enumerate((0.0, 0.2, -0.1))]
    fit = fit_actuator(files, zero="angle")
    assert fit.zeros == pytest.approx((0.0, 0.2, -0.1), abs=2e-3)
    shifted = files[0]._replace(pressure=files[0].pressure + 2e3)
    fit = fit_actuator([shifted], zero="pressure")
    assert fit.zeros == pytest.approx((2e3,), abs=300)
    assert fit.reached == pytest.approx(TOP, abs=300)


def test_an_actuator_that_stiffens_follows_a_power_and_one_that_starts_late_starts_late():
    p = np.linspace(0, TOP, 9)
    assert fit_actuator([Bench("p", p, (p / TOP) ** 1.8)]).shape == pytest.approx((1, 1.8))
    late = np.maximum(p - p[2], 0) / (TOP - p[2])
    fit = fit_actuator([Bench("p", p[2:], late[2:] ** 1.5)])
    assert fit.start == p[2]
    assert fit.shape == pytest.approx((1, 1.5), rel=1e-4)
    assert fit.actuator(0.04).curvature_at(0.9 * p[2]) == 0


def test_a_late_start_is_found_in_noise_and_none_where_there_is_none():
    rng = np.random.default_rng(2)
    p = np.linspace(0, TOP, 80)
    for start in (0.0, 0.22 * TOP):
        angle = (np.maximum(p - start, 0) / (TOP - start)) ** 1.2 + rng.normal(0, 0.01, len(p))
        fit = fit_actuator([Bench("p", p, angle)])
        assert fit.start == pytest.approx(start, abs=0.03 * TOP)
        assert fit.worst < 0.04


def test_what_the_affine_law_misses_is_the_residual_of_a_line():
    data = bench(noise=0.002)
    fit = fit_actuator([data], law="affine", plays=0)
    line, *_ = np.linalg.lstsq(data.pressure[:, None], data.bend, rcond=None)
    assert fit.shape[0] / TOP == pytest.approx(line[0], rel=1e-6)
    assert fit.worst == pytest.approx(np.abs(data.pressure * line[0] - data.bend).max(), rel=1e-5)


def test_bends_that_are_no_function_of_the_pressure_are_refused_with_the_pressure():
    p = np.array([0, 5, 10, 15, 20, 20.6, 20.5]) * 1e3
    angle = np.radians([0, 20, 45, 75, 100, 107, 142])
    with pytest.raises(ValueError, match=r"a: .* 107 deg at 20\.6 kPa and 142 deg at 20\.5 kPa"):
        check_function(Bench("a", p, angle))
    with pytest.raises(ValueError, match=r"at 20\.6 kPa and 142 deg at 20\.7 kPa"):
        check_function(Bench("a", np.append(p[:-1], 20.7e3), angle))
    with pytest.raises(ValueError, match="must change"):
        check_function(Bench("a", np.full(3, 1e3), np.arange(3.0)))


def test_wide_loops_with_noise_are_functions_of_their_paths():
    for seed in range(5):
        check_function(bench([(24e3, 0.2)], 0.03, seed=seed))


def test_fewer_points_than_numbers_are_refused():
    with pytest.raises(ValueError, match="a fit of 3 numbers needs as many points, got 2"):
        fit_actuator([Bench("a", np.array([0, 1e3]), np.array([0.1, 1.0]))], zero="angle")
