"""Least dissipation in the plane: balance, symmetry, and the rule along a line."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from analytic.friction.dissipation import least_dissipation
from analytic.friction.dissipation_in_plane import least_dissipation_in_plane

SEEDS = st.integers(0, 2**32 - 1)


def draw(seed, count=None):
    rng = np.random.default_rng(seed)
    count = count or int(rng.integers(2, 9))
    bounds = rng.uniform(0.0, 1.0, count) * (rng.random(count) > 0.1) + 0.01
    return bounds, rng.uniform(-0.1, 0.1, (count, 2)), 1e-3 * rng.standard_normal((count, 2))


def turned(vectors, angle):
    c, s = np.cos(angle), np.sin(angle)
    return vectors @ np.array([[c, s], [-s, c]])


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_no_other_motion_dissipates_less(seed):
    bounds, places, moves = draw(seed)
    found = least_dissipation_in_plane(bounds, places, moves)

    def slips(at):
        turned = np.column_stack([-places[:, 1], places[:, 0]])
        return moves + at[:2] * 1e-3 + at[2] * 1e-2 * turned

    def dissipated(at):
        return 1e3 * bounds @ np.hypot(*slips(at).T)

    start = np.append(found.shift * 1e3, found.turn * 1e2)
    assert slips(start) == pytest.approx(found.slip, rel=1e-9, abs=1e-12)
    rng = np.random.default_rng(seed)
    for _ in range(3):
        other = minimize(dissipated, start + rng.standard_normal(3), method="Nelder-Mead",
                         options={"xatol": 1e-7, "fatol": 1e-11, "maxiter": 2000})  # fmt: skip
        assert dissipated(start) <= other.fun * (1 + 1e-7) + 1e-9


@settings(max_examples=60, deadline=None)
@given(SEEDS)
def test_forces_of_sliding_contacts_are_balanced_by_what_the_held_ones_can_bear(seed):
    bounds, places, moves = draw(seed)
    found = least_dissipation_in_plane(bounds, places, moves)
    size = np.hypot(*found.slip.T)
    slides = size > 1e-6 * np.abs(moves).max()
    force = np.where(slides[:, None], -found.slip / np.maximum(size, 1e-300)[:, None], 0.0)
    force *= bounds[:, None]
    held = np.flatnonzero(~slides)
    missing = -np.array([*force.sum(axis=0), np.sum(places[:, 0] * force[:, 1]
                                                    - places[:, 1] * force[:, 0])])  # fmt: skip
    if not len(held):
        assert np.abs(missing).max() < 1e-5 * bounds.max()
        return
    # the held ones: the least of their forces over their bounds that balances the rest
    lever = np.zeros((3, 2 * len(held)))
    lever[0, 0::2] = lever[1, 1::2] = 1.0
    lever[2, 0::2], lever[2, 1::2] = -places[held, 1], places[held, 0]
    scale = np.repeat(bounds[held], 2)
    share = np.linalg.lstsq(lever * scale, missing, rcond=None)[0]
    assert np.abs(lever @ (scale * share) - missing).max() < 1e-5 * bounds.max()
    if len(held) == 1:
        assert np.hypot(*share) <= 1 + 1e-5


@settings(max_examples=40, deadline=None)
@given(SEEDS, st.floats(-3, 3), st.floats(0.1, 10), st.floats(0.1, 10))
def test_a_turned_moved_and_scaled_scene_moves_alike(seed, angle, stronger, farther):
    bounds, places, moves = draw(seed)
    one = least_dissipation_in_plane(bounds, places, moves)
    two = least_dissipation_in_plane(
        stronger * bounds,
        turned(places, angle) + np.array([0.3, -0.2]),
        farther * turned(moves, angle),
    )
    lost = [bounds @ np.hypot(*motion.slip.T) for motion in (one, two)]
    assert lost[1] == pytest.approx(farther * lost[0], rel=1e-6)
    assert two.slip == pytest.approx(farther * turned(one.slip, angle), abs=2e-8 * farther)
    assert two.turn == pytest.approx(farther * one.turn, abs=1e-6 * farther)


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_a_mirrored_scene_turns_the_other_way(seed):
    bounds, places, moves = draw(seed)
    one = least_dissipation_in_plane(bounds, places, moves)
    two = least_dissipation_in_plane(bounds, places * [1, -1], moves * [1, -1])
    assert two.turn == pytest.approx(-one.turn, abs=1e-7)
    assert two.slip == pytest.approx(one.slip * [1, -1], abs=1e-8)


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_along_a_line_it_is_the_weighted_median(seed):
    bounds, places, moves = draw(seed)
    places[:, 1], moves[:, 1] = 0.0, 0.0
    found = least_dissipation_in_plane(bounds, places, moves)
    assert found.turn == pytest.approx(0, abs=1e-9)
    assert found.shift[0] == pytest.approx(least_dissipation(bounds, moves[:, 0]), abs=1e-8)
    assert found.shift[1] == pytest.approx(0, abs=1e-9)


def test_two_pairs_of_equal_feet_that_part_slide_alike():
    places = np.array([[0.0, 0.02], [0.0, -0.02], [0.13, 0.02], [0.13, -0.02]])
    moves = np.array([[-1e-3, 0.0]] * 2 + [[2e-3, 0.0]] * 2)
    found = least_dissipation_in_plane(np.full(4, 0.01), places, moves)
    assert found.shift == pytest.approx([-5e-4, 0.0], abs=1e-9)
    assert found.turn == pytest.approx(0.0, abs=1e-9)


def test_a_shape_that_moves_as_a_whole_does_not_move_at_all():
    rng = np.random.default_rng(3)
    places = rng.uniform(-0.1, 0.1, (5, 2))
    moves = np.array([1e-3, -2e-3]) + 0.01 * np.column_stack([-places[:, 1], places[:, 0]])
    found = least_dissipation_in_plane(rng.random(5) + 0.1, places, moves)
    assert found.turn == pytest.approx(-0.01, rel=1e-6)
    assert np.abs(found.slip).max() < 1e-9


def test_about_one_foot_that_holds_it_turns_until_the_others_need_no_moment():
    places = np.array([[0.0, 0.0], [0.1, 0.0], [0.0, 0.2]])
    moves = np.array([[0.0, 0.0], [0.0, 1e-3], [0.0, 0.0]])
    # one foot bears anything; of the others the farther, times its lever, holds the turn
    held = least_dissipation_in_plane(np.array([100.0, 1.0, 1.0]), places, moves)
    assert held.slip[0] == pytest.approx([0, 0], abs=1e-9)
    assert held.turn == pytest.approx(0.0, abs=1e-8)  # 0.2 m beats 0.1 m
    given = least_dissipation_in_plane(np.array([100.0, 3.0, 1.0]), places, moves)
    assert given.turn == pytest.approx(-1e-2, rel=1e-5)  # 0.3 N m beats 0.2 N m
    assert given.slip[1] == pytest.approx([0, 0], abs=1e-8)


def test_without_any_bound_viscosity_decides_and_bad_input_is_named():
    moves = np.array([[1e-3, 0.0], [3e-3, 0.0]])
    found = least_dissipation_in_plane(np.zeros(2), np.array([[0.0, 0.0], [0.1, 0.0]]), moves)
    assert found.shift == pytest.approx([-2e-3, 0.0])
    with pytest.raises(ValueError, match="need a place and a move"):
        least_dissipation_in_plane(np.ones(2), np.zeros((2, 3)), np.zeros((2, 2)))


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_a_film_alone_takes_the_weighted_least_squares_of_the_slips(seed):
    drags, places, moves = draw(seed)
    found = least_dissipation_in_plane(0 * drags, places, moves, drags)
    count = len(drags)
    lever = np.zeros((count, 2, 3))
    lever[:, 0, 0] = lever[:, 1, 1] = 1.0
    lever[:, 0, 2], lever[:, 1, 2] = -places[:, 1], places[:, 0]
    root = np.sqrt(np.repeat(drags, 2))
    exact = np.linalg.lstsq(
        root[:, None] * lever.reshape(-1, 3), -root * moves.ravel(), rcond=None
    )[0]
    assert found.shift == pytest.approx(exact[:2], abs=1e-8)
    assert found.turn == pytest.approx(exact[2], abs=1e-7)


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_a_film_beside_dry_friction_balances_its_forces(seed):
    bounds, places, moves = draw(seed)
    drags = np.random.default_rng(seed + 1).uniform(0.0, 1e3, len(bounds))
    found = least_dissipation_in_plane(bounds, places, moves, drags)
    pace = np.hypot(*found.slip.T)
    assume((pace >= 1e-7).all())  # what holds bears any force within its bound
    force = (bounds / pace + drags)[:, None] * found.slip
    moment = places[:, 0] * force[:, 1] - places[:, 1] * force[:, 0]
    assert force.sum(axis=0) == pytest.approx([0, 0], abs=1e-5)
    assert moment.sum() == pytest.approx(0, abs=1e-6)
