"""How far a robot of limbs goes and turns, and how sure that is."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.gait import Gait
from analytic.scene.limbs import TreeRobot, rotation
from analytic.scene.surface import Ground
from analytic.solvers.limbs.path import Path
from analytic.solvers.limbs.walk import walk

Array = NDArray[np.float64]


class TreePrediction(NamedTuple):
    """A walk by the quasi-static reference.

    Attributes:
        displacement: of the trunk's beginning in all, ahead and to the left of the trunk's first
            direction, (2,) [m].
        turn: of the trunk to the left [rad].
        displacement_error, turn_error: what half the states and two hinges less change [m, rad].
        path: the walk itself.
    """

    displacement: Array
    turn: float
    displacement_error: float
    turn_error: float
    path: Path


def predict(
    robot: TreeRobot, gait: Gait, ground: Ground, states: int = 20, elements: int = 6,
    cycles: int = 1, law: str = "constant",
) -> TreePrediction:  # fmt: skip
    """A walk on ground that bends the robot, beside one by half the states and two hinges less.

    Args:
        states: of a change by the peak pressure.
        robot, gait, ground, elements, cycles, law: see analytic.solvers.limbs.walk.walk.

    Raises:
        ValueError: see analytic.solvers.limbs.walk.walk.
    """
    coarse, fine = (
        walk(robot, gait, ground, count, links, cycles, law)
        for count, links in ((states // 2, max(2, elements - 2)), (states, elements))
    )
    change = float(np.hypot(*(fine.displacement - coarse.displacement)))
    ahead = fine.displacement @ rotation(robot.limbs[0].angle)
    return TreePrediction(ahead, fine.turn, change, abs(fine.turn - coarse.turn), fine)
