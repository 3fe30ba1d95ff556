"""Friction that is unlike ahead and back: closed forms, optimisers, and what stays of symmetry."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import linprog, minimize

from analytic import GAITS, SURFACES, Friction, Gait, Robot, predict
from analytic.friction.dissipation import least_dissipation
from analytic.scene.ground import Patches, over
from analytic.scene.surface import Surface
from analytic.solvers.elastica.tractions import tractions

POINTS = 200  # of a bar
eighths = st.integers(1, 16).map(lambda i: i / 8)
strengths = st.tuples(eighths, eighths)
parts = st.integers(0, 8).map(lambda i: i / 8)
contacts = st.lists(
    st.tuples(parts, parts, st.integers(-16, 16).map(lambda i: i / 16)), min_size=1, max_size=7
).map(lambda triples: np.array(triples).T)


def napped(ahead, back, name="felt"):
    """A named surface, so many times as strong ahead and back."""
    surface = SURFACES[name]
    bounds = {key: getattr(surface, key) for key in ("tip_force", "shear_strength")}
    return replace(surface, **{key: ahead * value for key, value in bounds.items()},
                   **{f"{key}_back": back * value for key, value in bounds.items()})  # fmt: skip


@given(contacts)
def test_no_motion_dissipates_less_by_linear_programming(drawn):
    """min sum a_j p_j + b_j n_j over (dU, p, n >= 0) with p_j - n_j = dU + dX_j."""
    ahead, back, moves = drawn
    count = len(moves)
    rows = np.hstack([-np.ones((count, 1)), np.eye(count), -np.eye(count)])
    exact = linprog(
        np.concatenate([[0.0], ahead, back]), A_eq=rows, b_eq=moves,
        bounds=[(None, None), *[(0, None)] * (2 * count)],
    )  # fmt: skip
    slips = moves + least_dissipation(ahead, moves, back)
    spent = ahead @ np.maximum(slips, 0) + back @ np.maximum(-slips, 0)
    assert spent == pytest.approx(exact.fun, abs=1e-9)


@given(st.integers(2, 5), st.data())
def test_tractions_between_unlike_bounds_are_those_of_least_complementary_energy(count, data):
    """min t K t / 2 + g t over -a <= t <= b with sum t = 0, by quadratic programming."""
    numbers = st.lists(st.integers(-16, 16).map(lambda i: i / 8), min_size=count, max_size=count)
    gaps, ahead, back = (np.array(data.draw(numbers)) for _ in range(3))
    ahead, back = np.abs(ahead), np.abs(back)
    factor = np.array([data.draw(numbers) for _ in range(count)])
    compliance = factor @ factor.T / count
    solution = tractions(gaps, compliance, ahead, np.zeros(count), back=back)
    best = minimize(
        lambda t: 0.5 * t @ compliance @ t + gaps @ t, np.zeros(count), method="SLSQP",
        jac=lambda t: compliance @ t + gaps, bounds=list(zip(-ahead, back, strict=True)),
        options={"ftol": 1e-12, "maxiter": 500},
        constraints={"type": "eq", "fun": np.sum, "jac": lambda t: np.ones(len(t))},
    )  # fmt: skip
    assume(best.success)
    energy = 0.5 * solution.traction @ compliance @ solution.traction + gaps @ solution.traction
    assert energy == pytest.approx(best.fun, abs=1e-4)


def bar_cycle(displacements, ahead, back):
    """Net motion of a rigid bar of POINTS points whose shape goes through displacements."""
    steps = np.diff(np.vstack([displacements, displacements[:1]]), axis=0)
    bounds = np.full((2, POINTS), 1.0 / POINTS) * np.array([[ahead], [back]])
    return sum(least_dissipation(bounds[0], step, bounds[1]) for step in steps)


@given(strengths, eighths)
def test_a_bar_that_stretches_unevenly_and_back_goes_by_its_stretch_where_it_rests(sides, power):
    """E(1 - f) - E(f), f = tau_a / (tau_a + tau_b), of a stretch E(z) up to z."""
    ahead, back = sides
    z = (np.arange(POINTS) + 0.5) / POINTS
    stretch = 0.2 * z ** (1 + power)
    rest = ahead / (ahead + back)
    expected = 0.2 * ((1 - rest) ** (1 + power) - rest ** (1 + power))
    net = bar_cycle(np.array([0 * z, stretch]), ahead, back)
    assert net == pytest.approx(expected, abs=0.4 * (1 + power) / POINTS)


@given(strengths, st.sampled_from([0.1, 0.25, 0.5]), st.sampled_from([-0.2, 0.2]))
def test_a_square_wave_from_tail_to_head_goes_as_far_as_its_width_and_the_nap_allow(
    sides, width, strain
):
    """Extension: -eps width where width < f, else eps (b - a) / (a + b); contraction by 1 - f."""
    ahead, back = sides
    rest = ahead / (ahead + back)
    assume(min(abs(width - rest), abs(width - 1 + rest)) > 0.03)
    z = (np.arange(POINTS) + 0.5) / POINTS
    front = np.linspace(0.0, 1.0 + width, POINTS)
    shapes = [strain * np.maximum(np.minimum(z, f) - max(f - width, 0.0), 0.0) for f in front]
    net = bar_cycle(np.array(shapes), ahead, back)
    whole = abs(strain) * (back - ahead) / (ahead + back)
    if strain > 0:
        expected = -strain * width if width < rest else whole
    else:
        expected = -strain * width if width < 1 - rest else whole
    assert net == pytest.approx(expected, abs=3 * abs(strain) / POINTS)


def elastic_cycle(stretch, compliance, ahead, back, cycles=2, steps=20):
    """Net motion per cycle of contacts on an elastic bar that stretches and shrinks back.

    Args:
        stretch: displacement of the contacts by the bar alone at its most, (C,).
        compliance: of the contacts, (C, C).
        ahead, back: bounds, (C,).
    """
    rise = np.linspace(0.0, 1.0, steps + 1)
    path = np.tile(np.concatenate([rise[1:], rise[-2::-1]]), cycles)
    place, slips, starts = np.zeros(len(stretch)), None, []
    for number, part in enumerate(path):
        if number % (2 * steps) == 0:
            starts.append(place.copy())
        solution = tractions(part * stretch - place, compliance, ahead, np.zeros(len(stretch)),
                          guess=slips, back=back)  # fmt: skip
        place = part * stretch + solution.whole + compliance @ solution.traction
        slips = solution.slips
    return float((place - starts[-1]).mean())


@pytest.mark.parametrize("sides", [(1.0, 2.0), (0.5, 0.25), (0.25, 0.375)])
@pytest.mark.parametrize("stiffness", [0.3, 2.0])
def test_an_elastic_bar_loses_of_its_stretch_what_the_lesser_bound_holds(sides, stiffness):
    """max(0, D - min(a, b) L^2 / EA) (b - a) / (a + b), of friction per length a and b."""
    ahead, back = sides
    count = 16
    z = (np.arange(count) + 0.5) / count
    compliance = np.minimum.outer(z, z) / stiffness
    bounds = np.full((2, count), 1.0 / count) * np.array([[ahead], [back]])
    net = elastic_cycle(z, compliance, *bounds)
    held = min(ahead, back) / stiffness
    expected = max(0.0, 1.0 - held) * (back - ahead) / (ahead + back)
    assert net == pytest.approx(expected, abs=0.03)


@given(st.tuples(eighths, eighths, eighths, eighths), st.sampled_from([2.0, 8.0]))
def test_two_feet_and_a_spring_lose_of_their_stretch_what_the_lesser_feet_hold(bounds, stiffness):
    """D - (min(a_left, b_right) + min(b_left, a_right)) / k, by which foot anchors either way."""
    a_left, b_left, a_right, b_right = bounds
    assume(a_left != b_right and b_left != a_right)
    compliance = np.array([[0.0, 0.0], [0.0, 1.0 / stiffness]])
    net = elastic_cycle(np.array([0.0, 1.0]), compliance, np.array([a_left, a_right]),
                        np.array([b_left, b_right]))  # fmt: skip
    gait = max(0.0, 1.0 - (min(a_left, b_right) + min(b_left, a_right)) / stiffness)
    # the left foot's motion: back while the spring grows if it is the weaker one, ahead while it
    # shrinks if it is the weaker one again
    whole = 1.0 * (a_left < b_right) - 1.0 * (b_left < a_right)
    assert net == pytest.approx(gait * whole, abs=1e-4)


def test_an_arch_on_one_way_feet_nets_its_whole_shortening_only_while_a_back_bound_is_greater():
    gait = Gait("arch", ((0, 0, 0), (1, 1, 1), (0, 0, 0)))
    foot = Surface("bristles", tip_force=0.01, tip_force_back=0.02)
    walk = predict(Robot(), gait, foot)
    separation = walk.shapes.separation
    whole = separation.max() - separation.min()
    assert walk.locomotion.per_cycle == pytest.approx(whole, rel=1e-6)
    other = replace(foot, tip_force_back=0.005)
    assert predict(Robot(), gait, other).locomotion.per_cycle == pytest.approx(-whole, rel=1e-6)


@pytest.mark.parametrize("name", SURFACES)
def test_mirrored_gaits_on_mirrored_ground_go_the_other_way(name):
    """Of a robot that is its own mirror image."""
    gait = GAITS["wave"]
    mirrored = replace(gait, name="mirrored", stages=tuple(s[::-1] for s in gait.stages))
    there = predict(Robot(), gait, napped(0.7, 1.2, name)).locomotion
    back = predict(Robot(), mirrored, napped(1.2, 0.7, name)).locomotion
    assert back.right[-1] == pytest.approx(-there.left[-1], abs=1e-9)


def test_a_reversed_gait_need_not_go_back_where_the_ground_has_a_nap():
    surface = napped(1.0, 1.5, "polyethylene")
    ways = [predict(Robot(), gait, surface).locomotion.per_cycle
            for gait in (GAITS["wave"], GAITS["wave"].reversed())]  # fmt: skip
    assert min(ways) > 0.1 * Robot().length


@pytest.mark.parametrize("tension", [0.0, 1.0])
def test_alike_bounds_in_other_words_are_round(tension):
    surface = replace(SURFACES["gelatin"], tip_force_back=SURFACES["gelatin"].tip_force)
    friction = Friction(tension=tension)
    walks = [predict(Robot(), GAITS["wave"], ground, friction=friction, states_per_ramp=12)
             for ground in (surface, SURFACES["gelatin"])]  # fmt: skip
    assert walks[0].locomotion.per_cycle == walks[1].locomotion.per_cycle


def test_as_friction_gets_weak_the_bent_strip_goes_as_the_rule_says():
    surface, limit = napped(1.0, 1.5, "polyethylene"), None
    limit = predict(Robot(), GAITS["wave"], surface).locomotion.per_cycle
    off = [abs(predict(Robot(), GAITS["wave"], surface.scaled(factor),
                       friction=Friction(tension=1.0)).locomotion.per_cycle - limit)
           for factor in (0.1, 0.01)]  # fmt: skip
    assert off[1] < 0.2 * off[0] < 2e-3 * Robot().length


def test_a_contact_over_two_naps_resists_by_their_mean_each_way():
    cloth = napped(1.0, 2.0)
    ground = Patches("two", (0.0,), (cloth, SURFACES["felt"]))
    under = over(ground, -0.01, 0.03)
    tau = SURFACES["felt"].shear_strength
    assert under.shear_strength == pytest.approx(tau)
    assert under.resistance("shear_strength_back") == pytest.approx(1.25 * tau)
    assert under.resistance("shear_strength_across") == pytest.approx(1.125 * tau)


@pytest.mark.parametrize(("values", "words"), [
    ({"tip_force": {"back": 1.0}}, "motion ahead"),
    ({"friction": {"ahed": 1.0}}, "did you mean ahead"),
    ({"tip_force": {"ahead": 1.0, "back": 2.0}, "tip_force_back": 3.0}, "given twice"),
    ({"shear_strength": {"ahead": 1.0, "across": -2.0}}, "shear_strength_across"),
    ({"nap": "sky"}, "robot, ground"),
])  # fmt: skip
def test_what_is_no_direction_is_refused_in_one_line(values, words):
    with pytest.raises(ValueError, match=words):
        Surface("any", **values)
