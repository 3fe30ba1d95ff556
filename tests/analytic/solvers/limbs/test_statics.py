"""Trees of limbs: kinematics with exact derivatives, statics that balance, the strip as a tree."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic.locomotion import WEAK
from analytic.scene.gait import GAITS
from analytic.scene.limbs import MASS, Limb, LimbedRobot, as_strip, quadruped
from analytic.scene.pneunet import torsional_rigidity
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from analytic.solvers.limbs.kinematics import WHOLE, Tree
from analytic.solvers.limbs.statics import Statics
from analytic.solvers.models import Elastica

QUADRUPED = quadruped()


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_derivatives_of_places_are_those_of_finite_differences(seed):
    rng = np.random.default_rng(seed)
    tree = Tree(QUADRUPED, 2, seed % 2)
    q = rng.normal(0, 0.4, len(tree.parent))
    force, h = rng.standard_normal((len(tree.weight), 3)), 1e-6
    pose = tree.pose(q)
    moves, bending = tree.moves(pose), tree.bending(pose, force)
    assert tree.heights(pose) == pytest.approx(moves[:, 2])
    for k, e in enumerate(np.eye(len(q))):
        up, down = tree.pose(q + h * e), tree.pose(q - h * e)
        slope = (up.nodes - down.nodes) / (2 * h)
        assert slope == pytest.approx(moves[..., k], abs=1e-8)
        curve = np.einsum("pi,piq->q", force, tree.moves(up) - tree.moves(down)) / (2 * h)
        assert curve == pytest.approx(bending[k], abs=1e-6)


def test_links_keep_their_lengths_and_limbs_hang_together_in_any_pose():
    tree = Tree(QUADRUPED, 4)
    rng = np.random.default_rng(1)
    flat, bent = (tree.pose(q).nodes for q in (np.zeros(len(tree.parent)),
                                               rng.normal(0, 0.5, len(tree.parent))))  # fmt: skip
    half = len(flat) // 2
    for nodes in (flat[:half], flat[half:]):
        assert nodes.shape == (half, 3)
    for start in range(0, half, 6):
        for edge in (0, half):
            one, two = (np.linalg.norm(np.diff(n[edge + start : edge + start + 6], axis=0), axis=1)
                        for n in (flat, bent))  # fmt: skip
            assert one == pytest.approx(two, rel=1e-12)


def test_a_turned_and_shifted_robot_is_the_same_robot_elsewhere():
    tree, rng = Tree(QUADRUPED, 4, 2), np.random.default_rng(2)
    q = rng.normal(0, 0.4, len(tree.parent))
    moved, (shift, turn) = q.copy(), ([0.3, -0.2, 0.1], 0.7)
    moved[:3] += shift
    moved[3] += turn
    c, s = np.cos(turn), np.sin(turn)
    around = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    nodes = (tree.pose(q).nodes - q[:3]) @ around.T + q[:3] + shift
    assert tree.pose(moved).nodes == pytest.approx(nodes, abs=1e-12)


@pytest.mark.parametrize(("elements", "twists"), [(2, 1), (4, 1), (6, 2), (6, 3), (8, 4)])
def test_a_limb_twisted_by_a_torque_turns_by_the_length_over_gj(elements, twists):
    leg = replace(QUADRUPED.limbs[1].strip, torsion=2e-4)
    robot = LimbedRobot((Limb("leg", leg, angle=0.5),))
    tree, torque = Tree(robot, elements, twists), 1e-4
    stiffness, rest = Statics(tree).springs(np.zeros(1))
    assert not rest.any()
    q = np.zeros(len(tree.parent))
    q[WHOLE + tree.twist_places] = torque / stiffness[tree.twist_places]
    nodes = tree.pose(q).nodes
    right, left = nodes[: elements + 2], nodes[elements + 2 :]
    rise = np.arcsin((left - right)[:, 2] / leg.width)
    assert rise[-1] == pytest.approx(torque * leg.length / 2e-4)
    assert rise[0] == 0.0
    assert (rise[1:-1] + rise[-2:0:-1]) == pytest.approx(rise[-1])  # alike from both ends
    assert 0.5 * (left + right)[:, 2] == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize(("ratio", "factor"), [(1, 0.1406), (2, 0.229), (5, 0.291), (10, 0.312)])
def test_the_torsion_constant_is_that_of_the_tables(ratio, factor):
    # J = factor b a^3: Timoshenko and Goodier, Theory of Elasticity, 109, table of k1
    strip = Robot(thickness=4e-3, width=ratio * 4e-3, modulus=3.0)
    constant = factor * strip.width * strip.thickness**3
    assert torsional_rigidity(strip) == pytest.approx(constant, rel=2e-3)
    tall = replace(strip, width=4e-3, thickness=ratio * 4e-3)
    assert torsional_rigidity(tall) == pytest.approx(torsional_rigidity(strip))


def test_limbs_that_hardly_twist_rest_as_those_that_do_not():
    stiff = LimbedRobot(
        tuple(
            replace(limb, strip=replace(limb.strip, torsion=1e6 * torsional_rigidity(limb.strip)))
            for limb in QUADRUPED.limbs
        ),
        QUADRUPED.peak_pressure,
    )
    pressures, nodes = QUADRUPED.peak_pressure * np.array([0.5, 1.0, 0.9, 0.0, 0.3]), []
    for robot, twists in ((QUADRUPED, 0), (stiff, 1), (QUADRUPED, 1)):
        statics = Statics(Tree(robot, 2, twists))
        rest = statics.flat()
        for part in np.linspace(0.2, 1.0, 5):
            rest = statics.equilibrium(part * pressures, rest)
        assert rest.converged
        nodes.append(rest.nodes)
    plain, hardly, twisted = nodes
    assert hardly == pytest.approx(plain, abs=1e-7)
    assert np.abs(twisted - plain).max() > 1e-4


def test_the_paper_robot_weighs_what_its_mesh_does_and_is_as_long():
    nodes = Tree(QUADRUPED, 4).pose(np.zeros(WHOLE + 20)).nodes
    assert QUADRUPED.weight == pytest.approx(MASS * 9.81)
    middle = 0.5 * (nodes[: len(nodes) // 2] + nodes[len(nodes) // 2 :])
    assert np.ptp(middle[:, 0]) == pytest.approx(0.1357)
    assert nodes[:, 2] == pytest.approx(0.0)


def test_a_strip_as_a_tree_has_the_shapes_and_forces_of_the_elastica():
    robot = Robot()
    pressures = robot.peak_pressure * GAITS["wave"].pressures(2)
    exact = Elastica(18).solve(robot, pressures, SURFACES["felt"], WEAK, None)
    statics = Statics(Tree(as_strip(robot), 6))
    rest, vertices = statics.flat(), 8
    for row, separation, force in zip(pressures, exact.separation, exact.force, strict=True):
        rest = statics.equilibrium(row[[1, 0, 2]], rest)
        assert rest.converged
        ends = [rest.nodes[limb * vertices + vertices - 1, 0] for limb in (1, 2)]
        assert ends[1] - ends[0] == pytest.approx(separation, abs=1e-8 * robot.length)
        both = rest.force[: 3 * vertices] + rest.force[3 * vertices :]
        assert both.sum() == pytest.approx(force.sum(), rel=1e-6)
        if row.any():  # lying flat it is open which of two nodes at one place is pushed
            assert both[[2 * vertices - 1, 3 * vertices - 1]] == pytest.approx(
                force[[0, -1]], abs=1e-5 * robot.weight
            )


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_the_ground_carries_the_weight_where_it_hangs(seed):
    rng = np.random.default_rng(seed)
    statics = Statics(Tree(QUADRUPED, 2))
    target = QUADRUPED.peak_pressure * rng.random(5) * (rng.random(5) > 0.3)
    rest = statics.flat()
    for part in np.linspace(0.1, 1.0, 10):
        rest = statics.equilibrium(part * target, rest)
    assert rest.converged
    weight = statics.tree.weight
    assert rest.force.min() >= 0
    assert rest.force.sum() == pytest.approx(QUADRUPED.weight, rel=1e-7)
    assert rest.force @ rest.nodes[:, 2] == pytest.approx(0, abs=1e-9 * QUADRUPED.weight)
    assert rest.nodes[:, 2].min() > -1e-9
    for axis in (0, 1):
        assert rest.force @ rest.nodes[:, axis] == pytest.approx(
            weight @ rest.nodes[:, axis], abs=1e-7 * QUADRUPED.weight
        )


@pytest.mark.parametrize("twists", [0, 1])
def test_left_and_right_swapped_the_rest_is_mirrored(twists):
    statics = Statics(Tree(QUADRUPED, 2, twists))
    rests = []
    for order in ([0, 1, 2, 3, 4], [0, 2, 1, 4, 3]):
        rest = statics.flat()
        for part in np.linspace(0.2, 1.0, 5):
            given_ = np.array([0.3, 1.0, 0.6, 0.0, 0.9])[order]
            rest = statics.equilibrium(part * QUADRUPED.peak_pressure * given_, rest)
        rests.append(rest)
    one, two = rests
    assert two.q[5] == pytest.approx(-one.q[5], abs=1e-9)  # roll
    assert two.q[4] == pytest.approx(one.q[4], abs=1e-9)  # pitch
    assert abs(one.q[5]) > 1e-4


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: Limb("leg", Robot(segments=(1.0,)), at="middle"), "at must be one of begin, end"),
        (lambda: Limb("leg", Robot(segments=(1.0,)), angle=float("nan")), "angle must be a finite"),
        (lambda: LimbedRobot(()), "one limb at least"),
        (lambda: LimbedRobot((Limb("a", Robot(segments=(1.0,)), "b"),)), "is the trunk"),
        (lambda: LimbedRobot((*QUADRUPED.limbs, QUADRUPED.limbs[1])), "is there twice"),
        (lambda: LimbedRobot((QUADRUPED.limbs[0], replace(QUADRUPED.limbs[1], on="tail"))),
         "on must be one of torso"),
        (lambda: Tree(QUADRUPED, 3), "elements must be even"),
        (lambda: Tree(QUADRUPED, 4, 3), "twists must be a whole number from 0 to 2, got 3"),
    ],
)  # fmt: skip
def test_what_is_no_tree_is_refused(build, words):
    with pytest.raises(ValueError, match=words):
        build()
