"""Payloads of strips: heavier strips, closed forms, balance, scaling, and what is no payload."""

from dataclasses import replace
from importlib import import_module
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from analytic import (
    GAITS,
    SURFACES,
    Friction,
    Payload,
    Robot,
    predict,
    solve_elastica,
    solve_lifted,
    solve_modes,
    solve_obstacle,
)
from analytic.friction.flat_load import FlatLoad
from analytic.scene import pneunet
from analytic.scene.payload import mass_moments, mass_on_nodes
from analytic.scene.robot import GRAVITY

MINIMISER = Path(__file__).parents[3] / "benchmarks/minimiser"
STRIP = Robot()
LENGTH, W = STRIP.length, STRIP.weight_per_length
HALF = 0.5 * STRIP.weight / GRAVITY  # kg, half of its own mass
GROUND = SURFACES["polyethylene"]
LAWS = [
    Friction(), Friction("coulomb"), Friction(contacts="all"), Friction(tension=1.0),
    Friction("coulomb", tension=1.0, contacts="all"),
]  # fmt: skip
# in steps: a place within 1e-11 of a node counts as there
parts = st.integers(0, 2**20).map(lambda step: step / 2**20)


def laden(*payload, **values):
    return Robot(payload=payload, **values)


def stretches(*edges):
    """A payload of half the strip's mass, spread evenly, cut at places."""
    cuts = [0.0, *edges, 1.0]
    return [Payload(HALF * (b - a), a, b) for a, b in pairwise(cuts)]


@pytest.mark.parametrize("payload", [stretches(), stretches(0.31, 0.77)])
@pytest.mark.parametrize("friction", LAWS)
def test_a_payload_spread_over_a_strip_is_a_heavier_strip(friction, payload):
    ways = [
        predict(robot, GAITS["wave"], GROUND, friction=friction, states_per_ramp=6)
        for robot in (laden(*payload), replace(STRIP, weight_per_length=1.5 * W))
    ]
    assert ways[0].locomotion.per_cycle == pytest.approx(
        ways[1].locomotion.per_cycle, abs=(1e-6 if friction.tension else 1e-12) * LENGTH
    )


@pytest.mark.parametrize("solve", [solve_elastica, solve_obstacle])
@pytest.mark.parametrize("payload", [stretches(), stretches(0.31, 0.77)])
def test_its_shapes_are_those_of_the_heavier_strip(solve, payload):
    pressures = STRIP.peak_pressure * np.array([[1.0, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1]])
    shapes = solve(laden(*payload), pressures)
    heavier = solve(replace(STRIP, weight_per_length=1.5 * W), pressures)
    for name in ("separation", "contact_left", "contact_right", "amplitude", "force"):
        assert getattr(shapes, name) == pytest.approx(getattr(heavier, name), abs=1e-9), name


@pytest.mark.parametrize("at", [0.4, 0.6, 0.8, 0.97])
def test_an_inflated_end_with_a_point_mass_lifts_off_where_a_beam_does(at):
    """Small slopes: y = y' = M = 0 where it lifts off and y = 0 at the tip, from which u counts.

    With R the push at the tip, M(u) = R u - w u^2 / 2 - P (u - a)+, and int u (kappa - M / D) du
    vanishes over the lifted length.
    """
    pressure, weight = 0.25 * STRIP.peak_pressure, 0.03
    strip = laden(Payload(weight / GRAVITY, at), rigidity_per_pressure=1e-12)
    rigidity, third, a = pneunet.base_rigidity(strip), LENGTH / 3, (1 - at) * LENGTH
    turn = float(pneunet.natural_curvature(strip, pressure)) * third**2 / 2

    def end_height(lifted):
        arm = max(lifted - a, 0.0)
        push = 0.5 * W * lifted + weight * arm / lifted
        moment = push * lifted**3 / 3 - W * lifted**4 / 8 - weight * arm**2 * (arm / 3 + a / 2)
        return turn - moment / rigidity

    lifted = brentq(end_height, third, LENGTH)
    shapes = solve_obstacle(strip, [[0.0, 0.0, pressure]], elements=240)
    assert LENGTH - shapes.contact_left[0] == pytest.approx(lifted, rel=1e-4)
    large = solve_elastica(strip, [[0.0, 0.0, pressure]], links=120)
    assert LENGTH - large.contact_left[0] == pytest.approx(lifted, rel=0.02)


@pytest.mark.parametrize("solve", [solve_elastica, solve_obstacle])
def test_the_ground_carries_strip_and_payload(solve):
    strip = laden(Payload(0.004, 0.37), Payload("3 g", 0.7, 0.9), Payload(0.001, 1.0))
    pressures = strip.peak_pressure * np.array([[0.0, 0, 0], [0.5, 0, 0], [1, 1, 0], [0, 1, 1]])
    force = solve(strip, pressures).force
    assert force.sum(axis=1) == pytest.approx(STRIP.weight + 0.008 * GRAVITY, rel=1e-8)


def test_what_lies_flat_is_carried_where_it_is():
    strip = laden(Payload(0.004, 0.37))
    shapes = solve_elastica(strip, [[0.0, 0, 0]])
    at = shapes.force[0] @ shapes.nodes / shapes.force[0].sum()
    weight, carried = STRIP.weight, 0.004 * GRAVITY
    assert at == pytest.approx((0.5 * weight + 0.37 * carried) / (weight + carried) * LENGTH)


@pytest.mark.parametrize("tension", [0.0, 1.0])
def test_under_mu_n_all_weights_and_the_stiffness_scale_together(tension):
    """By a power of two, which rounds nothing; pressure too, so that the strip bends alike."""
    friction = Friction("coulomb", tension)
    once = laden(Payload(0.004, 0.6), Payload(0.002, 0.1, 0.3))
    twice = replace(
        once, weight_per_length=2 * W, modulus=2 * STRIP.modulus,
        peak_pressure=2 * STRIP.peak_pressure,
        payload=[replace(payload, mass=2 * payload.mass) for payload in once.payload],
    )  # fmt: skip
    ways = [predict(robot, GAITS["wave"], GROUND, friction=friction, states_per_ramp=4)
            for robot in (once, twice)]  # fmt: skip
    assert ways[0].locomotion.per_cycle == ways[1].locomotion.per_cycle


@pytest.mark.slow
@pytest.mark.parametrize("ground", SURFACES)
def test_an_independent_minimiser_walks_as_far(ground, monkeypatch):
    monkeypatch.syspath_prepend(str(MINIMISER))
    carried = (Payload(0.004, 0.62), Payload(0.003, 0.1, 0.45))
    least, theory = import_module("payloads").both(carried, ground, states=20)
    assert theory == pytest.approx(least, abs=5e-4)
    assert abs(theory) > 0.01


@given(
    st.lists(st.tuples(parts, parts, st.floats(1e-4, 0.02)), max_size=3), st.booleans(),
    st.floats(0.01, 1.0), st.floats(0.0, 0.2), st.booleans(),
)  # fmt: skip
def test_a_flat_end_is_as_long_as_its_forces_say(given_payload, points, length, lift, right):
    """Forces of the load of a flat length and of a push R where that ends, summed over pieces."""
    carried = [Payload(mass, *((low,) if points else sorted((low, high))))
               for low, high, mass in given_payload]  # fmt: skip
    xi = length * LENGTH
    total, moment = W * xi + lift, W * xi**2 / 2 + lift * xi
    for payload in carried:
        low, high = (part * LENGTH for part in payload.stretch)
        s = low + (high - low) * (np.arange(4000) + 0.5) / 4000
        reach = LENGTH - s if right else s
        push = payload.mass * GRAVITY / 4000 * (reach < xi)
        total, moment = total + push.sum(), moment + push @ reach
    load = FlatLoad(laden(*carried))
    flat = (load.from_end if right else load.from_begin).length(total, moment)
    # what a ground without a lift tells of the length goes by the square root
    assert flat == pytest.approx(xi, abs=(1e-3 if lift > 1e-3 else 0.05) * LENGTH)


@given(st.tuples(parts, parts), st.integers(1, 12))
def test_moments_in_links_are_those_of_the_mass(stretch, links):
    payload = Payload(2.0, *sorted(stretch))
    nodes = LENGTH * np.linspace(0.0, 1.0, links + 2) ** 1.3
    low, high = (part * LENGTH for part in payload.stretch)
    s = low + (high - low) * (np.arange(3000) + 0.5) / 3000
    moments = mass_moments([payload], LENGTH, nodes)
    on_nodes = mass_on_nodes(moments)
    assert on_nodes.sum() == pytest.approx(2.0)
    assert on_nodes @ nodes == pytest.approx(2.0 * s.mean(), rel=1e-9, abs=1e-12)
    link = np.clip(np.searchsorted(nodes, s, side="right") - 1, 0, links)
    part = (s - nodes[link]) / np.diff(nodes)[link]
    ends = np.bincount(link, part**2, links + 1) * 2.0 / 3000
    assert moments[:, 2] == pytest.approx(ends, abs=2e-3)


@pytest.mark.parametrize("solve", [solve_modes, solve_lifted])
def test_contact_modes_refuse_a_payload(solve):
    with pytest.raises(ValueError, match="of even weight: for one with a payload take elastica"):
        solve(laden(Payload(0.005, 0.5)), [STRIP.peak_pressure, 0, 0])


@pytest.mark.parametrize(("values", "words"), [
    ({"mass": 0.0, "begin": 0.5}, "mass of a payload must be a positive"),
    ({"mass": "5 mm", "begin": 0.5}, "mass must be a number of kg, or one with its unit"),
    ({"mass": 0.01, "begin": 1.2}, r"begin of a payload must lie in \[0, 1\], got 1.2"),
    ({"mass": 0.01, "begin": 0.5, "end": 0.4}, "must not lie before its begin 0.5"),
    ({"mass": 0.01}, "begin of a payload is missing"),
    ({"mass": 0.01, "begin": 0.5, "hold": 1}, "key of a payload must be one of mass, begin, end"),
])  # fmt: skip
def test_what_is_no_payload_is_refused(values, words):
    with pytest.raises(ValueError, match=words):
        Robot(payload=[values])
