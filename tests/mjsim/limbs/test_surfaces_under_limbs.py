"""Adhesive ground, ground that resists more at rest, and limbs that curl up, in MuJoCo."""

import math
from dataclasses import replace

import numpy as np
import pytest
from walks import went

from analytic import GAITS, SURFACES, Friction, Gait, Patches, Robot, Surface, predict
from analytic.scene import pneunet
from analytic.scene.limbs import Limb, LimbedRobot, as_strip, quadruped
from analytic.solvers.models import Elastica
from mjsim.model.pads import pads_of
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation, simulate

STRIP = Robot()
SOLO = LimbedRobot((Limb("solo", STRIP),))
STEP = 0.01
AREA = STRIP.width * STRIP.length


def places(ground, slope, friction="constant", steps=100):
    """Place of a limb without pressure after each step on a slope [m]."""
    simulation = Simulation(Scene(SOLO, GAITS["wave"], ground, slope=slope, friction=friction))
    at = []
    for _ in range(steps):
        simulation.step(np.zeros(3))
        at.append(simulation.data.qpos.item(0))
    return np.array(at), simulation.scene.gravity


@pytest.mark.parametrize("ratio", [1.0, 1.6])
def test_a_limb_breaks_away_at_static_ratio_times_its_bound_and_slides_against_the_bound(ratio):
    """W sin(slope) = ratio tau area; then m a = W sin(slope) - tau area."""
    ground = Surface("stiction", shear_strength=10.0, static_ratio=ratio, stribeck_speed=1e-4)
    bound = ground.shear_strength * AREA
    limit = math.asin(ratio * bound / STRIP.weight)
    at, _ = places(ground, 0.97 * limit)
    assert np.ptp(at[20:]) < 1e-5
    at, gravity = places(ground, 1.05 * limit)
    expected = gravity * (math.sin(1.05 * limit) - bound / STRIP.weight)
    deceleration = -float(np.diff(at, 2)[-30:].mean()) / STEP**2
    viscous = 0.005 * gravity * bound / STRIP.weight  # what decides between equal bounds, at most
    assert expected - 1.1 * viscous < deceleration < 1.01 * expected


def test_by_load_adhesion_holds_a_limb_as_weight_does():
    """W sin(slope) = mu (W cos(slope) + pull of adhesion)."""
    ground = Surface("sticky", friction=0.2, adhesion=1e-3)
    pull = ground.press(STRIP.width) * STRIP.length
    slopes = np.linspace(0.0, 1.0, 10001)
    held = STRIP.weight * np.sin(slopes) < 0.2 * (STRIP.weight * np.cos(slopes) + pull)
    limit = float(slopes[held].max())
    at, _ = places(ground, 0.96 * limit, "coulomb")
    assert np.ptp(at[20:]) < 1e-5
    at, _ = places(ground, 1.04 * limit, "coulomb")
    assert np.ptp(at[20:]) > 1e-3


def test_the_ground_pushes_as_much_as_weight_and_adhesion_pull():
    robot, ground = quadruped(), replace(SURFACES["felt"], adhesion=0.02)
    simulation = Simulation(Scene(robot, ground=ground))
    for _ in range(20):
        simulation.step(np.zeros(5))
    rows = simulation.data.contact.efc_address
    push = simulation.data.efc_force[rows[rows >= 0]].sum()
    pull = sum(ground.press(limb.strip.width) * limb.strip.length for limb in robot.limbs)
    assert push == pytest.approx(robot.weight + pull, rel=1e-3)


@pytest.mark.parametrize(
    "ground",
    [
        pytest.param(replace(SURFACES["felt"], adhesion=0.05), id="sticky felt"),
        pytest.param(
            Patches("two", (0.5 * STRIP.length,), (
                Surface("stronger", tip_force=0.030, shear_strength=8.0),
                Surface("at rest", tip_force=0.025, shear_strength=8.0, static_ratio=1.5,
                        stribeck_speed=1e-2),
            )), id="stronger at rest on the right", marks=pytest.mark.slow),
    ],
)  # fmt: skip
def test_a_strip_as_a_tree_goes_as_far_as_the_strip_s_elastica(ground):
    gait = replace(GAITS["wave"], ramp_time=8.0)
    stages = tuple(map(tuple, np.array(gait.stages)[:, [1, 0, 2]].tolist()))
    friction = Friction(tension=1.0, contacts="all")
    theory = predict(STRIP, gait, ground, Elastica(18), 20, friction=friction)
    walk = simulate(
        Scene(as_strip(STRIP), Gait("wave", stages, 8.0), ground), Numerics(timestep=STEP)
    )
    assert went(walk)[0] == pytest.approx(theory.locomotion.per_cycle, rel=0.03)


def test_an_end_that_curls_up_rises_as_a_beam_does():
    """By D kappa^2 / 2 w, see test_curling_up."""
    strip, kappa = replace(STRIP, segments=(1.0,)), 2.0
    part = -kappa / (pneunet.curvature_per_pressure(strip) * strip.peak_pressure)
    gait = Gait("up", ((0.0,), (part,), (0.0,)), 2.0)
    simulation = Simulation(Scene(LimbedRobot((Limb("solo", strip),)), gait), Numerics(links=24))
    for i in range(300):
        simulation.step(np.array([part * strip.peak_pressure * min(1.0, i / 100)]))
    nodes = simulation.data.geom_xpos[pads_of(simulation.model, simulation.scene)[0, [0, -1], 0], 2]
    lying = simulation.numerics.pad_radius
    rise = float(pneunet.rigidity(strip, part * strip.peak_pressure)) * kappa**2
    rise /= 2 * strip.weight_per_length
    assert nodes - lying == pytest.approx(rise, rel=0.06)  # it lies 0.02 mm deep


@pytest.mark.parametrize("ground", ["polyethylene",
                                    pytest.param("gelatin", marks=pytest.mark.slow)])  # fmt: skip
def test_a_strip_that_curls_up_as_a_tree_goes_as_far_as_the_strip_s_elastica(ground):
    stages = np.array([[0, 0, 0], [0.6, 0, 0], [0.6, -0.3, 0], [0, -0.3, 0.6], [0, 0, 0.6],
                       [0, 0, 0]])  # fmt: skip
    one, tree = (Gait("both-ways", tuple(map(tuple, rows.tolist())), 8.0)
                 for rows in (stages, stages[:, [1, 0, 2]]))  # fmt: skip
    friction = Friction(tension=1.0, contacts="all")
    theory = predict(STRIP, one, SURFACES[ground], Elastica(18), 20, friction=friction)
    walk = simulate(Scene(as_strip(STRIP), tree, SURFACES[ground]), Numerics(timestep=STEP))
    expected = theory.locomotion.per_cycle
    assert went(walk)[0] == pytest.approx(expected, rel=0.04)
