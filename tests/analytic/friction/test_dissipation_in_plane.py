"""Least dissipation in the plane: balance, symmetry, and the rule along a line."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from analytic.friction.dissipation import least_dissipation
from analytic.friction.dissipation_in_plane import (
    SmoothFriction,
    least_dissipation_in_plane,
    nap_of,
)

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
    motion = least_dissipation_in_plane(bounds, places, moves)

    def slips(at):
        turned = np.column_stack([-places[:, 1], places[:, 0]])
        return moves + at[:2] * 1e-3 + at[2] * 1e-2 * turned

    def dissipated(at):
        return 1e3 * bounds @ np.hypot(*slips(at).T)

    start = np.append(motion.shift * 1e3, motion.turn * 1e2)
    assert slips(start) == pytest.approx(motion.slip, rel=1e-9, abs=1e-12)
    rng = np.random.default_rng(seed)
    for _ in range(3):
        other = minimize(dissipated, start + rng.standard_normal(3), method="Nelder-Mead",
                         options={"xatol": 1e-7, "fatol": 1e-11, "maxiter": 2000})  # fmt: skip
        assert dissipated(start) <= other.fun * (1 + 1e-7) + 1e-9


@settings(max_examples=60, deadline=None)
@given(SEEDS)
def test_forces_of_sliding_contacts_are_balanced_by_what_the_held_ones_can_bear(seed):
    bounds, places, moves = draw(seed)
    motion = least_dissipation_in_plane(bounds, places, moves)
    size = np.hypot(*motion.slip.T)
    slides = size > 1e-6 * np.abs(moves).max()
    force = np.where(slides[:, None], -motion.slip / np.maximum(size, 1e-300)[:, None], 0.0)
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
    motion = least_dissipation_in_plane(bounds, places, moves)
    assert motion.turn == pytest.approx(0, abs=1e-9)
    assert motion.shift[0] == pytest.approx(least_dissipation(bounds, moves[:, 0]), abs=1e-8)
    assert motion.shift[1] == pytest.approx(0, abs=1e-9)


def test_two_pairs_of_equal_feet_that_part_slide_alike():
    places = np.array([[0.0, 0.02], [0.0, -0.02], [0.13, 0.02], [0.13, -0.02]])
    moves = np.array([[-1e-3, 0.0]] * 2 + [[2e-3, 0.0]] * 2)
    motion = least_dissipation_in_plane(np.full(4, 0.01), places, moves)
    assert motion.shift == pytest.approx([-5e-4, 0.0], abs=1e-9)
    assert motion.turn == pytest.approx(0.0, abs=1e-9)


def test_a_shape_that_moves_as_a_whole_does_not_move_at_all():
    rng = np.random.default_rng(3)
    places = rng.uniform(-0.1, 0.1, (5, 2))
    moves = np.array([1e-3, -2e-3]) + 0.01 * np.column_stack([-places[:, 1], places[:, 0]])
    motion = least_dissipation_in_plane(rng.random(5) + 0.1, places, moves)
    assert motion.turn == pytest.approx(-0.01, rel=1e-6)
    assert np.abs(motion.slip).max() < 1e-9


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
    motion = least_dissipation_in_plane(np.zeros(2), np.array([[0.0, 0.0], [0.1, 0.0]]), moves)
    assert motion.shift == pytest.approx([-2e-3, 0.0])
    with pytest.raises(ValueError, match="need a place and a move"):
        least_dissipation_in_plane(np.ones(2), np.zeros((2, 3)), np.zeros((2, 2)))


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_a_film_alone_takes_the_weighted_least_squares_of_the_slips(seed):
    drags, places, moves = draw(seed)
    motion = least_dissipation_in_plane(0 * drags, places, moves, drags)
    count = len(drags)
    lever = np.zeros((count, 2, 3))
    lever[:, 0, 0] = lever[:, 1, 1] = 1.0
    lever[:, 0, 2], lever[:, 1, 2] = -places[:, 1], places[:, 0]
    root = np.sqrt(np.repeat(drags, 2))
    exact = np.linalg.lstsq(
        root[:, None] * lever.reshape(-1, 3), -root * moves.ravel(), rcond=None
    )[0]
    assert motion.shift == pytest.approx(exact[:2], abs=1e-8)
    assert motion.turn == pytest.approx(exact[2], abs=1e-7)


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_a_film_beside_dry_friction_balances_its_forces(seed):
    bounds, places, moves = draw(seed)
    drags = np.random.default_rng(seed + 1).uniform(0.0, 1e3, len(bounds))
    motion = least_dissipation_in_plane(bounds, places, moves, drags)
    pace = np.hypot(*motion.slip.T)
    assume((pace >= 1e-7).all())  # what holds bears any force within its bound
    force = (bounds / pace + drags)[:, None] * motion.slip
    moment = places[:, 0] * force[:, 1] - places[:, 1] * force[:, 0]
    assert force.sum(axis=0) == pytest.approx([0, 0], abs=1e-5)
    assert moment.sum() == pytest.approx(0, abs=1e-6)


def draw_naps(seed, count):
    """Bounds three ways and directions of ahead, (count,) each, of a random scene."""
    rng = np.random.default_rng([seed, 1])
    ahead, back, across = rng.uniform(0.05, 1.0, (3, count))
    angle = rng.uniform(-np.pi, np.pi, count)
    return ahead, back, across, np.stack([np.cos(angle), np.sin(angle)], axis=1)


def dissipated_on_naps(slips, ahead, back, across, axes):
    """Half an ellipse and a constant force, written out by components along and across."""
    along = (slips * axes).sum(axis=1)
    aside = axes[:, 0] * slips[:, 1] - axes[:, 1] * slips[:, 0]
    even = np.hypot(0.5 * (ahead + back) * along, across * aside)
    return float((even + 0.5 * (ahead - back) * along).sum())


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_no_other_motion_dissipates_less_on_naps(seed):
    bounds, places, moves = draw(seed)
    naps = draw_naps(seed, len(bounds))
    strongest, nap = nap_of(*naps)
    motion = least_dissipation_in_plane(strongest, places, moves, nap=nap)

    def dissipated(at):
        turned = np.column_stack([-places[:, 1], places[:, 0]])
        slips = moves * 1e3 + at[:2] + at[2] * 10 * turned
        return dissipated_on_naps(slips, *naps)

    start = np.append(motion.shift * 1e3, motion.turn * 1e2)
    rng = np.random.default_rng(seed)
    for _ in range(3):
        other = minimize(dissipated, start + rng.standard_normal(3), method="Nelder-Mead",
                         options={"xatol": 1e-7, "fatol": 1e-11, "maxiter": 2000})  # fmt: skip
        assert dissipated(start) <= other.fun * (1 + 1e-7) + 1e-9


@given(SEEDS)
def test_a_nap_resists_by_its_bounds_ahead_back_and_across(seed):
    ahead, back, across, axes = draw_naps(seed, 3)
    strongest, nap = nap_of(ahead, back, across, axes)
    friction = SmoothFriction(strongest, np.zeros(3), nap)
    left = np.stack([-axes[:, 1], axes[:, 0]], axis=1)
    costs = [friction.cost(way * axes, 0.0) for way in (1, -1)] + [friction.cost(left, 0.0)]
    # what leans along does not work across
    assert costs == pytest.approx([ahead.sum(), back.sum(), across.sum()])


@given(SEEDS)
def test_a_bar_that_turns_about_its_foot_spends_half_its_length_squared_by_the_bound_across(seed):
    """Or, across the nap, by that of the way that it turns: bristles along y, a bar along x."""
    ahead, back, across = (float(part[0]) for part in draw_naps(seed, 1)[:3])
    r = (np.arange(1000) + 0.5) / 1000
    for axis, (left, right) in (((1.0, 0.0), (across, across)), ((0.0, 1.0), (ahead, back))):
        axes = np.tile(axis, (1000, 1))
        bounds = np.full((3, 1000), 1e-3) * np.array([[ahead], [back], [across]])
        strongest, nap = nap_of(*bounds, axes)
        friction = SmoothFriction(strongest, np.zeros(1000), nap)
        for turn, strength in ((0.1, left), (-0.1, right)):
            slips = np.stack([0 * r, turn * r], axis=1)
            assert friction.cost(slips, 0.0) == pytest.approx(0.05 * strength, rel=1e-6)


@given(SEEDS)
def test_the_slopes_of_friction_on_naps_are_its_differences(seed):
    rng = np.random.default_rng(seed)
    strongest, nap = nap_of(*draw_naps(seed, 3))
    friction = SmoothFriction(strongest, rng.random(3), nap)
    slips, by = rng.standard_normal((3, 2)), 1e-6 * rng.standard_normal((3, 2))
    pull, stiff = friction.slopes(slips, 0.1)
    sides = [friction.cost(slips + sign * by, 0.1) for sign in (1, -1)]
    assert sides[0] - sides[1] == pytest.approx(2 * (pull * by).sum(), rel=1e-5, abs=1e-14)
    pulls = [friction.slopes(slips + sign * by, 0.1)[0] for sign in (1, -1)]
    assert pulls[0] - pulls[1] == pytest.approx(2 * np.einsum("cij,cj->ci", stiff, by),
                                                rel=1e-4, abs=1e-12)  # fmt: skip


@settings(max_examples=20, deadline=None)
@given(SEEDS)
def test_a_nap_that_is_alike_in_all_directions_is_none(seed):
    bounds, places, moves = draw(seed)
    axes = draw_naps(seed, len(bounds))[3]
    strongest, nap = nap_of(bounds, bounds, bounds, axes)
    one = least_dissipation_in_plane(bounds, places, moves)
    two = least_dissipation_in_plane(strongest, places, moves, nap=nap)
    assert two.slip == pytest.approx(one.slip, rel=1e-6, abs=1e-9)
