"""Robots of limbs: where their limbs lie, and what they may not be."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic import GAITS, SURFACES, Limb, LimbedRobot, Robot, predict, quadruped
from analytic.scene.limbs import plan
from analytic.solvers.limbs.kinematics import Tree

STRIP = Robot(length=0.05, width=0.02, segments=(1.0,))


@st.composite
def trees(draw):
    limbs = [Limb("trunk", STRIP, angle=draw(st.floats(-3, 3)))]
    for number in range(draw(st.integers(1, 5))):
        carrier = draw(st.sampled_from(limbs)).name
        limbs.append(
            Limb(
                f"limb-{number}", replace(STRIP, length=draw(st.floats(0.02, 0.1))), carrier,
                draw(st.sampled_from(["begin", "end"])), draw(st.floats(-3, 3)),
                draw(st.floats(-0.02, 0.02)),
            )
        )  # fmt: skip
    return LimbedRobot(tuple(limbs))


@given(trees())
@settings(max_examples=60, deadline=None)
def test_a_flat_robot_lies_where_its_plan_says(robot):
    """Limbs at the beginning of a limb that is offset itself, too."""
    tree = Tree(robot, 4)
    right, left = np.split(tree.pose(np.zeros(6 + 4 * len(robot.limbs))).nodes, 2)
    middle = 0.5 * (right + left)
    for limb, vertices in zip(robot.limbs, tree.vertices, strict=True):
        begin, end = plan(robot)[limb.name]
        assert middle[vertices][[0, -1], :2] == pytest.approx(np.array([begin, end]), abs=1e-12)


def limbs(**changes):
    third = Limb("c", **{"strip": STRIP, "on": "a", **changes})
    return Limb("a", STRIP), Limb("b", STRIP, "a"), third


@pytest.mark.parametrize(
    ("made", "message"),
    [
        (lambda: LimbedRobot((Limb("a", STRIP, offset=0.01),)), "no carrier to be offset from"),
        (lambda: LimbedRobot(limbs(), peak_pressure=-1.0), "peak_pressure"),
        (lambda: LimbedRobot(limbs(), peak_pressure=float("nan")), "peak_pressure"),
        (lambda: LimbedRobot((*limbs(strip=replace(STRIP, segments=(1.0, 1.0))),
                              Limb("c-1", STRIP, "a"))), "chamber 'c-1' is there twice"),
        (lambda: Limb("", STRIP), "name of a limb"),
        (lambda: Limb(5, STRIP), "name of a limb"),
        (lambda: predict(quadruped(), GAITS["wave"], SURFACES["felt"]), "is for strips"),
    ],
)  # fmt: skip
def test_what_a_robot_of_limbs_may_not_be_is_said_in_one_line(made, message):
    with pytest.raises(ValueError, match=message):
        made()
    assert hash(LimbedRobot(list(limbs()))) == hash(LimbedRobot(limbs()))
