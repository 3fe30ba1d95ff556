"""Least dissipation over all contacts: the convex problem, and what it does to long robots."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from analytic import (
    GAITS,
    SURFACES,
    Elastica,
    Friction,
    Gait,
    Robot,
    displacements,
    predict,
    solve_elastica,
    solve_modes,
)
from analytic.friction.contacts import contacts_of
from analytic.friction.dissipation import least_dissipation, minimisers
from analytic.friction.laws import slip_fraction

ALL = Friction(contacts="all")
contacts = st.lists(
    st.tuples(st.integers(0, 8).map(lambda i: i / 8), st.integers(-16, 16).map(lambda i: i / 16)),
    min_size=1, max_size=7,
).map(lambda pairs: np.array(pairs).T)  # fmt: skip


def dissipated(bounds, moves, whole):
    return float(bounds @ np.abs(whole + moves))


@given(contacts)
def test_no_motion_dissipates_less_by_linear_programming(drawn):
    """min sum V_j t_j over (dU, t) with t_j >= |dU + dX_j|."""
    bounds, moves = drawn
    count = len(bounds)
    rows = np.vstack([
        np.hstack([np.ones((count, 1)), -np.eye(count)]),
        np.hstack([-np.ones((count, 1)), -np.eye(count)]),
    ])  # fmt: skip
    exact = linprog(
        np.concatenate([[0.0], bounds]), A_ub=rows, b_ub=np.concatenate([-moves, moves]),
        bounds=[(None, None), *[(0, None)] * count],
    )  # fmt: skip
    least = dissipated(bounds, moves, least_dissipation(bounds, moves))
    assert least == pytest.approx(exact.fun, abs=1e-9)


@given(contacts)
def test_among_the_minimisers_the_slips_are_least_in_their_squares(drawn):
    """By brute force on a grid that holds every candidate."""
    bounds, moves = drawn
    grid = np.arange(-64, 65) / 32 / 1.0
    cost = np.array([dissipated(bounds, moves, whole) for whole in grid])
    best = grid[cost < cost.min() + 1e-12]
    going = least_dissipation(bounds, moves)
    low, high = minimisers(bounds, moves)
    assert low <= going <= high
    squares = ((best[:, None] + moves) ** 2).sum(axis=1)
    assert ((going + moves) ** 2).sum() <= squares.min() + 1e-12


@given(st.integers(0, 8), st.integers(0, 8), st.integers(-16, 16))
def test_two_contacts_are_the_rule_of_the_paper(left, right, change):
    bounds, moves = np.array([left, right]) / 8, np.array([0.0, change / 16])
    ruled = -slip_fraction(left / 8, right / 8) * change / 16
    assert least_dissipation(bounds, moves) == pytest.approx(ruled, abs=1e-15)


@pytest.mark.parametrize("surface", list(SURFACES))
@pytest.mark.parametrize("gait", ["wave", "pulse"])
def test_a_strip_on_its_two_ends_goes_as_by_the_anchor_rule(surface, gait):
    ground = SURFACES[surface]
    ends, everywhere = (
        predict(Robot(), GAITS[gait], ground, friction=friction).locomotion.per_cycle
        for friction in (Friction(), ALL)
    )
    # at its ends alone one with less than PASSIVE is a side, elsewhere a tip once its arch is told
    assert everywhere == pytest.approx(ends, abs=1e-6 * Robot().length)


# two waves of two inflated segments run along eight, each as long as those of the default robot
STAGES = tuple(tuple(1 if (j - k) % 4 in (0, 1) else 0 for j in range(8)) for k in range(9))
WAVES = Gait("two waves", STAGES)
LONG = Robot(length=0.13 * 8 / 3, weight_per_length=2.0, chamber_height=4.1e-3, segments=(1.0,) * 8)


@pytest.fixture(scope="module")
def shapes():
    path = WAVES.pressures(50) * LONG.peak_pressure
    return {links: solve_elastica(LONG, path, links=links) for links in (192, 384)}


@pytest.mark.slow
@pytest.mark.parametrize(("surface", "near"), [("felt", 0.01), ("gelatin", 0.1)])
def test_friction_between_the_ends_more_than_halves_the_way_of_a_long_robot(shapes, surface, near):
    """And the links are fine enough to say by how much."""
    ground = SURFACES[surface]
    ends = displacements(shapes[384], ground).per_cycle
    coarse, fine = (displacements(s, ground, friction=ALL).per_cycle for s in shapes.values())
    assert 0 < fine / ends < 0.5
    assert fine == pytest.approx(coarse, rel=near)


def between(shapes):
    """Nodes that push in each contact in the inner six of eight segments, of all states."""
    height, count = shapes.curve(shapes.nodes)[1], len(shapes.nodes)
    return [
        len(contact.nodes)
        for state in range(len(shapes))
        for contact in contacts_of(shapes, height, state)
        if count / 8 < contact.nodes[0] and contact.nodes[-1] < count * 7 / 8
    ]


def test_contacts_between_the_ends_are_points_at_full_pressure_however_fine_the_links(shapes):
    """So a contact of two nodes is a tip, and one of more may be a side."""
    for solved in shapes.values():
        assert max(between(solved)) == 2


def test_and_sides_of_a_length_of_their_own_at_lower_pressure():
    path = 0.6 * WAVES.pressures(10) * LONG.peak_pressure
    lengths = [
        max(between(solve_elastica(LONG, path, links=links))) / links for links in (96, 192, 384)
    ]
    assert lengths[0] > 5 / 96
    # to a link and a half at either end of the coarsest
    assert lengths == pytest.approx([lengths[-1]] * 3, abs=3 / 96)


@pytest.mark.parametrize("surface", list(SURFACES))
def test_the_reversed_gait_goes_the_opposite_way(surface):
    path = WAVES.pressures(20) * LONG.peak_pressure
    there = solve_elastica(LONG, path, links=96)
    # the same shapes in the opposite order, as where they were solved does not matter
    back = replace(
        there, separation=there.separation[::-1], contact_left=there.contact_left[::-1],
        contact_right=there.contact_right[::-1], force=there.force[::-1],
        pressures=there.pressures[::-1], curve=lambda s: [c[::-1] for c in there.curve(s)],
    )  # fmt: skip
    ground = SURFACES[surface]
    forward, backward = (displacements(s, ground, friction=ALL).per_cycle for s in (there, back))
    assert forward == pytest.approx(-backward, abs=1e-12)


def test_the_mirrored_gait_goes_the_mirrored_way():
    mirrored = Gait("mirrored", tuple(stage[::-1] for stage in STAGES))
    one, other = (
        predict(LONG, gait, SURFACES["gelatin"], Elastica(links=48), 10, friction=ALL)
        for gait in (WAVES, mirrored)
    )
    assert one.locomotion.right[-1] == pytest.approx(-other.locomotion.left[-1], rel=0.02)


def test_what_friction_at_all_contacts_cannot_do_is_refused():
    path = GAITS["wave"].pressures(10) * Robot().peak_pressure
    with pytest.raises(ValueError, match="forces"):
        displacements(solve_modes(Robot(), path), SURFACES["felt"], friction=ALL)
    with pytest.raises(ValueError, match="ends, all"):
        Friction(contacts="some")
