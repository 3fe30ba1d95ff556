"""Adhesive ground, and ground that resists more at rest, under limbs: closed forms and the strip's
numbers.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from analytic import GAITS, SURFACES, Elastica, Friction, Gait, Patches, Robot, Surface, predict
from analytic.friction.contact_length import PASSIVE, flat_pressures
from analytic.scene import pneunet
from analytic.scene.ground import Incline
from analytic.scene.limbs import Limb, LimbedRobot, as_strip, quadruped
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.statics import Statics
from analytic.solvers.limbs.walk import shapes, walk

STRIP = Robot()
SOLO = LimbedRobot((Limb("solo", STRIP),))
AREA = STRIP.width * STRIP.length
LIGHT = replace(STRIP, weight_per_length=0.05)


def by_limb(gait):
    """A strip's gait in the order torso, rear, front."""
    return Gait(gait.name, tuple(map(tuple, np.array(gait.stages)[:, [1, 0, 2]].tolist())))


def stays(ground, slope, law="constant"):
    """Tell whether a limb without pressure stays where it lies on a slope [rad]."""
    path = walk(SOLO, GAITS["wave"], ground, law=law, path=np.zeros((3, 3)),
                times=np.arange(3.0), incline=Incline(slope))  # fmt: skip
    return path.converged and bool(np.abs(path.place).max() < 1e-4 * STRIP.length)


@pytest.mark.parametrize("ratio", [1.0, 1.5])
def test_a_limb_at_rest_breaks_away_at_static_ratio_times_its_bound(ratio):
    """W sin(slope) = ratio tau area."""
    ground = Surface("stiction", shear_strength=10.0, static_ratio=ratio, stribeck_speed=1e-3)
    limit = math.asin(ratio * ground.shear_strength * AREA / STRIP.weight)
    assert stays(ground, 0.98 * limit)
    assert not stays(ground, 1.02 * limit)


def test_by_load_adhesion_holds_a_limb_as_weight_does():
    """W sin(slope) = mu (W cos(slope) + pull of adhesion)."""
    ground = Surface("sticky", friction=0.2, adhesion=1e-3)
    pull = ground.press(STRIP.width) * STRIP.length
    assert pull > 0.2 * STRIP.weight

    def resists(slope):
        return 0.2 * (STRIP.weight * math.cos(slope) + pull)

    slopes = np.linspace(0.0, 1.0, 10001)
    limit = next(s for s in slopes.tolist() if STRIP.weight * math.sin(s) > resists(s))
    assert stays(ground, 0.98 * limit, "coulomb")
    assert not stays(ground, 1.02 * limit, "coulomb")


@pytest.mark.parametrize(
    "ground",
    [
        pytest.param(replace(SURFACES["felt"], adhesion=0.05), id="sticky felt"),
        pytest.param(
            replace(SURFACES["gelatin"], adhesion=0.01), id="sticky gelatin", marks=pytest.mark.slow
        ),
        pytest.param(
            Patches("two", (0.5 * STRIP.length,), (
                Surface("stronger", tip_force=0.030, shear_strength=8.0),
                Surface("at rest", tip_force=0.025, shear_strength=8.0, static_ratio=1.5,
                        stribeck_speed=1e-2),
            )), id="stronger at rest on the right"),
    ],
)  # fmt: skip
def test_a_strip_as_a_tree_goes_as_far_as_the_strip_s_elastica(ground):
    gait, friction = GAITS["wave"], Friction(tension=1.0, contacts="all")
    theory = predict(STRIP, gait, ground, Elastica(18), 12, friction=friction)
    path = walk(as_strip(STRIP), by_limb(gait), ground, 12, 6)
    expected = theory.locomotion.per_cycle
    assert path.converged
    assert path.displacement[0] == pytest.approx(expected, abs=4e-4 * STRIP.length)


@pytest.mark.slow
def test_what_holds_as_it_is_stronger_at_rest_is_left_behind_by_a_stronger_tip_that_slides():
    """Then it goes as if the other tip were as strong in sliding as it is at rest."""
    gait = by_limb(GAITS["wave"])

    def went(tip, ratio):
        left = Surface("left", tip_force=0.030, shear_strength=8.0)
        right = Surface("right", tip_force=tip, shear_strength=8.0, static_ratio=ratio,
                        stribeck_speed=1e-2)  # fmt: skip
        ground = Patches("two", (0.5 * STRIP.length,), (left, right))
        return float(walk(as_strip(STRIP), gait, ground, 12, 6).displacement[0] / STRIP.length)

    weak, at_rest, strong = went(0.025, 1.0), went(0.025, 1.5), went(0.0375, 1.0)
    assert at_rest == pytest.approx(strong, abs=3e-4)
    assert abs(weak - strong) > 1.2e-3


@pytest.mark.slow
@pytest.mark.parametrize("adhesion", [0.05, 0.2])
def test_a_limb_peels_at_the_curvature_of_the_closed_form(adhesion):
    """D kappa^2 = 128/9 gamma q, see test_adhesion of the elastica."""
    ground = Surface("sticky", adhesion=adhesion)

    def strength(pressure):
        """D kappa^2 over that of the closed form."""
        kappa = float(pneunet.natural_curvature(LIGHT, pressure))
        bent = float(pneunet.rigidity(LIGHT, pressure)) * kappa**2
        return bent / (128 / 9 * adhesion * LIGHT.width)

    def pressure_of(part):
        return brentq(lambda pressure: strength(pressure) - part, 0, LIGHT.peak_pressure)

    under, over = pressure_of(0.9), pressure_of(1.1)
    pressures = np.append(np.linspace(0, under, 4), over)[:, None] * [0.0, 1.0, 0.0]
    _, rests = shapes(as_strip(LIGHT), pressures, 24, surface=ground)
    peeled = [rest.nodes[:, 2].max() > 2 * ground.adhesion_reach for rest in rests]
    assert peeled == [False] * 4 + [True]


def test_the_ground_pushes_as_much_as_weight_and_adhesion_pull():
    robot, ground = quadruped(), replace(SURFACES["felt"], adhesion=0.02)
    statics = Statics(Tree(robot, 4, 2, surface=ground))
    rest = statics.equilibrium(np.zeros(5), statics.flat())
    pull = sum(ground.press(limb.strip.width) * limb.strip.length for limb in robot.limbs)
    assert rest.converged
    assert rest.force.sum() == pytest.approx(robot.weight + pull, rel=1e-6)


def test_hardly_any_adhesion_keeps_no_inflated_end_flat():
    pressures = [
        flat_pressures(STRIP, Surface("sticky", adhesion=adhesion))[0]
        for adhesion in (0.0, 1e-9, 0.1)
    ]
    assert pressures[0] == pressures[1] == PASSIVE * STRIP.peak_pressure
    kappa = float(pneunet.natural_curvature(STRIP, pressures[2]))
    bent = float(pneunet.rigidity(STRIP, pressures[2])) * kappa**2
    assert bent == pytest.approx(128 / 9 * 0.1 * STRIP.width)


def test_ground_that_resists_by_speed_asks_for_times():
    ground = replace(SURFACES["felt"], static_ratio=1.5, stribeck_speed=1e-3)
    with pytest.raises(ValueError, match="times of the shapes"):
        walk(SOLO, GAITS["wave"], ground, path=np.zeros((2, 3)))
