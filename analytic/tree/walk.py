"""The path of a tree of limbs: quasi-static shapes, and least dissipation in the plane.

In each increment the contacts of both of its states are asked, and the mean is taken, so that the
reversed sequence goes back the same way.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from analytic.gait import Gait
from analytic.plane import least_dissipation_in_plane
from analytic.surface import Surface
from analytic.tree.contacts import Contact, Contacts
from analytic.tree.kinematics import Tree
from analytic.tree.limbs import TreeRobot
from analytic.tree.statics import Rest, Statics

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Path:
    """Where a tree went.

    Attributes:
        pressures: of the limbs, (B, L) [Pa].
        rests: its shapes.
        contacts: of each state.
        place: of the trunk's beginning, (B, 2) [m].
        heading: of the trunk, to the left, (B,) [rad].
        converged: whether all shapes are equilibria.
    """

    pressures: Array
    rests: list[Rest]
    contacts: list[list[Contact]]
    place: Array
    heading: Array
    converged: bool

    @property
    def displacement(self) -> Array:
        """Of the trunk's beginning in all, (2,) [m]."""
        return np.asarray(self.place[-1] - self.place[0])

    @property
    def turn(self) -> float:
        """Of the trunk in all, to the left [rad]."""
        return float(self.heading[-1] - self.heading[0])


def shapes(robot: TreeRobot, pressures: Array, elements: int) -> tuple[Tree, list[Rest]]:
    """Equilibria along a path of pressures that begins near none.

    Args:
        robot: its limbs.
        pressures: of them, (B, L) [Pa].
        elements: hinges of each limb, even.
    """
    tree = Tree(robot, elements)
    statics = Statics(tree)
    rest, found = statics.flat(), []
    for row in pressures:
        rest = statics.equilibrium(row, rest)
        found.append(rest)
    return tree, found


def follow(tree: Tree, rests: list[Rest], pressures: Array, surface: Surface) -> Path:
    """The path along shapes on a ground."""
    finder = Contacts(tree, surface)
    contacts = [finder.find(rest, row) for rest, row in zip(rests, pressures, strict=True)]
    place, heading = np.zeros((len(rests), 2)), np.zeros(len(rests))
    for i, (one, two) in enumerate(pairwise(rests)):
        shift, turn = np.zeros(2), 0.0
        for own in (contacts[i], contacts[i + 1]):
            bounds, before = finder.places(one, own)
            if not len(bounds):
                continue
            _, after = finder.places(two, own)
            motion = least_dissipation_in_plane(bounds, before, after - before)
            shift += 0.5 * motion.shift
            turn += 0.5 * motion.turn
        c, s = np.cos(heading[i]), np.sin(heading[i])
        place[i + 1] = place[i] + np.array([c * shift[0] - s * shift[1],
                                            s * shift[0] + c * shift[1]])  # fmt: skip
        heading[i + 1] = heading[i] + turn
    converged = all(rest.converged for rest in rests)
    return Path(pressures, rests, contacts, place, heading, converged)


def walk(
    robot: TreeRobot, gait: Gait, surface: Surface, states: int = 40, elements: int = 6,
    cycles: int = 1,
) -> Path:  # fmt: skip
    """Walk a gait quasi-statically, where friction bends nothing.

    Args:
        robot: its limbs.
        gait: fractions of the robot's peak pressure, one a limb, in their order.
        surface: under it.
        states: of a change by the peak pressure.
        elements: hinges of each limb, even.
        cycles: how many.

    Raises:
        ValueError: the gait is not for so many limbs.
    """
    if gait.segments != len(robot.limbs):
        raise ValueError(
            f"gait {gait.name!r} is for {gait.segments} limbs, the robot has {len(robot.limbs)}"
        )
    pressures = robot.peak_pressure * gait.path(states, cycles)[0]
    tree, rests = shapes(robot, pressures, elements)
    return follow(tree, rests, pressures, surface)
