"""Robots of limbs on ground that resists otherwise back and across than ahead."""

from dataclasses import replace

import numpy as np
import pytest

from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES, Surface
from analytic.solvers.limbs.walk import walk
from mjsim.results.measures import measure
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate

ROBOT = quadruped()


def napped(name, back, across, nap="robot"):
    surface = SURFACES[name]
    keys = ("tip_force", "shear_strength")
    ways = {"back": back, "across": across}
    return replace(surface, nap=nap, **{f"{key}_{way}": part * getattr(surface, key)
                                        for key in keys for way, part in ways.items()})  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("ground", "left"), [
    (napped("felt", 1.5, 3.0), 0.7), (napped("gelatin", 1.5, 1.25), 1.0),
    (napped("gelatin", 0.67, 1.0, "ground"), 1.0),
])  # fmt: skip
def test_the_quadruped_goes_over_a_nap_as_the_reference_says(ground, left):
    gait = undulation("wave", left=left)
    path = walk(ROBOT, gait, ground, states=25)
    walked = measure(simulate(Scene(ROBOT, gait, ground, cycles=1)))
    ahead, aside = path.displacement / ROBOT.length
    assert walked.displacement == pytest.approx(ahead, abs=0.002)
    assert walked.aside == pytest.approx(aside, abs=0.005)
    assert np.degrees(walked.turn) == pytest.approx(np.degrees(path.turn), abs=0.4)


def test_mirrored_gaits_turn_the_other_way_over_a_nap_which_has_no_left_and_right():
    ground = napped("felt", 1.5, 3.0)
    turns = [
        measure(simulate(Scene(ROBOT, undulation("wave", **{side: 0.7}), ground, cycles=1))).turn
        for side in ("left", "right")
    ]  # fmt: skip
    assert turns[0] == pytest.approx(-turns[1], abs=1e-4)
    assert abs(turns[0]) > 0.01


def test_a_film_under_a_nap_is_refused_for_limbs():
    ground = Surface("wet", shear_strength={"ahead": 10, "back": 20}, viscosity=10.0)
    with pytest.raises(ValueError, match="viscosity of surface 'wet'"):
        Scene(ROBOT, undulation("wave"), ground)
