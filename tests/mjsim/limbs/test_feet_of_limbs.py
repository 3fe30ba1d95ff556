"""Feet of robots of limbs, in theory and MuJoCo."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, Robot, predict
from analytic.scene.feet import Foot
from analytic.scene.limbs import LimbedRobot, as_strip, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES, Surface
from analytic.solvers.limbs.contact_state import Contact
from analytic.solvers.limbs.contacts import Contacts
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.walk import walk
from mjsim.files.scene_tables.tables import build
from mjsim.files.scene_tables.written import as_tables
from mjsim.model.standalone.strips import standalone_spec
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

GROUND = SURFACES["polyethylene"]
QUICK = Numerics(timestep=0.02, links=4)
PAD = Foot(0.6, 1, grip=0.5, grip_back=1.5)


def shod(robot, *feet, limbs=None):
    """A robot with feet on limbs of these names, on all if None."""
    return LimbedRobot(
        tuple(
            replace(limb, strip=replace(limb.strip, feet=feet))
            if limbs is None or limb.name in limbs else limb
            for limb in robot.limbs
        ),
        robot.peak_pressure,
    )  # fmt: skip


@pytest.mark.parametrize("bent", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_feet_everywhere_are_ground_that_is_scaled(bent):
    """By a power of two, which rounds nothing."""
    robot, gait = quadruped(), undulation("wave", left=0.7)
    paths = [
        walk(each, gait, ground, states=3, elements=4, bent=bent, twists=0)
        for each, ground in ((shod(robot, Foot(0, 1, grip=2.0)), GROUND),
                             (robot, GROUND.scaled(2.0)))
    ]  # fmt: skip
    assert np.array_equal(*(path.place for path in paths))


def test_feet_everywhere_are_ground_that_is_scaled_in_mujoco():
    gait, robot = undulation("wave"), quadruped()
    walks = [
        simulate(Scene(each, gait, ground), QUICK).position
        for each, ground in ((shod(robot, Foot(0, 1, grip=2.0)), GROUND),
                             (robot, GROUND.scaled(2.0)))
    ]  # fmt: skip
    assert np.array_equal(*walks)


def test_feet_everywhere_that_are_unlike_back_and_across_are_a_nap_of_the_robots():
    keys = ("tip_force", "shear_strength")
    ways = {"back": 2.0, "across": 4.0}
    nap = replace(GROUND, **{f"{key}_{way}": part * getattr(GROUND, key)
                             for key in keys for way, part in ways.items()})  # fmt: skip
    robot, gait = quadruped(), undulation("wave", left=0.7)
    feet = shod(robot, Foot(0, 1, grip_back=2.0, grip_across=4.0))
    pairs = ((feet, GROUND), (robot, nap))
    paths = [walk(each, gait, ground, states=2, elements=4, twists=0, bent=False).place
             for each, ground in pairs]  # fmt: skip
    assert np.array_equal(*paths)
    walks = [simulate(Scene(each, gait, ground), QUICK).position for each, ground in pairs]
    assert np.array_equal(*walks)


def test_a_claw_on_one_leg_adds_its_hold_to_the_legs_share_by_its_chamber():
    robot = shod(quadruped(), Foot(1, 1, hold=0.05, chamber="rear-left"), limbs=["rear-left"])
    finder, limb = Contacts(Tree(robot, 4)), robot.place("rear-left")
    end = robot.limbs[limb].strip.length
    tip = Contact(limb, "end", 0.0, (end, end), (-0.001, 0.001), 0.01)
    for part in (0.0, 0.5, 1.0):
        pressures = np.zeros(5)
        pressures[limb] = part * robot.peak_pressure
        bound, _ = finder.resistance(tip, GROUND, pressures=pressures)
        assert bound == 0.5 * GROUND.tip_force + 0.05 * part


@pytest.mark.parametrize("chamber", [pytest.param(None, marks=pytest.mark.slow), "left"])
def test_a_strip_on_feet_described_as_limbs_goes_as_far_as_the_strip(chamber):
    """In the limit of weak friction; the rear leg runs back from the torso."""
    strip = Robot()
    names = {"left": "rear", "right": "front", None: None}
    mirror = {"left": "right", None: None}
    rear, front = (
        replace(PAD, chamber=names[name]) for name in (chamber, mirror[chamber])
    )  # fmt: skip
    limbs = shod(shod(as_strip(strip), rear, limbs=["rear"]), front, limbs=["front"])
    feet = (Foot(0, 0.4 / 3, 0.5, 1.5, chamber=chamber),
            Foot(1 - 0.4 / 3, 1, 0.5, 1.5, chamber=mirror[chamber]))  # fmt: skip
    expected = predict(replace(strip, feet=feet), GAITS["wave"], GROUND).locomotion.per_cycle
    # the columns of its gait: torso, rear, front
    stages = tuple((middle, left, right) for left, middle, right in GAITS["wave"].stages)
    gait = replace(GAITS["wave"], name="of limbs", stages=stages)
    path = walk(limbs, gait, GROUND, states=20, elements=12, bent=False)
    assert path.displacement[0] == pytest.approx(expected, abs=2e-3 * strip.length)


@pytest.mark.slow
@pytest.mark.parametrize("ground", ["felt", "polyethylene", "gelatin"])
def test_the_quadruped_on_directional_feet_goes_as_the_reference_says(ground):
    robot = shod(quadruped(), PAD, limbs=quadruped().outer)
    gait, surface = undulation("wave"), SURFACES[ground]
    path = walk(robot, gait, surface, states=25)
    walked = measure(simulate(Scene(robot, gait, surface)))
    assert walked.displacement == pytest.approx(path.displacement[0] / robot.length, abs=0.005)


def test_feet_of_limbs_are_written_as_they_are_read():
    robot = shod(quadruped(), replace(PAD, chamber="torso"), limbs=["front-left"])
    scene = Scene(robot, undulation("wave"), GROUND)
    again, _ = build(as_tables(scene, Numerics()))
    feet = again.robot.limbs[robot.place("front-left")].strip.feet
    assert feet == (replace(PAD, chamber="torso"),)
    assert not again.robot.limbs[0].strip.feet


def test_what_limbs_on_feet_cannot_do_is_refused_in_one_line():
    robot, gait = shod(quadruped(), PAD), undulation("wave")
    cloth = Surface("cloth", 0.01, 10.0, tip_force_back=0.02, nap="ground")
    wet = Surface("wet", 0.01, 10.0, viscosity=1.0)
    with pytest.raises(ValueError, match="without a nap of the ground's own, got surface 'cloth'"):
        Scene(robot, gait, cloth)
    with pytest.raises(ValueError, match="without viscosity, got surface 'wet'"):
        Scene(robot, gait, wet)
    with pytest.raises(ValueError, match="chamber of a foot must be one of torso, rear-left"):
        Scene(shod(quadruped(), Foot(0, 1, chamber="left")), gait, GROUND)
    with pytest.raises(ValueError, match="without feet"):
        standalone_spec(Scene(robot, gait, GROUND))


def test_under_mu_n_a_foot_of_a_limb_holds_besides_its_load():
    robot, law = quadruped(), "coulomb"
    held = shod(robot, Foot(0.8, 1, hold=0.02), limbs=("rear-left", "rear-right"))
    ways = [
        (walk(each, undulation("wave"), SURFACES["felt"], 8, 4, law=law, twists=0).displacement[0],
         measure(simulate(Scene(each, "wave", "felt", friction=law),
                          Numerics(links=4, twists=0))).displacement * each.length)
        for each in (robot, held)
    ]  # fmt: skip
    for theory, mujoco in ways:
        assert mujoco == pytest.approx(theory, abs=0.004 * robot.length)
    assert abs(ways[0][0] - ways[1][0]) > 0.01 * robot.length
