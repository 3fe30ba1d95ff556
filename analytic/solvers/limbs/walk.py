"""The path of a tree of limbs: quasi-static shapes, and least dissipation in the plane.

In each increment the contacts of both of its states are asked, and the mean is taken, so that the
reversed sequence goes back the same way.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from analytic.friction.dissipation_in_plane import least_dissipation_in_plane
from analytic.scene.gait import Gait
from analytic.scene.limbs import TreeRobot, rotation
from analytic.scene.surface import Ground
from analytic.solvers.limbs.contacts import Contacts, durations
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.path import Path
from analytic.solvers.limbs.statics import Rest, Statics
from analytic.solvers.limbs.stick_slip import stick_slip_path

Array = NDArray[np.float64]


def shapes(robot: TreeRobot, pressures: Array, elements: int) -> tuple[Tree, list[Rest]]:
    """Equilibria along a path of pressures that begins near none.

    Args:
        robot: its limbs.
        pressures: of them, (B, L) [Pa].
        elements: hinges of each limb, even.
    """
    tree = Tree(robot, elements)
    statics = Statics(tree)
    rest, rests = statics.flat(), []
    for row in pressures:
        rest = statics.equilibrium(row, rest)
        rests.append(rest)
    return tree, rests


def follow(
    tree: Tree,
    rests: list[Rest],
    pressures: Array,
    ground: Ground,
    law: str = "constant",
    times: Array | None = None,
) -> Path:
    """The path along shapes on a ground.

    Args:
        tree, rests, pressures: what `shapes` gave, for pressures (B, L) [Pa].
        ground: what resists, by the place along x.
        law: of friction, a name of analytic.friction.laws.LAWS.
        times: of the shapes, (B,) [s], which viscous ground asks for.

    Raises:
        ValueError: see analytic.solvers.limbs.contacts.durations.
    """
    spans = durations(ground, times, len(rests))
    finder = Contacts(tree, law)
    contacts = [finder.find(rest, row) for rest, row in zip(rests, pressures, strict=True)]
    place, heading = np.zeros((len(rests), 2)), np.zeros(len(rests))
    for i, (begin, end) in enumerate(pairwise(rests)):
        shift, turn = np.zeros(2), 0.0
        turned = rotation(heading[i])
        for state in (contacts[i], contacts[i + 1]):
            if not state:
                continue
            weights = finder.weights(state)
            before, after = weights @ begin.nodes[:, :2], weights @ end.nodes[:, :2]
            bounds, viscous = finder.resistances(state, ground, place[i, 0] + before @ turned[0])
            motion = least_dissipation_in_plane(bounds, before, after - before, viscous / spans[i])
            shift += 0.5 * motion.shift
            turn += 0.5 * motion.turn
        place[i + 1] = place[i] + turned @ shift
        heading[i + 1] = heading[i] + turn
    return Path(pressures, rests, contacts, place, heading)


def walk(
    robot: TreeRobot, gait: Gait, ground: Ground, states: int = 40, elements: int = 6,
    cycles: int = 1, law: str = "constant", bent: bool = True,
) -> Path:  # fmt: skip
    """Walk a gait quasi-statically.

    Args:
        robot: its limbs.
        gait: fractions of the robot's peak pressure, one per limb, in their order.
        ground: under it.
        states: of a change by the peak pressure.
        elements: hinges of each limb, even.
        cycles: how many.
        law: of friction, a name of analytic.friction.laws.LAWS.
        bent: whether friction bends the robot; else it only decides which contacts slide, as in
            the limit of weak friction.

    Raises:
        ValueError: the gait is not for so many limbs.
    """
    if gait.segments != len(robot.limbs):
        raise ValueError(
            f"gait {gait.name!r} is for {gait.segments} limbs, the robot has {len(robot.limbs)}"
        )
    fractions, times = gait.path(states, cycles)
    pressures = robot.peak_pressure * fractions
    if bent:
        return stick_slip_path(Statics(Tree(robot, elements)), pressures, ground, law, times)
    tree, rests = shapes(robot, pressures, elements)
    return follow(tree, rests, pressures, ground, law, times)
