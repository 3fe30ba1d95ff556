"""Contacts that look ahead along the curved path of a link neither hop nor sink."""

import copy
from dataclasses import replace

import numpy as np
import pytest

from analytic.scene.gait import GAITS, Gait
from analytic.scene.surface import SURFACES
from mjsim.scene import Numerics, Scene
from mjsim.scene.valves import Valves
from mjsim.simulation.simulation import Simulation, simulate

STRAIGHT = Numerics(links=12, timestep=0.01)
CURVED = replace(STRAIGHT, contact_path="curved")
_STAGES = GAITS["wave"].reversed().stages
FAST = Scene(gait=Gait("fast", _STAGES, (0.5,) * (len(_STAGES) - 1)), ground=SURFACES["gelatin"],
             contacts="all", cycles=2)  # fmt: skip


def depth_and_distance(numerics):
    """Depth of the deepest node in a fast gait, and the distance, over L."""
    walk = simulate(FAST, numerics)
    assert walk.status == "ok"
    moved = walk.line[-1, 0, 0] - walk.line[walk.start, 0, 0]
    return -walk.line[walk.start :, :, 2].min() / 0.13, moved / 0.13


def test_ends_that_swing_do_not_sink_and_go_as_far_as_with_finer_steps():
    finer = 0.0661  # along straight paths at 0.25 ms, of which 1 ms is 2 % short
    curved, straight = depth_and_distance(CURVED), depth_and_distance(STRAIGHT)
    assert curved[0] < 3e-4 < 20e-3 < straight[0]
    assert curved[1] == pytest.approx(finer, rel=0.02)
    assert straight[1] != pytest.approx(finer, rel=0.08)


def test_an_end_that_comes_down_does_not_sink_and_is_a_side_at_once():
    # two chambers vent from an arch, and the left end turns down onto its side
    scene = Scene(ground=SURFACES["polyethylene"], contacts="all", valves=Valves(0.5))
    simulation = Simulation(scene, replace(CURVED, links=24, timestep=0.0025))
    peak, height, contact = scene.robot.peak_pressure, [], []
    for valves in ([0.0, peak, peak], [0.0, 0.0, 0.0]):
        for _ in range(240):
            seen = simulation.play([valves])
            height.append(simulation.nodes()[0, 1, 2])
            contact.append(seen.contact_left)
    landed = 240 + int(np.argmax(np.array(height[240:]) < 1e-7))
    side = 240 + int(np.argmax(np.array(contact[240:]) > 0.0))
    assert height[240] > 1e-4
    assert side - landed <= 2  # 3 where contacts begin in the ground
    assert min(height[240:]) > -1e-6  # -6e-6 there


def test_a_slow_gait_is_the_same_by_both_paths():
    scene = Scene(ground=SURFACES["gelatin"])
    one, other = (simulate(scene, numerics).line[-1, 0, 0] for numerics in (STRAIGHT, CURVED))
    assert one == pytest.approx(other, abs=2e-4 * 0.13)


def test_a_copy_in_mid_walk_goes_on_along_curved_paths():
    simulation = Simulation(FAST, CURVED)
    valves = np.random.default_rng(0).uniform(0, FAST.robot.peak_pressure, (60, 3))
    simulation.play(valves[:30])
    other = copy.deepcopy(simulation)
    assert np.array_equal(simulation.play(valves[30:]).place, other.play(valves[30:]).place)


@pytest.mark.parametrize(
    ("scene", "numerics"),
    [(Scene(body="cable"), CURVED), (Scene(), replace(CURVED, integrator="Euler"))],
)
def test_what_curved_paths_cannot_do_is_refused(scene, numerics):
    with pytest.raises(ValueError, match="contact_path curved needs body chain"):
        Simulation(scene, numerics)
