"""Intervals of a distance for what is not known: closed forms, an exact scaling, and a tie."""

import json

import numpy as np
import pytest
from walks import coarsen

from analytic.scene.surface import SURFACES
from mjsim.commands import run
from mjsim.files.scene_tables.tables import merged
from mjsim.uncertainty.fields import Fitted, Within, read_spreads, values_at
from mjsim.uncertainty.interval import (
    by_reference,
    distance_interval,
    interval_of,
    walks_for,
)
from mjsim.uncertainty.report import sentence

ONE, TWO = Within(("a",), (1.0,), 0.5), Within(("b",), (2.0,), 0.1)
BASE = merged({"ground": {"surface": "gelatin"}})


@pytest.fixture
def few_states(monkeypatch):
    coarsen(monkeypatch)


def walked(spreads, function, count=60):
    places = np.random.default_rng(3).uniform(-1, 1, (count, sum(s.axes for s in spreads)))
    return interval_of(spreads, places, function(*places.T))


def test_a_straight_line_has_the_interval_of_an_even_spread():
    interval = walked([ONE], lambda t: 3.0 + 2.0 * t)
    assert [interval.low, interval.high] == pytest.approx([3 - 1.9, 3 + 1.9], abs=0.03)
    assert interval.parts == pytest.approx({"a": 1.0})


def test_a_parabola_has_the_interval_of_a_square_of_an_even_spread():
    interval = walked([ONE], lambda t: t**2)
    assert [interval.low, interval.high] == pytest.approx([0.025**2, 0.975**2], abs=0.02)


def test_fields_cause_what_their_terms_have_of_the_variance():
    interval = walked([ONE, TWO], lambda t, u: t + 2.0 * u + 3.0 * t * u)
    exact = np.array([1 / 3, 4 / 3, 9 / 9])
    assert [*interval.parts.values(), interval.together] == pytest.approx(
        exact / exact.sum(), abs=0.02
    )


def test_what_no_quadratic_follows_stays_in_the_interval():
    """A jump at 0.5: a quarter is above it."""
    interval = walked([ONE], lambda t: np.where(t > 0.5, 1.0, 0.0), 200)
    assert interval.low == pytest.approx(0.0, abs=0.5)
    assert interval.high > 0.9
    assert interval.together > 0.2
    assert interval.directions["forward"] == pytest.approx(0.25, abs=0.1)


def test_two_parameters_of_a_fit_that_only_their_ratio_determines_leave_the_ratio_sure(tmp_path):
    path = tmp_path / "fit.json"
    rows = [
        {"name": "robot.modulus", "value": 2e6, "relative_error": 0.1},
        {"name": "surface.tip_force", "value": 0.03, "relative_error": 0.1},
    ]
    path.write_text(json.dumps({"parameters": rows, "correlation": [[1.0, 1.0], [1.0, 1.0]]}))
    spreads = read_spreads(BASE, str(path))
    (fitted,) = spreads
    assert isinstance(fitted, Fitted)
    places = fitted.coordinates(np.random.default_rng(0).random((4000, 2)))
    values = np.array([list(values_at(spreads, place).values()) for place in places])
    assert values[:, 0] / values[:, 1] == pytest.approx(2e6 / 0.03, rel=1e-7)
    assert np.log(values[:, 0]).std() == pytest.approx(0.1, rel=0.05)


@pytest.mark.usefixtures("few_states")
def test_all_forces_off_together_change_nothing():
    """Modulus, weight, pressure and bounds by one factor: the same shapes and the same slides."""
    names = ("robot.modulus", "robot.weight_per_length", "robot.peak_pressure",
             "surface.tip_force", "surface.shear_strength")  # fmt: skip
    spreads = read_spreads(BASE, f"{'+'.join(names)}=20%")
    interval = distance_interval(BASE, spreads)
    assert interval.high - interval.low < 1e-6
    assert "change nothing here" in sentence(interval).replace("changes", "change")


def test_a_derivative_says_what_a_sample_says_where_the_distance_is_straight():
    spreads = read_spreads(BASE, "robot.length=1%")  # which the distance is told over, too
    derived, sampled = (distance_interval(BASE, spreads, d) for d in (None, by_reference))
    assert (derived.how, sampled.how) == ("derivative", "sample")
    assert derived.walks < 5 < sampled.walks
    wide = sampled.high - sampled.low
    assert derived.low == pytest.approx(sampled.low, abs=0.1 * wide)
    assert derived.high == pytest.approx(sampled.high, abs=0.1 * wide)


def test_a_fit_s_derivatives_are_along_its_own_directions():
    fitted = Fitted(("a", "b"), (2.0, 5.0), ((0.1, 0.02), (0.0, 0.3)))
    slopes = fitted.slopes({"a": 3.0, "b": -1.0})
    step = 1e-6
    for axis in range(2):
        place = step * np.eye(2)[axis]
        ahead, back = fitted.at(place), fitted.at(-place)
        change = 3.0 * (ahead["a"] - back["a"]) - (ahead["b"] - back["b"])
        assert slopes[axis] == pytest.approx(change / (2 * step), rel=1e-6)


@pytest.mark.slow
@pytest.mark.usefixtures("few_states")
def test_where_the_bounds_tie_the_direction_is_not_known():
    base = merged({"ground": {"surface": "polyethylene"}})
    spreads = read_spreads(base, "surface.tip_force=20%, surface.shear_strength=20%")
    interval = distance_interval(base, spreads, centre=0.0)
    assert interval.low < -0.01 < 0.01 < interval.high
    assert interval.directions["forward"] > 0.2
    assert interval.directions["backward"] > 0.2
    assert interval.walks == walks_for(spreads)


@pytest.mark.usefixtures("few_states")
def test_a_run_prints_the_interval_and_what_causes_it(tmp_path, capsys):
    words = ["--surface", "gelatin", "--links", "6", "--timestep", "0.02", "--no-video"]
    uncertain = ["--uncertain", "robot.modulus=10%"]
    assert run.main([*words, *uncertain, "--json", "--out", str(tmp_path)]) == 0
    row = json.loads(capsys.readouterr().out)
    told = row["uncertain"]
    assert told["low_over_L"] < row["predicted_displacement_over_L"] < told["high_over_L"]
    assert told["parts_of_variance"] == pytest.approx({"robot.modulus": 1.0}, abs=0.01)
    assert told["without_distance"] == 0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (" ", "must name fields and how far they may be off"),
        ("robot.modulus", "must be name=size, such as surface.tip_force=20%"),
        ("robot.modulus=200%", "above 0 and at most 90 % of its value, got '200%'"),
        ("robot.modulus=1mm", "must be a number of Pa"),
        ("robot.modulus+robot.length=1mm", "must be in % of fields that are off together"),
        ("robot.modulus=5%,robot.modulus=10%", "each field once, got robot.modulus twice"),
        ("robot.colour=5%", "key 'colour' of [robot] is unknown"),
        ("robot.segments=5%", "uncertain: robot.segments is no number"),
        ("gait.lag=5%", "uncertain must be of robot, valves, surface"),
        ("surface.shear_strength=1Pa", "is 0 in the scene and cannot be off by 1Pa"),
        ("robot.rigidity=5%", "robot.rigidity: the scene gives it no value"),
        ("missing.json", "no such file"),
    ],
)
def test_what_cannot_be_uncertain_is_refused(text, words):
    with pytest.raises(ValueError, match=r"uncertain|key|robot\.modulus") as refusal:
        read_spreads(merged({"ground": {"surface": "gelatin"}}), text)
    assert words in str(refusal.value)


def test_of_what_is_given_in_other_terms_the_other_field_is_refused():
    base = merged({"robot": {"rigidity": "3e-4 N m^2"}})
    (spread,) = read_spreads(base, "robot.rigidity=10%")
    assert spread.values == pytest.approx((3e-4,))
    with pytest.raises(ValueError, match="rigidity or modulus must be given, not both"):
        read_spreads(base, "robot.modulus=10%")


def test_slow_valves_are_refused():
    base = merged({"valves": {"fill_time": 0.5}})
    with pytest.raises(ValueError, match="ideal valves"):
        distance_interval(base, read_spreads(base, "robot.modulus=5%"))


def test_a_ground_s_zeros_stay_zero():
    assert SURFACES["felt"].tip_force == 0.0
    spreads = read_spreads(merged({"ground": {"surface": "felt"}}), "surface.tip_force=20%")
    assert values_at(spreads, np.array([1.0])) == {"surface.tip_force": 0.0}
