"""A controller that feels how far each cycle went, in theory and in MuJoCo."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from analytic.locomotion import displacements
from analytic.scene.gait import GAITS, Gait
from analytic.scene.ground import Patches
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from analytic.solvers.elastica import solve_elastica
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation
from studies.control.cycles import Cycles, stripes
from studies.control.reversing import LEAST, REPERTOIRE, Chooser, Reversing

FELT, GELATIN = SURFACES["felt"], SURFACES["gelatin"]
L = Robot().length


def seam(place, one=FELT, two=GELATIN):
    return Patches("seam", (place * L,), (one, two))


@pytest.fixture(scope="module")
def cycles():
    return Cycles(Robot(), seam(1.15))


@given(st.lists(st.floats(LEAST, 0.04), max_size=50))
def test_without_noise_progress_changes_nothing(went):
    chooser = Chooser(4)
    assert [chooser.after_cycle(d) for d in went] == [0] * len(went)


def test_without_progress_it_changes_after_three_cycles_and_at_once_when_thrown_back():
    chooser = Chooser(4)
    assert [chooser.after_cycle(0.0) for _ in range(7)] == [0, 0, 1, 1, 1, 2, 2]
    assert Chooser(4).after_cycle(-0.03) == 1


def test_noise_of_a_good_gait_changes_it_rarely_and_a_bad_one_is_found_all_the_same():
    rng, noise = np.random.default_rng(0), 0.01
    chooser = Chooser(4, noise)
    for d in 0.034 + noise * rng.standard_normal(2000):
        chooser.after_cycle(d)
    assert chooser.changes <= 2
    delays = []
    for _ in range(100):
        chooser, count = Chooser(4, noise), 0
        while chooser.after_cycle(-0.034 + noise * float(rng.standard_normal())) == 0:
            count += 1
        delays.append(count + 1)
    assert np.mean(delays) < 3


def test_a_cycle_on_patches_is_the_prediction_of_the_same_states(cycles):
    for left in (0.0, 0.05, 0.1):
        ground = seam(1.15 - left)
        path = Robot().peak_pressure * GAITS["wave"].path(50)[0]
        alone = displacements(solve_elastica(Robot(), path, 48), ground)
        assert cycles.displacement(left * L, 0) == pytest.approx(alone.per_cycle, abs=1e-12)


@pytest.mark.parametrize("place", [-0.3, 0.2, 0.6, 0.9, 1.3])
def test_backwards_a_gait_goes_as_far_back_so_no_map_helps_who_only_reverses(place):
    theory = Cycles(Robot(), seam(place), (GAITS["wave"], GAITS["wave"].reversed()))
    forward, backward = (theory.displacement(0.0, i) for i in (0, 1))
    assert forward == pytest.approx(-backward, abs=3e-3 * L)


@pytest.mark.slow
def test_the_wave_stalls_at_the_seam_and_so_does_a_map_of_two_ways_but_not_the_controller(cycles):
    alone = cycles.without(60).left[-1] / L
    two = Cycles(Robot(), seam(1.15), (GAITS["wave"], GAITS["wave"].reversed()))
    assert two.knowing(60).left[-1] / L < alone + 0.01
    assert alone < 0.2
    assert cycles.reversing(60).left[-1] / L > alone + 0.1
    assert cycles.reversing(60, 0.01, seed=1).left[-1] / L > alone + 0.08


@pytest.mark.slow
def test_from_gelatin_onto_felt_it_goes_on_and_the_wave_alone_runs_away_backwards():
    theory = Cycles(Robot(), seam(1.15, GELATIN, FELT))
    assert theory.without(40).left[-1] < -1.2 * L
    reversing, best = (walk.left[-1] / L for walk in (theory.reversing(60), theory.knowing(60)))
    assert best - 0.1 < reversing <= best + 0.02


@pytest.mark.slow
def test_on_stripes_of_three_lengths_it_loses_a_tenth_to_one_with_the_map(cycles):
    theory = Cycles(Robot(), stripes(FELT, GELATIN, 3 * L, 5 * L))
    reversing, best = (walk.left[-1] / L for walk in (theory.reversing(80), theory.knowing(80)))
    assert 0.9 * best < reversing <= best


@pytest.mark.slow
def test_in_mujoco_it_chooses_as_in_theory_and_comes_as_far():
    ground, count = seam(1.15), 24
    numerics = Numerics(links=12, timestep=0.01)
    policy = Reversing(Robot(), 0.01)
    walk = Simulation(Scene(ground=ground, cycles=count), numerics).run(policy)
    track = Cycles(Robot(), ground).reversing(count)
    rests = np.searchsorted(walk.time, 10.0 * np.arange(count + 1) - 1e-9)
    apart = np.abs(walk.line[np.minimum(rests, len(walk.time) - 1), 0, 0] - track.left) / L
    assert apart[:10].max() < 0.015  # friction bends the strip in MuJoCo and not in the theory
    assert apart.max() < 0.03
    assert policy.chosen[:10] == track.chosen[:10].tolist() == [0] * 10
    assert 1 in policy.chosen
    assert REPERTOIRE[1] is GAITS["pulse"]


def test_gaits_that_begin_under_pressure_cannot_follow_each_other():
    inflated = Gait("inflated", ((1, 0, 0), (0, 1, 0), (1, 0, 0)))
    for build in (lambda: Reversing(Robot(), 0.01, (inflated,)),
                  lambda: Cycles(Robot(), seam(1.0), (inflated,))):  # fmt: skip
        with pytest.raises(ValueError, match="must begin and end without pressure"):
            build()
    with pytest.raises(ValueError, match="noise must be a finite number"):
        Chooser(4, -1.0)
