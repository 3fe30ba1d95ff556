"""What TerreSoRo-IV remembers, and how its tracks are cut, by closed forms and planted faults."""

import numpy as np
import pytest

from analytic.friction.dissipation_in_plane import least_dissipation_in_plane
from zoo.terresoro_iv import hub, model, tracks
from zoo.terresoro_iv.at_once import SHARPEST, least_dissipation
from zoo.terresoro_iv.forms import FORMS


def test_many_at_once_move_as_one_by_one():
    random = np.random.default_rng(3)
    bounds, viscous = random.uniform(0.2, 2.0, (2, 20, 4))
    viscous[::2] = 0.0
    places, moves = 9 * random.normal(size=(20, 4, 2)), random.normal(size=(20, 4, 2))
    for row, found in enumerate(least_dissipation(bounds, viscous, places, moves)):
        one = least_dissipation_in_plane(bounds[row], places[row], moves[row], viscous[row])
        found_cost, least = (
            cost(motion, bounds[row], places[row], moves[row], viscous[row])
            for motion in (found, [*one.shift, one.turn])
        )
        # a corner that is rounded by e adds e times its bound at most
        assert -1e-9 < found_cost - least < SHARPEST * np.abs(moves[row]).max() * bounds[row].sum()


def cost(motion, bounds, places, moves, viscous):
    across = np.stack([-places[:, 1], places[:, 0]], axis=1)
    slips = np.hypot(*(moves + np.asarray(motion[:2]) + motion[2] * across).T)
    return bounds @ slips + 0.5 * viscous @ slips**2


def test_a_hub_without_lag_is_the_one_without_memory():
    numbers, _ = hub.fitted()
    pairs = [("0000", "0011"), ("0111", "1000"), ("1010", "1111")]
    past = np.array([[[int(x) for x in before]] for before, _ in pairs])
    after = np.array([[int(x) for x in state] for _, state in pairs])
    found = model.motions(model.Lagged(*numbers), past, after)
    assert found == pytest.approx(hub.by_friction(numbers)(pairs), abs=5e-3)


def test_what_lacks_of_a_curl_falls_as_powers_of_the_lag():
    past = np.zeros((1, 4, 4), dtype=int)
    past[0, 1:, 0] = 1
    begin, end = model.amounts(past, np.array([[1, 1, 0, 0]]), 0.2)
    assert begin[0] == pytest.approx([1 - 0.2**3, 0, 0, 0])
    assert end[0] == pytest.approx([1 - 0.2**4, 0.8, 0, 0])
    _, end = model.amounts(past, np.zeros((1, 4), dtype=int), 0.2)
    assert not end.any()


def test_each_form_contains_the_lagged_hub():
    values, _ = model.remembered()
    past, after = model.steady(("0010", "0110", "0001"))
    lagged = FORMS["lag of curling"].law(values, past, after)
    for name in ("lag, fresh contacts", "lag, load", "lag by how many curl", "lag, unlike limbs"):
        form = FORMS[name]
        found = form.law(np.array([*values, *form.neutral]), past, after)
        assert found == pytest.approx(lagged, abs=1e-9), name


def test_runs_are_cut_where_motion_begins_though_a_track_drifts():
    count, first = 60, 40.0
    true = np.round(first + (tracks.FRAMES - 0.03) * np.arange(count + 1)).astype(int)
    place = np.zeros((true[-1] + 40, 2))
    for begin in true[:-1]:
        place[begin + 1 : begin + 9, 0] += np.linspace(0.5, 0.05, 8)
    place = np.cumsum(place, axis=0)
    found = tracks.starts(tracks.Track(place, np.zeros(len(place))), first, count)
    assert np.abs(found - true).max() <= 1


def test_a_track_that_loses_two_transitions_is_found_out():
    random = np.random.default_rng(1)
    orders = np.array([random.permutation(np.tile(np.arange(8), 10)) for _ in range(5)])
    vectors = random.normal(size=(8, 8, 3)) * [0.8, 0.8, 5.0]
    moves = [vectors[order[:-1], order[1:]] for order in orders]
    moves[3] = np.concatenate([moves[3][:30], moves[3][32:], np.zeros((2, 3))])
    found = tracks.lost(moves, orders)
    assert found[3].tolist() == [0, 0, 0, 2, 2, 2, 2]
    assert not found[[0, 1, 2, 4]].any()


def test_means_that_are_cut_anew_are_of_the_same_transitions():
    pairs, means = model.recut()
    known, published = hub.transitions()
    assert sorted(pairs) == sorted(known)
    order = [known.index(pair) for pair in pairs]
    for column in range(3):
        assert np.corrcoef(means[:, column], published[order, column])[0, 1] > 0.95
