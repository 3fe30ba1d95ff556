"""Paths of trees: the strip's, symmetric ones, turning ones, and back again."""

from dataclasses import replace

import numpy as np
import pytest

from analytic.friction.laws import Friction
from analytic.locomotion import displacements
from analytic.prediction import predict
from analytic.scene.gait import GAITS, Gait
from analytic.scene.limbs import LENGTH, Limb, LimbedRobot, as_strip, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES, Surface
from analytic.solvers.elastica import solve_elastica
from analytic.solvers.limbs.walk import follow, shapes, walk
from analytic.solvers.models import Elastica

QUADRUPED = quadruped()
GELATIN = SURFACES["gelatin"].tip_force
NAPPED = Surface("napped", tip_force={"ahead": GELATIN, "back": 1.5 * GELATIN, "across": GELATIN})


def by_limb(gait):
    """A strip's fractions in the order torso, rear, front."""
    return np.array(gait.path(16)[0])[:, [1, 0, 2]]


@pytest.mark.parametrize("name", ["wave", pytest.param("pulse", marks=pytest.mark.slow)])
def test_the_strip_as_a_tree_goes_as_far_as_the_strip(name):
    robot, gait = Robot(), GAITS[name]
    pressures = robot.peak_pressure * by_limb(gait)
    tree, rests = shapes(as_strip(robot), pressures, 6)
    for surface in (*SURFACES.values(), NAPPED):
        path = follow(tree, rests, pressures, surface)
        flat = solve_elastica(robot, robot.peak_pressure * gait.path(16)[0], 18)
        exact = displacements(flat, surface).per_cycle  # by the same states
        assert path.converged
        assert path.displacement[0] == pytest.approx(exact, abs=2e-5 * robot.length)
        assert path.displacement[1] == pytest.approx(0, abs=1e-12)
        assert path.turn == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(
    ("surface", "states", "elements", "within"),
    [(SURFACES["felt"], 16, 4, 0.01),
     pytest.param(SURFACES["gelatin"], 20, 6, 0.005, marks=pytest.mark.slow),
     pytest.param(NAPPED, 20, 6, 0.01, marks=pytest.mark.slow)],
)  # fmt: skip
def test_the_strip_as_a_tree_is_bent_by_friction_as_the_strip_is(surface, states, elements, within):
    robot, gait = Robot(), GAITS["wave"]
    stages = tuple(map(tuple, np.array(gait.stages)[:, [1, 0, 2]].tolist()))
    path = walk(as_strip(robot), Gait("wave", stages), surface, states, elements)
    exact = predict(robot, gait, surface, Elastica(18), 160, friction=Friction(tension=1.0))
    assert path.converged
    assert path.displacement[0] == pytest.approx(exact.locomotion.per_cycle, rel=within)


@pytest.mark.slow
def test_the_weaker_friction_is_the_less_it_bends():
    gait, gelatin = undulation("wave"), SURFACES["gelatin"]
    limit = walk(QUADRUPED, gait, gelatin, 96, 4, bent=False).displacement[0]
    weak, full = (
        abs(walk(QUADRUPED, gait, gelatin.scaled(part), 12, 4).displacement[0] - limit)
        for part in (0.03, 1.0)
    )
    assert full > 0.05 * abs(limit)
    assert weak < 0.25 * full


@pytest.fixture(scope="module")
def undulating():
    gait = undulation("wave")
    pressures = QUADRUPED.peak_pressure * gait.path(10)[0]
    return pressures, *shapes(QUADRUPED, pressures, 4)


@pytest.mark.parametrize("weight", [1.0, 3.0, 30.0])
@pytest.mark.parametrize("name", SURFACES)
def test_however_weak_the_bounds_it_goes_as_far_as_by_least_dissipation(name, weight):
    """Which is found by other code, and knows no viscosity but in the limit."""
    robot = quadruped()
    robot = replace(robot, limbs=tuple(_heavier(limb, weight) for limb in robot.limbs))
    ground, gait = SURFACES[name], undulation("wave")
    limit = walk(robot, gait, ground, states=10, bent=False).place[-1, 0]
    assert walk(robot, gait, ground.scaled(1e-5), states=10).place[-1, 0] == pytest.approx(
        limit, abs=3e-5 * LENGTH
    )


def _heavier(limb, factor):
    """A limb that weighs so many times as much."""
    weight = factor * limb.strip.weight_per_length
    return replace(limb, strip=replace(limb.strip, weight_per_length=weight))


@pytest.mark.parametrize("name", list(SURFACES))
def test_pairs_that_press_alike_do_not_turn_it(undulating, name):
    pressures, tree, rests = undulating
    path = follow(tree, rests, pressures, SURFACES[name])
    assert path.turn == pytest.approx(0, abs=1e-9)
    assert path.displacement[1] == pytest.approx(0, abs=1e-9 * LENGTH)


def test_it_walks_forward_on_felt_and_backward_on_gelatin(undulating):
    pressures, tree, rests = undulating
    far = {name: follow(tree, rests, pressures, surface).displacement[0] / LENGTH
           for name, surface in SURFACES.items()}  # fmt: skip
    assert far["felt"] > 0.005
    assert far["gelatin"] < -0.005
    assert far["gelatin"] < far["polyethylene"] < far["felt"]


def test_the_same_states_in_opposite_order_lead_back(undulating):
    pressures, tree, rests = undulating
    there = follow(tree, rests, pressures, SURFACES["felt"])
    back = follow(tree, rests[::-1], pressures[::-1], SURFACES["felt"])
    assert back.displacement[0] == pytest.approx(-there.displacement[0], rel=1e-3)


def test_one_side_pressed_less_turns_it_and_the_other_side_the_other_way():
    paths = [
        walk(QUADRUPED, undulation("wave", left, right), SURFACES["felt"], 8, 2, bent=False)
        for left, right in ((0.5, 1.0), (1.0, 0.5))
    ]
    one, two = paths
    assert abs(one.turn) > np.radians(0.2)
    assert two.turn == pytest.approx(-one.turn, abs=1e-6)
    assert two.displacement == pytest.approx(one.displacement * [1, -1], abs=1e-6 * LENGTH)


def test_gaits_for_other_robots_and_parts_out_of_range_are_refused():
    with pytest.raises(ValueError, match="is for 3 chambers, the robot has 5"):
        walk(QUADRUPED, GAITS["wave"], SURFACES["felt"])
    with pytest.raises(ValueError, match="left must be a part in"):
        undulation("wave", left=1.5)
    with pytest.raises(ValueError, match="must be of three segments"):
        undulation(undulation("wave"))


REST, LIFTED = (0, 0, 0, 0, 0), (0, 0.75, 0.72, 0, 0)
PULSE = Gait("pulse", (REST, (0, 0.69, 0.69, 0, 0), (0.69, 0, 0, 0, 0), (0, 0, 0, 0.8, 0.8), REST))
UNEVEN = Gait(
    "uneven",
    (REST, LIFTED, (0.86, *LIFTED[1:]), (0.86, 0, 0, 0.67, 0.63), (0, 0, 0, 0.67, 0.63), REST),
)


@pytest.mark.parametrize(("gait", "law"), [(PULSE, "constant"), (UNEVEN, "coulomb")])
@pytest.mark.slow
def test_limbs_under_part_of_the_pressure_go_alike_however_fine_their_links(gait, law):
    # legs that hardly lift and a belly that just touches: which contact bears what converges
    pressures = QUADRUPED.peak_pressure * np.array(gait.path(10)[0])
    far = []
    for elements in (6, 12):
        tree, rests = shapes(QUADRUPED, pressures, elements, twists=0)
        path = follow(tree, rests, pressures, SURFACES["gelatin"], law)
        far.append(path.displacement[0] / LENGTH)
    assert far[0] == pytest.approx(far[1], rel=0.05, abs=2e-4)


ELSEWHERE = [pytest.param("felt", marks=pytest.mark.slow),
             pytest.param("polyethylene", marks=pytest.mark.slow), "gelatin"]  # fmt: skip


@pytest.mark.parametrize("name", ELSEWHERE)
def test_a_limb_of_three_segments_in_space_goes_as_far_as_the_strip_s_elastica(name):
    strip, gait, ground = Robot(), GAITS["wave"], SURFACES[name]
    path = walk(LimbedRobot((Limb("solo", strip, angle=0.5),)), gait, ground, 20, 24)
    friction = Friction(tension=1.0, contacts="all")
    theory = predict(strip, gait, ground, Elastica(36), 20, friction=friction)
    ((ahead, aside),), (turn,) = path.by_cycle(1)
    assert ahead == pytest.approx(theory.locomotion.per_cycle, abs=3e-4 * strip.length)
    assert aside == pytest.approx(0.0, abs=1e-9)
    assert turn == pytest.approx(0.0, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["felt", "gelatin"])
def test_a_limb_that_lies_flat_between_its_ends_resists_there_as_the_strip_does(name):
    strip, ground = Robot(length=0.2, segments=(1.0,) * 5), SURFACES[name]
    words = ("00000", "10000", "11000", "11011", "00011", "00001", "00000")
    gait = Gait("dips", tuple(tuple(float(digit) for digit in word) for word in words))
    path = walk(LimbedRobot((Limb("solo", strip, angle=0.5),)), gait, ground, 10, 20)
    friction = Friction(tension=1.0, contacts="all")
    theory = predict(strip, gait, ground, Elastica(60), 20, friction=friction)
    ((ahead, _),), _ = path.by_cycle(1)
    # one point of friction in place of an area, and first order in the increments
    assert ahead == pytest.approx(theory.locomotion.per_cycle, rel=0.07)
