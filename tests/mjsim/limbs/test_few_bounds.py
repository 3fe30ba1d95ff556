"""Robots of limbs where few contacts resist, or none, and where the trunk points elsewhere."""

from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest
from walks import turned, went

from analytic import Elastica, Friction, predict
from analytic.scene.actuator import Actuator
from analytic.scene.gait import GAITS, Gait
from analytic.scene.limbs import (
    LENGTH,
    Limb,
    LimbedRobot,
    as_strip,
    outline,
    quadruped,
    rotation,
)
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES, Surface
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.walk import walk as quasi_static
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation, simulate

FELT, NUMERICS = SURFACES["felt"], Numerics(timestep=0.04, links=4)
# on felt only flat sides resist: the middle one alone, then none
OUTER_FIRST = ["000", "100", "101", "001", "000"]
WAVE = np.array(GAITS["wave"].stages)[:, [1, 0, 2]]
STAGES = np.array([[float(digit) for digit in stage] for stage in OUTER_FIRST])


def laid_down(robot, angle):
    return replace(
        robot, limbs=tuple(replace(limb, angle=limb.angle + angle) for limb in robot.limbs)
    )


@pytest.mark.parametrize(
    ("weight", "timestep", "ramp"),
    [
        (4.0, 0.02, 8.0),
        *(pytest.param(w, 0.01, t, marks=pytest.mark.slow)
          for w in (4.0, 8.0) for t in (2.0, 8.0, 32.0)),
    ],
)  # fmt: skip
def test_an_underside_between_two_tips_resists_by_nothing_and_the_strip_s_distance_results(
    weight, timestep, ramp
):
    strip = Robot(weight_per_length=weight)
    gait = Gait("outer-first", tuple(map(tuple, STAGES)), ramp)
    friction = Friction(tension=1.0, contacts="all")
    theory = predict(strip, gait, FELT, Elastica(40), friction=friction)
    limbs = Gait("outer-first", tuple(map(tuple, STAGES[:, [1, 0, 2]])), ramp)
    walk = simulate(Scene(as_strip(strip), limbs, FELT), Numerics(timestep=timestep))
    expected = theory.locomotion.per_cycle
    assert went(walk)[0] == pytest.approx(expected, rel=0.01, abs=3e-4 * strip.length)


@pytest.mark.slow
def test_a_light_strip_as_a_tree_loses_what_lies_flat_within_two_elements_behind_a_tip():
    """A strip's finder takes it for a side from the second node on; see docs/limbs.md."""
    strip = Robot(weight_per_length=2.0)
    gaits = [Gait("outer-first", tuple(map(tuple, stages)), 8.0)
             for stages in (STAGES, STAGES[:, [1, 0, 2]])]  # fmt: skip
    theory = predict(strip, gaits[0], FELT, Elastica(80),
                     friction=Friction(tension=1.0, contacts="all"))  # fmt: skip
    scene = Scene(as_strip(strip), gaits[1], FELT)
    expected = theory.locomotion.per_cycle
    coarse, fine = (
        went(simulate(scene, Numerics(timestep=0.01, links=links)))[0] for links in (6, 24)
    )
    assert coarse == pytest.approx(expected, rel=0.04)
    assert fine == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("ground", ["felt", "gelatin"])
def test_a_billionth_of_a_length_changes_nothing(ground):
    """A tip stands at no distance from its end, whatever the lengths of its links add up to."""
    gait = Gait("wave", tuple(map(tuple, WAVE)), 4.0)
    ways = []
    for length in (0.13, 0.13 - 1e-9, 0.125, 0.125 + 1e-9):
        scene = Scene(as_strip(Robot(length=length)), gait, SURFACES[ground])
        ways.append(float(went(simulate(scene))[0]) / length)
    assert ways[1] == pytest.approx(ways[0], abs=1e-4)
    assert ways[3] == pytest.approx(ways[2], abs=1e-4)
    assert ways[2] == pytest.approx(ways[0], rel=0.2)  # a shorter strip bends less


def test_the_last_vertex_of_a_limb_is_at_its_length_to_the_last_digit():
    for length in (0.043333333, 0.125 / 3, 0.14 / 3, 0.1):
        for elements in (2, 6, 8, 16):
            robot = as_strip(Robot(length=3 * length))
            tree = Tree(robot, elements)
            ends = tree.arclength.reshape(2, len(robot.limbs), -1)[:, :, -1]
            assert (ends == [limb.strip.length for limb in robot.limbs]).all()


@pytest.mark.slow
@pytest.mark.parametrize("ramp", [2.0, 30.0])
def test_on_a_film_alone_the_reference_does_not_know_how_slow_the_gait_is(ramp):
    film = Surface("film", viscosity=100.0)
    gait = replace(undulation(), ramp_time=ramp)
    theory = quasi_static(quadruped(), gait, film, 8, 4)
    felt = quasi_static(quadruped(), undulation(), FELT, 8, 4)  # where tips hold nothing either
    assert theory.displacement[0] == pytest.approx(felt.displacement[0], rel=0.02)


def test_a_heavy_torso_between_four_tips_goes_as_far_as_the_reference():
    torso, *legs = quadruped().limbs
    heavy = replace(torso, strip=replace(torso.strip, weight_per_length=21.69))
    robot = LimbedRobot((heavy, *legs))
    stages = np.array([[0, 0, 0, 0, 0], [0, 1, 1, 0, 0], [0, 1, 1, 1, 1], [0, 0, 0, 1, 1], [0] * 5])
    gait = Gait("legs", tuple(map(tuple, stages.astype(float))), 8.0)
    theory = quasi_static(robot, gait, FELT, 8, 4)
    walk = simulate(Scene(robot, gait, FELT), Numerics(timestep=0.02, links=4))
    assert went(walk)[0] == pytest.approx(theory.displacement[0], abs=5e-4 * LENGTH)


@pytest.mark.parametrize(
    ("viscosity", "states"),
    [(1e3, 8), *(pytest.param(v, 20, marks=pytest.mark.slow) for v in (1e2, 1e3, 1e4))],
)
def test_on_a_film_alone_a_robot_of_little_mass_goes_as_far_as_the_reference(viscosity, states):
    film = Surface("film", viscosity=viscosity)
    theory = quasi_static(quadruped(), undulation(), film, states, 4)
    light = Scene(quadruped(), ground=film, gravity=98.1)  # its mass is a tenth
    walk = simulate(light, Numerics(links=4))
    assert went(walk)[0] == pytest.approx(theory.displacement[0], rel=0.06)


@pytest.mark.parametrize("angle", [0.5 * np.pi, pytest.param(-2.0, marks=pytest.mark.slow)])
def test_a_robot_laid_down_in_another_direction_goes_and_turns_alike(angle):
    gait = replace(undulation("wave", left=0.7), ramp_time=4.0)
    ground = SURFACES["gelatin"]
    robots = quadruped(), laid_down(quadruped(), angle)
    assert outline(robots[1]) == pytest.approx(outline(robots[0]), rel=1e-12)
    one, two = (simulate(Scene(robot, gait, ground), NUMERICS) for robot in robots)
    assert went(two) == pytest.approx(went(one), abs=1e-3 * LENGTH)
    assert turned(two) == pytest.approx(turned(one), abs=np.radians(0.05))
    one, two = (quasi_static(robot, gait, ground, 4, 2, bent=False) for robot in robots)
    assert two.displacement @ rotation(angle) == pytest.approx(one.displacement, abs=1e-5 * LENGTH)
    assert two.turn == pytest.approx(one.turn, abs=1e-5)


@pytest.mark.slow
def test_the_reference_of_a_robot_laid_down_in_another_direction_is_the_same():
    gait, ground = undulation("wave", left=0.7), SURFACES["gelatin"]
    robots = quadruped(), laid_down(quadruped(), 2)
    one, two = (quasi_static(robot, gait, ground, 8, 4).by_cycle(1) for robot in robots)
    assert two[0] == pytest.approx(one[0], abs=1e-4 * LENGTH)
    assert two[1] == pytest.approx(one[1], abs=np.radians(0.02))


def test_one_long_limb_arches_and_comes_back_to_where_it_lay():
    strip = Robot(segments=(1.0,), mass=0.018)
    gait = Gait("arch", ((0.0,), (1.0,), (0.0,)), 4.0)
    scene = Scene(LimbedRobot((Limb("solo", strip),)), gait, FELT)
    steps = [simulate(scene, Numerics(timestep=dt)) for dt in (0.01, 0.005)]
    assert all(walk.status is Status.OK for walk in steps)
    highest = max(walk.coordinates[:, 4].max() for walk in steps)
    assert highest > 1.0  # rad: its beginning stands steeply, and it has not fallen over
    # by its symmetry it goes nowhere, up to the order of the step
    one, two = (abs(went(walk)[0]) / strip.length for walk in steps)
    assert one < 2e-3
    assert two < 0.6 * one


def test_a_limb_that_would_close_into_a_circle_is_refused_as_a_strip_is():
    strip = Robot(segments=(1.0,), mass=0.018, peak_pressure=90e3)
    gait = Gait("arch", ((0.0,), (1.0,), (0.0,)), 4.0)
    with pytest.raises(ValueError, match="below 85920") as strip_s:
        Scene(strip, gait)
    with pytest.raises(ValueError, match="close limb 'solo' into a circle") as limb_s:
        Scene(LimbedRobot((Limb("solo", strip),), 90e3), gait, FELT)
    assert str(limb_s.value).replace("limb 'solo'", "this strip") == str(strip_s.value)


def test_a_strip_closes_by_the_segments_that_bend_alone():
    """A hinge of a twentieth of 0.13 m; 90 degrees of it are no circle, 360 are."""
    gait = Gait("fold", ((0, 0, 0), (1, 1, 1), (0, 0, 0)), 4.0)
    stiff = Actuator((0, 90e3), (0, 0))
    for turn in (0.5 * np.pi, 2 * np.pi):
        hinge = Actuator((0, 90e3), (0, turn / (0.13 / 20)))
        strip = Robot(segments=(9.5, 1, 9.5), actuator=(stiff, hinge, stiff), mass=0.018,
                      peak_pressure=90e3)  # fmt: skip
        with pytest.raises(ValueError, match="into a circle") if turn > 6 else nullcontext():
            Scene(strip, gait)


@pytest.mark.parametrize("about", [4, 5])  # pitch, roll
def test_a_robot_whose_trunk_stands_on_its_end_or_on_its_side_has_toppled(about):
    simulation = Simulation(Scene(quadruped()), replace(NUMERICS, timestep=1e-3))
    for angle, status in ((0.8, Status.OK), (1.2, Status.TOPPLED)):
        simulation.reset()
        q = np.zeros(len(simulation.data.qpos))
        q[about] = angle
        simulation.data.qpos[about] = angle
        simulation.data.qpos[2] = -Tree(quadruped(), 4).pose(q).nodes[:, 2].min()
        assert simulation.step(np.zeros(5)).status is status
