"""TerreSoRo-IV: memory, tracks, outline and limbs, by closed forms and planted faults."""

from itertools import pairwise

import numpy as np
import pytest

from analytic.friction.dissipation_in_plane import least_dissipation_in_plane
from mjsim import build, read_tables
from zoo.terresoro_iv import blue, fit, hub, limbs, model, outline, scenes, steps, tracks
from zoo.terresoro_iv.at_once import SHARPEST, least_dissipation
from zoo.terresoro_iv.forms import FORMS
from zoo.terresoro_iv.outline import flat_place


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


def test_a_hub_without_lag_whose_friction_is_by_state_is_the_one_without_memory():
    numbers = hub.fitted()[0]._replace(**dict(zip(("flat", "flat_angle"), flat_place(),
                                                  strict=True)))  # fmt: skip
    pairs = [("0000", "0011"), ("0111", "1000"), ("1010", "1111")]
    past = np.array([[[int(x) for x in before]] for before, _ in pairs])
    after = np.array([[int(x) for x in state] for _, state in pairs])
    found = FORMS["both by state"].law(np.array([*numbers[2:], 0.0]), past, after)
    assert found == pytest.approx(hub.by_friction(numbers)(pairs), abs=5e-3)


def test_what_lacks_of_a_curl_falls_as_powers_of_the_lag():
    past = np.zeros((1, 4, 4), dtype=int)
    past[0, 1:, 0] = 1
    begin, end = model.amounts(past, np.array([[1, 1, 0, 0]]), 0.2)
    assert begin[0] == pytest.approx([1 - 0.2**3, 0, 0, 0])
    assert end[0] == pytest.approx([1 - 0.2**4, 0.8, 0, 0])
    _, end = model.amounts(past, np.zeros((1, 4), dtype=int), 0.2)
    assert not end.any()


def test_forms_that_extend_the_lagged_hub_contain_it():
    values, _ = model.remembered()
    past, after = model.steady(("0010", "0110", "0001"))
    lagged = FORMS[model.FORM].law(values, past, after)
    for name, form in FORMS.items():
        if form.extends and name not in ("lag of both", "order of curling"):
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


@pytest.mark.parametrize("lost", [2, -1])
def test_a_track_that_loses_transitions_or_has_one_too_many_is_found_out(lost):
    random = np.random.default_rng(1)
    orders = np.array([random.permutation(np.tile(np.arange(8), 10)) for _ in range(5)])
    vectors = random.normal(size=(8, 8, 3)) * [0.8, 0.8, 5.0]
    moves = [vectors[order[:-1], order[1:]] for order in orders]
    if lost > 0:
        moves[3] = np.concatenate([moves[3][:30], moves[3][30 + lost :], np.zeros((lost, 3))])
    else:
        moves[3] = np.concatenate([moves[3][:30], np.zeros((-lost, 3)), moves[3][30:lost]])
    found = tracks.lost(moves, orders)
    assert found[3].tolist() == [0, 0, 0, lost, lost, lost, lost]
    assert not found[[0, 1, 2, 4]].any()


def test_errors_by_kinds_of_a_mean_are_those_of_the_sums_of_its_kinds():
    random = np.random.default_rng(4)
    kinds = np.repeat(np.arange(6), 5)
    values = random.normal(size=6)[kinds]  # alike within a kind: six values, not thirty
    found = hub.clustered(np.ones((30, 1)), values - values.mean(), kinds)
    assert found.item() == pytest.approx(values[::5].var(ddof=1) / 6)


def test_steps_that_differ_by_their_axes_alone_are_the_same():
    random = np.random.default_rng(2)
    one = random.normal(size=(3, 3))
    other = np.column_stack([hub.turned(one[:, :2], 2.0), one[:, 2]])
    assert steps.apart(one, other) == pytest.approx((0, 0), abs=1e-12)
    assert steps.apart(one, other + np.array([0, 0, 1.5]))[1] == pytest.approx(1.5)


def test_means_that_are_cut_anew_are_of_the_same_transitions():
    pairs, means = model.recut()
    known, published = hub.transitions()
    assert sorted(pairs) == sorted(known)
    order = [known.index(pair) for pair in pairs]
    for column in range(3):
        assert np.corrcoef(means[:, column], published[order, column])[0, 1] > 0.95


def test_limbs_on_a_picture_are_found_where_they_were_drawn():
    """Ellipses, one turned by 20 degrees against the axes, around a hub that is turned by 10."""
    rows, columns = np.mgrid[:300, :300]
    place = (
        tracks.ORANGE.pixel * ((columns - 160) + 1j * (rows - 140)) * np.exp(-1j * np.radians(10))
    )
    picture = np.zeros((300, 300, 3))
    for limb in range(hub.LIMBS):
        local = place * np.exp(-1j * (np.radians(250) - 0.5 * np.pi * limb)) - 11.0
        picture[(local.real / 5) ** 2 + (local.imag / 2) ** 2 < 1] = 200.0
    each = outline.limbs(picture, np.array([160.0, 140.0]), np.radians(10))
    found = np.array([outline.numbers(limb) for limb in each])
    assert found[:, 0] == pytest.approx(np.full(4, 11.0), abs=0.05)
    assert np.degrees(found[:, 1]) % 360 == pytest.approx(np.full(4, 250.0), abs=0.5)
    assert found[:, 2] == pytest.approx(np.full(4, 16.0), abs=0.2)
    assert found[:, 3] == pytest.approx(np.full(4, np.pi * 10), rel=0.02)


def test_the_hubs_axis_is_that_of_its_markers():
    angles = np.radians(7) + 0.25 * np.pi * np.arange(8)
    spokes = 30 + 13 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    assert tracks.axis(spokes[[3, 1, 0, 2, 7, 6, 5, 4]]) == pytest.approx(np.radians(7))


@pytest.fixture(scope="module")
def fitted():
    return model.Lagged(*model.remembered()[0])


def test_friction_of_other_feet_is_found_where_it_was_planted(fitted):
    random = np.random.default_rng(5)
    past, after = random.integers(0, 2, (80, 3, 4)), random.integers(0, 2, (80, 4))
    planted = fitted._replace(resting=-0.5, uncurling=-1.1)
    of = tracks.Runs(past, after, model.motions(planted, past, after), np.zeros(80))
    found = blue.fit(("resting", "uncurling"), of, np.ones(80, dtype=bool), fitted)
    assert found == pytest.approx(planted, abs=0.02)


def test_tips_of_limbs_are_where_contacts_were_fitted_and_the_hub_stays_level(fitted):
    stance = limbs.Stance(limbs.lay(fitted))
    heights = []
    for state, places in zip((np.zeros(4), np.ones(4)), fitted.places, strict=True):
        tips, height = stance.tips(state)
        assert tips == pytest.approx(places, abs=0.03)
        heights.append(height)
    assert heights[0] == pytest.approx(heights[1], abs=1e-4)


def test_limbs_explain_transitions_and_gaits_within_what_was_asked_of_them(fitted):
    """R2 of 60 of the 240 transitions, one of each four that are alike; no fit has seen gaits."""
    walker = limbs.Walker(fitted)
    pairs, means = model.recut()
    one = [pairs.index(hub.smallest(pair)[0]) for pair in pairs if hub.smallest(pair)[1] == 0]
    past, after = (np.array([[int(x) for x in pairs[k][end]] for k in one]) for end in (0, 1))
    r2 = fit.explained(walker(past[:, None], after, 1), means[one])
    assert (r2 > [0.80, 0.77, 0.84]).all(), r2
    mean, error = hub.measured_cycles(model.recut_gaits())
    found = np.array([walker.cycle(gait.states, 1) for gait in hub.gaits()])
    assert (np.sqrt(((found - mean) ** 2).mean(axis=0)) < [0.35, 3.0]).all(), found
    assert fit.wrong_order(found, mean, error) == []


def test_the_scene_of_limbs_goes_as_they_do_by_theory_and_mujoco(fitted):
    """Gait D; friction, which bends limbs in the reference and in MuJoCo, takes 5 % of it."""
    laid, states = limbs.lay(fitted), hub.gaits()[3].states
    text = scenes.scene(fitted, laid, scenes.stages(fitted, laid, *model.steady(states)), 1)
    by_theory, by_reference = (
        scenes.last_cycle(scenes.by_theory(text, 1, bent), len(states)) for bent in (False, True)
    )
    assert by_theory == pytest.approx(limbs.Walker(fitted).cycle(states), abs=0.15)
    walked, status = scenes.by_mujoco(text)
    assert status == "ok"
    found = scenes.last_cycle(walked, len(states))
    assert found[0] == pytest.approx(by_reference[0], abs=0.03)
    assert found[1] == pytest.approx(by_reference[1], abs=0.3)


def test_a_tour_goes_once_through_each_transition():
    states = scenes.tour()
    assert len(states) == 241
    assert len(set(pairwise(states))) == 240


def test_the_scene_of_limbs_is_a_file_that_builds_and_goes_round(fitted):
    laid, states = limbs.lay(fitted), hub.gaits()[2].states
    lines = scenes.scene(fitted, laid, scenes.stages(fitted, laid, *model.steady(states)), 2)
    assert (hub.HERE / "scene.toml").read_text("utf-8").count("\n") == lines.count("\n")
    built = build(read_tables(hub.HERE / "scene.toml"))[0]
    assert len(built.robot.chambers) == 9
    assert built.gait.stages[0] == pytest.approx(built.gait.stages[-1])
    assert built.robot.limbs[1].angle == pytest.approx(limbs.robot(laid).limbs[1].angle, abs=1e-5)
