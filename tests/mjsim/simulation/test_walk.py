"""The robot walks: directions, distances and their convergence, against theory and identities."""

from functools import cache

import numpy as np
import pytest
import walks
from walks import BENT, measured, walk

from analytic import GAITS, SURFACES, Gait, Robot, direction, solve_elastica
from mjsim.scene import Scene
from mjsim.simulation.simulation import Simulation

EVERY = 4  # steps of a walk between states of theory


def predicted(surface, gait="wave", reverse=False, links=36):
    stages = GAITS[gait].reversed() if reverse else GAITS[gait]
    return walks.predicted(Robot(), stages, SURFACES[surface], links=links)


@pytest.mark.parametrize("reverse", [False, True])
@pytest.mark.parametrize("gait", list(GAITS))
@pytest.mark.parametrize("surface", list(SURFACES))
def test_the_direction_is_the_theory_s(surface, gait, reverse):
    numbers = measured(surface, gait, reverse=reverse)
    assert numbers.direction == direction(predicted(surface, gait, reverse, links=24), 1.0)


@pytest.mark.parametrize("surface", ["felt", "gelatin"])
@pytest.mark.parametrize(("links", "timestep"), [(24, 0.005), (12, 0.020), (48, 0.010)])
def test_the_distance_is_the_elastica_s_within_2_percent(surface, links, timestep):
    shift = measured(surface, links=links, timestep=timestep).displacement
    assert shift == pytest.approx(predicted(surface), rel=0.02)


def test_polyethylene_is_the_elastica_s_within_a_thousandth_of_the_length():
    assert measured("polyethylene").displacement == pytest.approx(
        predicted("polyethylene"), abs=0.001
    )


def test_felt_and_gelatin_are_equal_and_opposite_within_3_percent():
    """As the paper's law has it, whose friction is weak beside stiffness."""
    weak = (SURFACES[name].scaled(0.1) for name in ("felt", "gelatin"))
    felt, gelatin = (measured(surface, ramp_time=4.0).displacement for surface in weak)
    assert abs(felt + gelatin) < 0.03 * min(abs(felt), abs(gelatin))


def spread(values):
    values = np.array(values)
    return (values.max() - values.min()) / np.abs(values).min()


@pytest.mark.parametrize("surface", ["felt", "gelatin"])
def test_12_24_and_48_links_agree_within_2_percent(surface):
    assert spread([measured(surface, links=n).displacement for n in (12, 24, 48)]) < 0.02


@pytest.mark.parametrize("surface", ["felt", "gelatin"])
def test_time_steps_from_2_to_20_ms_agree_within_2_percent(surface):
    steps = (0.002, 0.005, 0.010, 0.020)
    assert spread([measured(surface, timestep=dt).displacement for dt in steps]) < 0.02


@pytest.mark.parametrize("surface", ["felt", "gelatin"])
def test_ramps_of_2_and_4_s_agree_within_3_percent(surface):
    assert spread([measured(surface, ramp_time=ramp).displacement for ramp in (2.0, 4.0)]) < 0.03


@pytest.mark.parametrize("surface", list(SURFACES))
def test_what_the_anchor_rule_does_not_explain_falls_as_the_gait_slows(surface):
    slips = [abs(measured(surface, ramp_time=ramp).unexplained) for ramp in (1.0, 2.0, 4.0)]
    assert slips[2] < slips[0]
    assert slips[1] < 0.001
    assert slips[2] < 0.0005


@pytest.mark.parametrize("surface", list(SURFACES))
def test_the_reversed_gait_goes_the_opposite_way(surface):
    there = measured(surface).displacement
    back = measured(surface, reverse=True).displacement
    assert there == pytest.approx(-back, abs=0.002)


def test_every_cycle_travels_alike():
    one, three = measured("gelatin"), measured("gelatin", cycles=3)
    assert three.displacement == pytest.approx(one.displacement, abs=5e-4)


@cache
def beside_the_elastica(surface):
    """A walk of four-second ramps and the elastica at its pressures, all along the cycle."""
    result = walk(surface, ramp_time=4.0)
    cycle = slice(result.start, None, EVERY)
    shapes = solve_elastica(Robot(), result.pressure[cycle], 24, "linearized", SURFACES[surface],
                            BENT)  # fmt: skip
    return result, cycle, shapes


@pytest.mark.parametrize("surface", list(SURFACES))
@pytest.mark.slow
def test_separation_follows_the_elastica_along_the_whole_cycle(surface):
    result, cycle, shapes = beside_the_elastica(surface)
    x, _ = result.nodes()
    gap = (x[cycle, -1] - x[cycle, 0] - shapes.separation) / Robot().length
    assert np.abs(gap).max() < 0.005
    assert np.sqrt(np.mean(gap**2)) < 0.001


@pytest.mark.parametrize("surface", list(SURFACES))
def test_side_contact_follows_the_elastica_along_the_whole_cycle(surface):
    """But for the instants when the strip leaves the ground and is back, as good as flat."""
    result, cycle, shapes = beside_the_elastica(surface)
    flat = shapes.contact_left + shapes.contact_right > 0.99 * Robot().length
    assert flat.sum() < 0.02 * len(flat)
    for shift, exact in (
        (result.contact_left, shapes.contact_left), (result.contact_right, shapes.contact_right),
    ):  # fmt: skip
        gap = np.abs(shift[cycle] - exact)[~flat] / Robot().length
        assert np.median(gap) < 0.001
        assert np.quantile(gap, 0.95) < 0.01  # a fifth of the pads' distance


@pytest.mark.parametrize(("surface", "end"), [("gelatin", 0), ("felt", -1)])
def test_the_anchored_end_does_not_creep(surface, end):
    """On the first ramp the left end is a tip and the right end lies flat."""
    result = walk(surface)
    x, _ = result.nodes()
    first = (result.time > 0.1) & (result.time <= 2.0)
    anchored = x[first][:, end]
    sliding = x[first][:, -1 - end]
    assert np.ptp(anchored) < 1e-4 * Robot().length
    assert np.ptp(sliding) > 0.02 * Robot().length


def test_tips_that_pull_at_each_other_for_long_creep_by_next_to_nothing():
    """An arch on two tips that are held: 6e-5 of the length in 100 s."""
    gait = Gait("arch", ((0, 0, 0), (1, 1, 0), (0, 0, 0)), 2.0)
    simulation = Simulation(Scene(ground="gelatin", gait=gait, contacts="ends"))
    peak = np.array([[1.0, 1.0, 0.0]]) * Robot().peak_pressure
    simulation.play(np.linspace(0, 1, 400)[:, None] * peak)
    simulation.play(np.repeat(peak, 1000, axis=0))
    before = simulation.nodes()[0][[0, -1], 0]
    simulation.play(np.repeat(peak, 4000, axis=0))  # 20 s
    crept = simulation.nodes()[0][[0, -1], 0] - before
    assert np.abs(crept).max() < 2e-5 * Robot().length


@pytest.mark.parametrize("surface", list(SURFACES))
def test_a_strip_at_rest_stays_where_it_is(surface):
    result = walk(surface)
    settling = result.time <= 0
    assert np.ptp(result.coordinates[settling, 0]) < 1e-9
    assert np.abs(result.nodes()[1][settling]).max() < 1e-4 * Robot().length


def test_nothing_sinks_into_the_ground():
    _, z = walk("felt").nodes()
    assert z.min() > -1e-3 * Robot().length


def test_the_paper_s_three_claims_hold_at_once_at_its_best_amplitude():
    """Forward on felt, still on polyethylene, backward on gelatin, at a quarter of the length."""
    felt, still, gelatin = (measured(name, ramp_time=8.0) for name in SURFACES)
    assert felt.displacement == pytest.approx(0.034, abs=0.001)
    assert abs(still.displacement) < 0.002
    assert gelatin.displacement == pytest.approx(-0.034, abs=0.001)
    assert still.direction == "none"
    assert felt.amplitude == pytest.approx(0.250, abs=0.002)


@pytest.mark.parametrize("surface", ["felt", "gelatin"])
def test_equal_links_are_of_lower_order_but_converge_to_the_same(surface):
    """Numbers of links that are no multiple of 6 fall back on half links at both ends."""
    fine = measured(surface, links=48).displacement
    errors = [abs(measured(surface, links=n).displacement / fine - 1) for n in (10, 20, 40)]
    assert errors[0] > errors[1] > errors[2]
    assert errors[0] < 0.12
    assert errors[2] < 0.03
