"""Error bars of limbs: errors of parts of a cycle add up, in the reference and in MuJoCo alike."""

from dataclasses import replace

import numpy as np
import pytest

from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES
from analytic.solvers.limbs.path import Path
from mjsim.results.measures import measure
from mjsim.results.prediction import QUASI_STATIC, Reference, error_bars
from mjsim.scene import Numerics, Scene
from mjsim.simulation.second_walks import by_part, changes
from mjsim.simulation.simulation import simulate

SCENE = Scene(quadruped(), gait=undulation("wave", left=0.7), ground=SURFACES["gelatin"])
LENGTH = SCENE.robot.length


def reference(place, heading):
    """One through places (B, 2) [m] and headings (B,) [rad] at equal intervals of a cycle."""
    times = np.linspace(0, SCENE.gait.period, len(place))
    path = Path(SCENE.robot, np.zeros((len(place), 5)), times, [], [], place, heading)
    moves, turns = path.by_cycle(1)
    return Reference(QUASI_STATIC, moves[0] / LENGTH, float(turns[0]), moves[:, 0] / LENGTH, (),
                     path)  # fmt: skip


def test_an_error_that_goes_and_comes_back_within_a_cycle_counts_twice():
    ramps, out = SCENE.gait.ramps, np.array([0.003, 0.004])
    place, heading = np.zeros((ramps + 1, 2)), np.zeros(ramps + 1)
    place[:, 0] = np.linspace(0, 0.01, ramps + 1)
    away, turned = place.copy(), heading.copy()
    away[2] += out
    turned[3] += 0.02
    bar, turn_bar = error_bars(SCENE, reference(place, heading), reference(away, turned))
    assert bar == pytest.approx(2 * 0.005 / LENGTH)
    assert turn_bar == pytest.approx(2 * 0.02)


def test_an_error_bar_is_no_less_than_the_change_of_the_whole_cycle():
    rng = np.random.default_rng(1)
    for _ in range(20):
        one, two = (
            reference(rng.normal(0, 0.01, (31, 2)), rng.normal(0, 0.1, 31)) for _ in range(2)
        )
        bar, turn_bar = error_bars(SCENE, one, two)
        # each of them in its own direction
        assert bar >= np.hypot(*(one.displacement - two.displacement)) - 1e-12
        assert turn_bar >= abs(one.turn - two.turn) - 1e-12


def test_parts_of_a_walk_in_mujoco_add_up_to_it_and_it_has_no_error_beside_itself():
    walk = simulate(
        replace(SCENE, cycles=2), Numerics(links=2, twists=1, timestep=0.05, contact_softness=0.05)
    )
    moves, turns = by_part(walk)
    numbers = measure(walk)
    assert moves[-1].sum(axis=0) / LENGTH == pytest.approx(
        [numbers.displacement, numbers.aside], abs=1e-12
    )
    assert turns[-1].sum() == pytest.approx(numbers.turn, abs=1e-12)
    assert changes(walk, walk) == (0.0, 0.0)
