"""Markers that no body can show are refused, and what is wrong with a film is named."""

import numpy as np
import pytest

from mjsim.fitting.markers import check_places, film
from mjsim.fitting.observations import Run, Series

BASE = {"robot": {"length": 0.13}, "gait": {"name": "wave", "ramp_time": 1.0}}  # of 5 s
PERIOD = 5.0
TIME = np.linspace(0, 4 * PERIOD, 400)


def track(scale=1.0, speed=1.0, order=1.0):
    """Both ends and the middle of a body of 130 mm that shortens by a tenth on its way."""
    phase = 2 * np.pi * TIME * speed / PERIOD
    bend = 0.05 * (1 - np.cos(phase)) + 0.01 * (1 - np.cos(2 * phase))
    ends = {"left": 0.2 + 1e-3 * TIME, "right": 0.2 + 1e-3 * TIME + 0.13 * (1 - bend)}
    ends["x"] = 0.5 * (ends["left"] + ends["right"])
    return tuple(
        Series(f"film.csv: {name}", name, 0.5 if name == "x" else 0.0, TIME,
               order * scale * place, (Run(),), offset=0)
        for name, place in ends.items()
    )  # fmt: skip


def test_markers_of_the_body_are_let_through():
    check_places(track(), BASE, {"robot.modulus": 2e6})
    check_places(track(scale=10), BASE, {"robot.length": 0.13})


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"scale": 10.0}, "are 6.* mm apart in most rows, and the body between them is 65 mm"),
        ({"order": -1.0}, "film.csv: left and x are in the wrong order"),
    ],
)
def test_markers_farther_apart_than_the_body_or_in_another_order_are_refused(given, words):
    with pytest.raises(ValueError, match=words):
        check_places(track(**given), BASE, {"robot.modulus": 2e6})


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, None),
        ({"scale": 0.8}, "is a pixel 1.25 times as large"),
        ({"speed": 2.0}, "repeat after 2.5 s, and the gait after 5 s"),
        ({"speed": 0.5}, "repeat after 10 s, and the gait after 5 s"),
    ],
)
def test_a_wrong_scale_and_a_wrong_clock_are_told(given, words):
    said = film(track(**given), [series.value for series in track()], BASE, {})
    assert len(said) == (words is not None)
    assert words is None or words in said[0]


def test_a_robot_that_stands_still_repeats_nothing():
    still = [series._replace(value=np.full(len(TIME), 0.1 * k)) for k, series in enumerate(track())]
    assert film(still, [series.value for series in still], BASE, {}) == []
