"""Friction that is unlike ahead and back, in MuJoCo."""

import math
from dataclasses import replace

import numpy as np
import pytest

from analytic import SURFACES, Gait, predict
from mjsim.model.standalone.strips import standalone_spec
from mjsim.results.measures import measure
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene
from mjsim.simulation.side_by_side.layout import refusal
from mjsim.simulation.simulation import simulate

KEYS = ("tip_force", "shear_strength", "friction", "tip_friction")
STILL = Gait("still", ((0, 0, 0), (0, 0, 0)), 2.0)


def napped(name, ahead, back):
    """A named surface, so many times as strong ahead and back."""
    surface = SURFACES[name]
    return replace(surface, **{key: ahead * getattr(surface, key) for key in KEYS},
                   **{f"{key}_back": back * getattr(surface, key) for key in KEYS})  # fmt: skip


# an independent trial in MuJoCo: a force of half the difference on each end, by hand
TRIALS = [("felt", 1.0, 1.5, 0.0334), ("polyethylene", 1.0, 1.5, 0.1553),
          ("gelatin", 1.0, 1.5, 0.0781), ("polyethylene", 1.5, 1.0, -0.1579),
          ("gelatin", 1.5, 1.0, -0.1496)]  # fmt: skip


@pytest.mark.parametrize(("name", "ahead", "back", "expected"), TRIALS)
def test_the_wave_goes_as_far_over_a_nap_as_an_independent_trial(name, ahead, back, expected):
    walk = simulate(Scene(ground=napped(name, ahead, back), cycles=1, contacts="ends"))
    assert measure(walk).displacement == pytest.approx(expected, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "ahead", "back"), [row[:3] for row in TRIALS[1:]])
@pytest.mark.parametrize("law", ["constant", "coulomb"])
def test_slow_walks_over_a_nap_come_near_the_theory(name, ahead, back, law):
    if law == "coulomb" and name == "polyethylene":
        back *= 1.3  # bounds of ends that carry half the weight each are alike else
    scene = Scene(ground=napped(name, ahead, back), cycles=2, contacts="ends", friction=law)
    scene = replace(scene, gait=replace(scene.gait, ramp_time=8.0))
    theory = predict(scene.robot, scene.gait, scene.ground, "elastica", 25,
                     scene.reference_friction)  # fmt: skip
    expected = theory.locomotion.per_cycle / scene.robot.length
    assert measure(simulate(scene)).displacement == pytest.approx(expected, rel=0.02, abs=2e-3)


@pytest.mark.parametrize("law", ["constant", "coulomb"])
@pytest.mark.parametrize(
    ("contacts", "down"),
    [("ends", -1.0), ("all", 1.0), pytest.param("ends", 1.0, marks=pytest.mark.slow),
     pytest.param("all", -1.0, marks=pytest.mark.slow)],
)  # fmt: skip
def test_a_flat_strip_slides_down_a_slope_only_beyond_the_bound_that_way(law, contacts, down):
    """Its weight's part along the slope against tau by its area, or against mu N."""
    robot, ground = Scene().robot, napped("felt", 0.8, 1.2).scaled(0.25)
    under = ground.against("ahead" if down > 0 else "back")
    area = robot.width * robot.length
    limit = {"constant": math.asin(under.shear_strength * area / robot.weight),
             "coulomb": math.atan(under.friction)}[law]  # fmt: skip
    outcomes = []
    for part in (0.98, 1.02):
        scene = Scene(robot=robot, gait=STILL, ground=ground, slope=-down * part * limit,
                      friction=law, contacts=contacts, cycles=1)  # fmt: skip
        walk = simulate(scene)
        ahead = walk.position[-1, 0, 0, 0] - walk.position[0, 0, 0, 0]
        outcomes.append((walk.status, down * ahead / robot.length))
    (held, crept), (slid, far) = outcomes
    assert (held, slid) == (Status.OK, Status.SLID)
    assert abs(crept) < 1e-2 < far


@pytest.mark.parametrize(("ahead", "back"), [(1.0, 1.5), (1.5, 1.0)])
def test_tips_slide_at_the_bound_that_way_and_friction_only_takes_work(ahead, back):
    surface = napped("gelatin", ahead, back)
    walk = simulate(Scene(ground=surface, cycles=1, contacts="ends"), forces=True)
    speed = np.gradient(walk.position[:, 0, [0, -1], 0], walk.time, axis=0)
    friction = walk.forces.friction[:, [0, -1]]
    tips = np.stack([walk.contact_left, walk.contact_right], axis=1) == 0
    way = 1.0 if ahead < back else -1.0  # that tips of equal load slide
    slid = friction[(way * speed > 3e-4) & tips & (walk.time > 0.1)[:, None]]
    bound = surface.tip_force if way > 0 else surface.tip_force_back
    assert len(slid) > 100
    assert np.median(slid) == pytest.approx(-way * bound, rel=1e-3)
    power = friction * speed
    assert power.max() < 0.01 * -power.min()


def test_a_file_that_walks_by_itself_and_a_batch_refuse_a_nap():
    scene = Scene(ground=napped("felt", 1.0, 1.5))
    with pytest.raises(ValueError, match="alike in all directions"):
        standalone_spec(scene, Numerics())
    assert "alike in all directions" in refusal(scene)
