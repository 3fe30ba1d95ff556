"""Robots of any number of segments of any lengths."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic import GAITS, SURFACES, Gait, Robot, predict, solve_elastica, solve_modes
from analytic.solvers.obstacle import solve_obstacle

THREE = Robot()
SPLIT = replace(THREE, segments=(1.0, 0.5, 0.5, 1.0))
UNEVEN = replace(THREE, segments=(2.0, 1.0, 3.0))
states = st.lists(st.tuples(*[st.integers(0, 16).map(lambda i: i / 16)] * 3), min_size=1,
                  max_size=4).map(np.array)  # fmt: skip


def split(fractions):
    """The same pressures, the middle segment's twice."""
    return np.asarray(fractions)[:, [0, 1, 1, 2]]


@pytest.mark.parametrize("solve", [solve_elastica, solve_obstacle])
@given(states)
@settings(max_examples=15)
def test_a_segment_in_two_parts_at_one_pressure_is_the_segment(solve, fractions):
    p = fractions * THREE.peak_pressure
    whole, parts = solve(THREE, p), solve(SPLIT, split(p))
    assert np.allclose(whole.separation, parts.separation, rtol=1e-7, equal_nan=True)
    assert np.allclose(whole.contact_left, parts.contact_left, atol=1e-6, equal_nan=True)


def test_so_it_walks_as_far():
    """On the same ground: its shear strength is per area, however the robot is described."""
    wave = GAITS["wave"]
    gait = Gait("wave", tuple(tuple(row) for row in split(wave.stages).tolist()))
    surface = SURFACES["polyethylene"]
    three, four = predict(THREE, wave, surface), predict(SPLIT, gait, surface)
    assert four.locomotion.per_cycle == pytest.approx(three.locomotion.per_cycle, rel=1e-6)


def test_the_mirror_image_of_an_uneven_robot_takes_mirrored_shapes():
    mirrored = replace(UNEVEN, segments=UNEVEN.segments[::-1])
    p = GAITS["wave"].pressures(5) * UNEVEN.peak_pressure
    there, back = solve_elastica(UNEVEN, p), solve_elastica(mirrored, p[:, ::-1])
    assert np.allclose(there.separation, back.separation, rtol=1e-7)
    assert np.allclose(there.contact_left, back.contact_right, atol=1e-6)


def test_links_that_straddle_uneven_borders_converge_to_those_that_do_not():
    p = GAITS["wave"].pressures(3) * UNEVEN.peak_pressure
    fine = solve_elastica(UNEVEN, p, links=240).separation
    errors = [
        np.abs(solve_elastica(UNEVEN, p, links=n).separation - fine).max() for n in (20, 40, 80)
    ]
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 1e-3 * UNEVEN.length


def test_the_modes_are_of_three_equal_segments_only():
    with pytest.raises(ValueError, match="three equal segments"):
        solve_modes(UNEVEN, (0, 0, 0))


@pytest.mark.parametrize("segments", [(), (1.0, 0.0), (1.0, np.nan)])
def test_segments_have_lengths(segments):
    with pytest.raises(ValueError, match="segments"):
        Robot(segments=segments)


def test_each_ramp_may_take_its_own_time():
    gait = Gait("odd", GAITS["wave"].stages, (1.0, 2.0, 0.5, 1.0, 3.0))
    ends = np.concatenate([[0.0], np.cumsum(gait.ramp_times)])
    assert gait.period == 7.5
    assert np.allclose(gait.fractions(ends), gait.stages)
    assert np.allclose(gait.fractions(ends + 2 * gait.period), gait.stages, atol=1e-12)
    back = gait.reversed().fractions(gait.period - np.linspace(0, 7.5, 40))
    assert np.allclose(back, gait.fractions(np.linspace(0, 7.5, 40)), atol=1e-12)
    with pytest.raises(ValueError, match="ramp_time"):
        Gait("bad", GAITS["wave"].stages, (1.0, 2.0))
