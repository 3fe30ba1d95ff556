"""What TerreSoRo-IV remembers, and how its tracks are cut, by closed forms and planted faults."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import Surface
from analytic.friction.dissipation_in_plane import least_dissipation_in_plane
from analytic.scene.feet import Foot
from analytic.solvers.limbs.walk import follow, shapes
from mjsim import build, read_tables
from zoo.terresoro_iv import hub, limbs, model, scenes, tracks
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


def test_limbs_that_all_resist_alike_go_as_the_reference_has_it():
    bounds = dict.fromkeys(("resting", "curling", "uncurling"), 0.0)
    numbers = limbs.known()[0]._replace(**bounds, lag=0.0, curl=1.6, rigidity=-1.0)
    before, after = np.array([[0, 0, 0, 0]]), np.array([[0, 0, 1, 1]])
    found = limbs.Walker(before[:, None], after)(numbers)
    of = limbs.robot(numbers)
    slides = replace(of.limbs[0].strip, feet=(Foot(0.0, 1.0, grip=0.0),))
    of = replace(of, limbs=(replace(of.limbs[0], strip=slides), *of.limbs[1:]))
    # two limbs begin at either end of the hub and share the bound of a tip
    flat = 10.0 * of.limbs[1].strip.length * of.limbs[1].strip.width
    ground = Surface("mat", tip_force=2 * flat, shear_strength=10.0)
    curls = np.linspace(before[0], after[0], limbs.STEPS + 1)
    pressures = limbs.PEAK * np.insert(curls, 0, 0.0, axis=1)
    tree, rests = shapes(of, pressures, limbs.ELEMENTS, twists=0)
    path = follow(tree, rests, pressures, ground)
    half, last = len(rests[0].nodes) // 2, tree.vertices[0].stop - 1
    first, end = (rest.nodes[[0, last, half, half + last], :2].mean(axis=0)
                  for rest in (rests[0], rests[-1]))  # fmt: skip
    moved = path.place[-1] + hub.turned(end, path.heading[-1]) - first
    assert found[0] == pytest.approx([*100 * moved, np.degrees(path.turn)], abs=0.01)


def test_the_scene_of_limbs_is_a_file_that_builds_and_goes_round():
    fitted, _ = limbs.known()
    states = hub.gaits()[2].states
    assert (hub.HERE / "scene.toml").read_text("utf-8") == scenes.scene(
        fitted, scenes.stages(fitted, *model.steady(states)), 2
    )
    built = build(read_tables(hub.HERE / "scene.toml"))[0]
    assert len(built.robot.chambers) == 9
    assert built.gait.stages[0] == pytest.approx(built.gait.stages[-1])
