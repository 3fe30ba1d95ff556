"""The chain stands for the strip: its chord, its springs, and how fast both converge."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import fractions, robots

from analytic import Robot
from analytic.scene import pneunet
from analytic.scene.chain import joint_springs, link_lengths, node_positions, segment_overlap

links = st.integers(6, 96)


@given(links)
def test_links_add_up_to_the_strip_and_mirror(n):
    lengths = link_lengths(Robot(), n)
    assert len(lengths) == n + 1
    assert lengths.sum() == pytest.approx(0.13, rel=1e-14)
    assert np.allclose(lengths, lengths[::-1], rtol=1e-14)
    assert node_positions(Robot(), n)[-1] == pytest.approx(0.13, rel=1e-14)


def chord_error(n, total_angle):
    """Chord of a uniformly bent chain less that of the circular arc it stands for, over L."""
    direction = np.linspace(-0.5, 0.5, n + 1) * total_angle
    chord = link_lengths(Robot(length=1.0), n) @ np.cos(direction)
    return chord - np.sin(total_angle / 2) / (total_angle / 2)


@pytest.mark.parametrize(("sizes", "order"), [((6, 12, 24, 48), 4), ((7, 14, 28, 56), 2)])
def test_the_chord_of_an_arc_converges_at_its_order(sizes, order):
    errors = np.abs([chord_error(n, 2.0) for n in sizes])
    rates = np.log2(errors[:-1] / errors[1:])
    assert np.allclose(rates, order, atol=0.15)
    assert errors[-1] < (1e-6 if order == 4 else 5e-4)


@given(links)
def test_elements_are_shared_out_among_segments_without_loss(n):
    overlap = segment_overlap(Robot().borders, n)
    assert np.allclose(overlap.sum(axis=1), 1)
    assert np.allclose(overlap.sum(axis=0), n / 3)


@given(robots, links, fractions, st.floats(-0.3, 0.3))
def test_a_bending_moment_turns_the_chain_as_it_turns_the_strip(robot, n, fraction, part):
    """Series combination across borders: the angle is exact for any number of links."""
    p = np.array([fraction]) * robot.peak_pressure
    stiffness, rest = joint_springs(robot, n, p)
    moment = part * pneunet.base_rigidity(robot) / robot.length
    chain = (rest[0] + moment / stiffness[0]).sum()
    turn = moment / pneunet.rigidity(robot, p) - pneunet.natural_curvature(robot, p)
    assert chain == pytest.approx(float(turn.sum()) * robot.length / 3, abs=1e-9)


def test_no_pressure_means_straight_joints_of_the_base_rigidity():
    stiffness, rest = joint_springs(Robot(), 24, np.zeros((1, 3)))
    element = Robot().length / 24
    assert np.allclose(stiffness, pneunet.base_rigidity(Robot()) / element)
    assert (rest == 0).all()
