"""Shoes: constant bounds by MuJoCo's own friction, in a loop of mj_step alone."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Robot
from analytic.scene.ground import Patches
from analytic.scene.surface import Surface
from mjsim.model.standalone.shoes import refusal, signed_lengths
from mjsim.model.standalone.strips import standalone_spec
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.alone import distance
from mjsim.simulation.simulation import simulate

NEAR = 0.003  # of L; forward and backward are +-0.033
OWN = Robot(length=0.11, mass=0.014, width=0.022, thickness=0.003, modulus=0.25e6,
            peak_pressure=6e3)  # fmt: skip


def scene_on(name, gait="wave"):
    return Scene(gait=GAITS[gait], ground=SURFACES[name], chamber="constant-pressure",
                 actuation="actuators")  # fmt: skip


def by_mjsim(scene):
    """Under the bounds that mjsim sets in each step."""
    return measure(simulate(scene)).displacement


@pytest.mark.parametrize("name", list(SURFACES))
def test_the_three_scenes_go_as_under_the_bounds_of_the_paper(name):
    scene = scene_on(name)
    (shift,) = distance(scene)
    assert shift == pytest.approx(by_mjsim(scene), abs=NEAR)
    direction = 0 if abs(shift) < 0.002 else np.sign(shift)
    assert direction == {"felt": 1, "polyethylene": 0, "gelatin": -1}[name]


@pytest.mark.slow
@pytest.mark.parametrize("name", list(SURFACES))
def test_so_they_do_in_a_second_cycle_at_slower_ramps_and_at_finer_steps(name):
    scene = scene_on(name)
    expected = by_mjsim(scene)
    first, second = distance(scene, cycles=2)
    assert second == pytest.approx(first, abs=0.0005)
    assert distance(scene, 8.0) == pytest.approx(expected, abs=NEAR)
    assert distance(scene, 2.0, Numerics(timestep=0.0025)) == pytest.approx(expected, abs=NEAR)


@pytest.mark.slow
@pytest.mark.parametrize("name", list(SURFACES))
@pytest.mark.parametrize("gait", [GAITS["wave"].reversed(), GAITS["full-wave"]], ids=str)
def test_the_files_of_the_wave_walk_it_backward_and_the_full_wave_too(name, gait):
    scene = scene_on(name)
    model = standalone_spec(scene).compile()
    other = replace(scene, gait=gait)
    assert distance(other, model=model) == pytest.approx(by_mjsim(other), abs=0.004)


def test_a_robot_of_ones_own_goes_as_far_as_in_mjsim():
    ground = Surface("mine", shear_strength=30.0)
    scene = Scene(OWN, ground=ground, chamber="constant-pressure", actuation="actuators")
    assert distance(scene) == pytest.approx(by_mjsim(scene), abs=0.001)


def test_the_signed_length_is_the_contact_length_where_it_decides():
    """On polyethylene the side resists as the tip does over L / 6, and ends at 0."""
    scene = scene_on("polyethylene")
    left, right = signed_lengths(scene)
    length, strip = scene.strip.length, np.diag([1.0, 1.0, 1.0])
    # 100 but for 16 % of it, as in the walk by mjsim
    assert right.rest - right.slopes @ (0.84 * strip[0]) == pytest.approx(length / 6, rel=0.05)
    # the end itself is at a tip with a hundredth of its pressure
    assert right.rest - right.slopes @ (0.01 * strip[2]) < 0
    assert left.rest - left.slopes @ (0.01 * strip[0]) < 0
    # flat as a whole, the side carries more than twice that
    assert right.rest > length / 3


@pytest.mark.parametrize(
    "scene",
    [
        Scene(body="cable"),
        Scene(slope=0.02),
        Scene(friction="coulomb"),
        Scene(contacts="all"),
        Scene(ground=Patches("two", (0.05,), (SURFACES["felt"], SURFACES["gelatin"]))),
        Scene(ground=replace(SURFACES["felt"], viscosity=10.0)),
    ],
)
def test_what_shoes_do_not_do_is_told(scene):
    assert refusal(scene)
