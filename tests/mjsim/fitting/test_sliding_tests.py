"""Numbers of a ground from tilt and pull tests, against closed forms that made the readings."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.stats

from analytic import SURFACES, Gait
from mjsim.fitting.sliding_bounds import quantities, samples
from mjsim.fitting.sliding_tests import Reading, read_tests
from mjsim.results.status import Status
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate

SEEDS = 200
RIGHT = (180, 199)  # of 200 intervals of 95 %: all but 1 in 500 such counts (binomial)
G = 9.81
DEGREE = math.radians(1.0)
AREA, TAU, MU, TIP = 1.7e-3, 20.0, 0.4, 0.034
WIDE = (0.004, 0.004, 0.009, 0.009, 0.02, 0.02)  # kg: loads of a sample


def tilts(rng, masses, bound, mu, way="ahead", noise=DEGREE):
    """Angles at which m g sin(angle) is the bound and mu times m g cos(angle)."""
    for mass in masses:
        weight = mass * G
        # weight sin(a) - mu weight cos(a) = bound, by R sin(a - atan(mu))
        angle = math.atan(mu) + math.asin(bound / (weight * math.hypot(1, mu)))
        yield Reading("tilt", angle + rng.normal(0, noise), weight, AREA, "side", way, "begins")


def pulls(rng, masses, bound, mu, size=1.0, contact="tip", noise=0.002):
    for mass in masses:
        force = bound * size + mu * mass * G + rng.normal(0, noise)
        yield Reading("pull", force, mass * G, size, contact, "ahead", "begins")


def own_scatter(rng, masses, mu, part=0.08):
    """Pulls whose scatter is in proportion to the force, as friction's own."""
    for mass in masses:
        force = mu * mass * G * (1 + rng.normal(0, part))
        yield Reading("pull", force, mass * G, 1, "tip", "ahead", "begins")


KINDS = {
    "a bound by tilting": (lambda r: tilts(r, [0.012] * 5, TAU * AREA, 0), "shear_strength", TAU),
    "a bound by tilting two masses": (
        lambda r: tilts(r, [0.006] * 3 + [0.02] * 3, TAU * AREA, 0), "shear_strength", TAU),
    "mu by tilting": (lambda r: tilts(r, [0.012] * 5, 0, MU), "friction", MU),
    "mu by tilting three masses": (lambda r: tilts(r, WIDE, 0, MU), "friction", MU),
    "a tip's bound by pulling": (lambda r: pulls(r, [0.007] * 4, TIP, 0), "tip_force", TIP),
    "mu of a tip by three loads": (lambda r: pulls(r, WIDE, 0, MU), "tip_friction", MU),
    "mu of a tip by three loads, scatter as the force": (
        lambda r: own_scatter(r, WIDE + WIDE, MU), "tip_friction", MU),
    "a bound across": (lambda r: tilts(r, [0.012] * 5, TAU * AREA, 0, "across"),
                       "shear_strength_across", TAU),
    "a bound by tilting and by pulling": (
        lambda r: [*tilts(r, [0.012] * 5, TAU * AREA, 0),
                   *pulls(r, [0.012] * 5, TAU, 0, AREA, "side", 0.004)], "shear_strength", TAU),
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_intervals_hold_the_truth_at_their_rate(kind):
    make, name, truth = KINDS[kind]
    held, errors = 0, []
    for seed in range(SEEDS):
        by_name = {q.name: q for q in quantities(samples(make(np.random.default_rng(seed))))}
        one = by_name[name]
        low, high = one.estimate.interval
        held += low <= truth <= high
        errors.append(one.estimate.value / truth - 1)
    assert RIGHT[0] <= held <= RIGHT[1]
    assert abs(np.mean(errors)) < 3 * np.std(errors) / math.sqrt(SEEDS) + 2e-3


@pytest.mark.parametrize("test", [tilts, pulls])
@pytest.mark.parametrize(
    ("bound", "mu", "law"), [(1.0, 0.0, "constant"), (0.0, 1.0, "coulomb"), (0.5, 0.6, "both")]
)
def test_loads_tell_which_law_holds_and_both_slopes_are_within_their_intervals(
    test, bound, mu, law
):
    laws, held = [], np.zeros(2, dtype=int)
    bound, mu = 0.034 * bound, 0.4 * mu
    for seed in range(SEEDS):
        readings = [*test(np.random.default_rng(seed), WIDE, bound, mu)]
        (sample,) = samples(readings)
        laws.append(sample.verdict.law)
        size = AREA if test is tilts else 1.0
        for part, truth in enumerate((bound / size, mu)):
            low, high = sample.verdict[2 + part].interval
            held[part] += low <= truth <= high
    assert laws.count(law) >= 0.95 * SEEDS
    assert (held >= RIGHT[0]).all()


def test_intervals_of_repeats_are_those_of_students_t():
    angles = np.radians([31.0, 28.5, 30.2, 33.0])
    weight = 0.012 * G
    readings = [Reading("tilt", a, weight, AREA, "side", "back", "begins") for a in angles]
    (bound, _) = quantities(samples(readings))
    expected = scipy.stats.ttest_1samp(weight * np.sin(angles) / AREA, 0.0).confidence_interval()
    assert (bound.low, bound.high) == pytest.approx(tuple(expected), rel=1e-9)
    forces = np.array([0.031, 0.036, 0.033])
    readings = [Reading("pull", f, weight, 2, "tip", "ahead", "slides") for f in forces]
    bound, coefficient = quantities(samples(readings))
    for each, numbers in ((bound, forces / 2), (coefficient, forces / weight)):
        expected = scipy.stats.ttest_1samp(numbers, 0.0).confidence_interval()
        assert (each.low, each.high) == pytest.approx(tuple(expected), rel=1e-9)


def test_tests_that_differ_beyond_their_scatter_give_an_interval_that_spans_both():
    rng = np.random.default_rng(1)
    readings = [*tilts(rng, [0.012] * 5, TAU * AREA, 0),
                *pulls(rng, [0.012] * 5, 1.4 * TAU, 0, AREA, "side")]  # fmt: skip
    bound = quantities(samples(readings))[0]
    assert bound.apart
    assert bound.low < TAU < 1.4 * TAU < bound.high
    assert bound.estimate.value == pytest.approx(1.2 * TAU, rel=0.05)


def test_what_a_reading_does_not_say_gives_no_number():
    def names(readings):
        return {q.name for q in quantities(samples(readings))}

    nan = math.nan
    assert names([Reading("tilt", 0.5, nan, nan, "side", "ahead", "begins")]) == {"friction"}
    assert names([Reading("tilt", 0.5, nan, AREA, "side", "ahead", "begins")]) == {"friction"}
    assert names([Reading("pull", 0.5, nan, AREA, "side", "back", "begins")]) == {
        "shear_strength_back"}  # fmt: skip
    assert not names([Reading("pull", 0.5, nan, nan, "side", "ahead", "begins")])


def test_a_file_and_options_give_the_same_readings(tmp_path):
    path = tmp_path / "tests.csv"
    path.write_text("angle [deg],mass [g],width [mm],length [mm],way\n30,12,40,43,\n31,12,40,43,\n")
    shared = {"mass": "12 g", "width": "40mm", "length": "43 mm"}
    one = read_tests([path], {}, {}).readings
    two = read_tests([], shared, {"angle": "30, 31deg"}).readings
    bare = tmp_path / "bare.csv"
    bare.write_text("angle [rad]\n" + "\n".join(str(math.radians(a)) for a in (30, 31)))
    three = read_tests([bare], shared, {}).readings
    numbers = [[(r.value, r.load, r.size) for r in readings] for readings in (one, two, three)]
    assert np.array(numbers[0]) == pytest.approx(np.array(numbers[1]))
    assert np.array(numbers[0]) == pytest.approx(np.array(numbers[2]))
    assert numbers[0][0] == pytest.approx((math.radians(30), 0.012 * G, 0.04 * 0.043))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("law", "down"), [("constant", -1.0), ("constant", 1.0), ("coulomb", -1.0)]
)
def test_a_strip_on_a_slope_in_mujoco_gives_back_what_holds_it(law, down):
    """By halving the angle between a slope that it stays on and one that it slides down."""
    surface = replace(SURFACES["felt"], shear_strength=5.0, shear_strength_back=7.0, friction=0.1,
                      friction_back=0.15)  # fmt: skip
    still = Gait("still", ((0, 0, 0), (0, 0, 0)), 2.0)
    scene = Scene(gait=still, ground=surface, contacts="all", cycles=1, friction=law)
    held, slid = 0.0, math.radians(20)
    while slid - held > math.radians(0.1):
        middle = 0.5 * (held + slid)
        walk = simulate(replace(scene, slope=-down * middle))
        held, slid = (held, middle) if walk.status is Status.SLID else (middle, slid)
    robot, way = scene.robot, "ahead" if down > 0 else "back"
    angle, area = 0.5 * (held + slid), robot.width * robot.length
    readings = [Reading("tilt", angle, robot.weight, area, "side", way, "begins")]
    (told,) = (q for q in quantities(samples(readings)) if q.law == law)
    assert told.estimate.value == pytest.approx(surface.resistance(told.name), rel=0.02)
