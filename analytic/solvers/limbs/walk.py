"""The path of a tree of limbs: quasi-static shapes, and least dissipation in the plane.

In each increment the contacts of both of its states are asked, and the mean is taken, so that the
reversed sequence goes back the same way.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from analytic.friction.dissipation_in_plane import least_dissipation_in_plane
from analytic.scene.gait import Gait
from analytic.scene.ground import check_for_limbs, surfaces_of
from analytic.scene.limbs import LimbedRobot, rotation
from analytic.scene.surface import Ground
from analytic.solvers.limbs.contacts import Contact, Contacts
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.path import Path
from analytic.solvers.limbs.statics import Rest, Statics
from analytic.solvers.limbs.stick_slip import drag_along

Array = NDArray[np.float64]


def shapes(
    robot: LimbedRobot, pressures: Array, elements: int, chamber: str = "linearized"
) -> tuple[Tree, list[Rest]]:
    """Equilibria along a path of pressures that begins near none.

    Args:
        robot: its limbs.
        pressures: of its chambers, (B, S) [Pa].
        elements: hinges of each limb, even.
        chamber: law of the chambers, see analytic.scene.chain.
    """
    statics = Statics(Tree(robot, elements), chamber)
    rest, rests = statics.flat(), []
    for row in pressures:
        rest = statics.equilibrium(row, rest)
        rests.append(rest)
    return statics.tree, rests


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
        tree, rests, pressures: what `shapes` gave for pressures of the chambers, (B, S) [Pa].
        ground: what resists, by the place along x.
        law: of friction, a name of analytic.friction.laws.LAWS.
        times: of the shapes, (B,) [s], which viscous ground asks for.

    Raises:
        ValueError: the ground resists by speed in a way that is not viscous, or sticks, or is
            viscous and no times are given.
    """
    check_for_limbs(ground)
    viscous = any(surface.viscosity for surface in surfaces_of(ground))
    if viscous and times is None:
        raise ValueError(f"times of the shapes must be given on viscous ground {ground.name!r}")
    spans = np.diff(times) if times is not None else np.ones(len(rests) - 1)
    finder = Contacts(tree, law)
    contacts = [finder.find(rest, row) for rest, row in zip(rests, pressures, strict=True)]
    place, heading = np.zeros((len(rests), 2)), np.zeros(len(rests))
    for i, (one, two) in enumerate(pairwise(rests)):
        shift, turn = np.zeros(2), 0.0
        turned = rotation(heading[i])
        for own in (contacts[i], contacts[i + 1]):
            before, after = finder.places(one, own), finder.places(two, own)
            if not len(before):
                continue
            along = place[i, 0] + before @ turned[0]
            bounds, drag = _resistances(finder, own, ground, along)
            thick = drag / max(float(spans[i]), 1e-12) if viscous else None
            motion = least_dissipation_in_plane(bounds, before, after - before, thick)
            shift += 0.5 * motion.shift
            turn += 0.5 * motion.turn
        place[i + 1] = place[i] + turned @ shift
        heading[i + 1] = heading[i] + turn
    converged = all(rest.converged for rest in rests)
    when = np.arange(float(len(rests))) if times is None else times
    return Path(tree.robot, pressures, when, rests, contacts, place, heading, converged)


def _resistances(
    finder: Contacts, contacts: list[Contact], ground: Ground, along: Array
) -> tuple[Array, Array]:
    """Bounds [N] and viscous resistances [N s/m] of all points, which are at x (C,) [m]."""
    limbs = [contact for contact in contacts for _ in contact.at]
    pairs = [
        finder.resistance(contact, ground.at(float(x)))
        for contact, x in zip(limbs, along, strict=True)
    ]
    bounds, drag = np.array(pairs).T
    return bounds, drag


def walk(
    robot: LimbedRobot, gait: Gait, ground: Ground, states: int = 40, elements: int = 6,
    cycles: int = 1, law: str = "constant", bent: bool = True, chamber: str = "linearized",
    path: Array | None = None, times: Array | None = None,
) -> Path:  # fmt: skip
    """Walk a gait quasi-statically, or along a path of pressures.

    Args:
        robot: its limbs.
        gait: fractions of the robot's peak pressure, one a chamber, in their order.
        ground: under it.
        states: of a change by the peak pressure.
        elements: hinges of each limb, even.
        cycles: how many.
        law: of friction, a name of analytic.friction.laws.LAWS.
        bent: whether friction bends the robot; else it only decides who slides, as in the limit of
            weak friction.
        chamber: law of the chambers, see analytic.scene.chain.
        path, times: pressures in the chambers in place of the gait's, (B, S) [Pa], and when, (B,)
            [s].

    Raises:
        ValueError: the gait is not for so many chambers.
    """
    if gait.segments != len(robot.chambers):
        raise ValueError(
            f"gait {gait.name!r} is for {gait.segments} chambers, the robot has "
            f"{len(robot.chambers)}: {', '.join(robot.chambers)}"
        )
    if path is None:
        fractions, times = gait.path(states, cycles)
        path = robot.peak_pressure * fractions
    if bent:
        return drag_along(Statics(Tree(robot, elements), chamber), path, ground, law, times)
    tree, rests = shapes(robot, path, elements, chamber)
    return follow(tree, rests, path, ground, law, times)
