"""The path of a tree of limbs: quasi-static shapes, and least dissipation in the plane.

In each increment the contacts of both of its states are asked, and the mean is taken, so that the
reversed sequence goes back the same way.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from analytic.checks import one_of, times_of, whole
from analytic.friction.contact_length import flat_pressures
from analytic.friction.dissipation_in_plane import least_dissipation_in_plane
from analytic.friction.grip import check_feet_in_space
from analytic.friction.laws import LAWS
from analytic.progress import counted
from analytic.scene.gait import Gait
from analytic.scene.ground import LEVEL, Incline
from analytic.scene.limbs import LimbedRobot, acting_pressures, rotation, usual_twists
from analytic.scene.surface import Ground, Surface
from analytic.solvers.limbs.contacts import Contacts, shares, spans_of
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.path import Path
from analytic.solvers.limbs.rest import Rest
from analytic.solvers.limbs.statics import Statics
from analytic.solvers.limbs.stick_slip import stick_slip_path

Array = NDArray[np.float64]

_BESIDE, _APART = 1e-8, 1e-7  # parts of an increment


def shapes(
    robot: LimbedRobot,
    pressures: Array,
    elements: int,
    chamber: str = "linearized",
    twists: int | None = None,
    surface: Surface | None = None,
) -> tuple[Tree, list[Rest]]:
    """Equilibria along a path of pressures that begins near none.

    Args:
        robot: its limbs.
        pressures: of its chambers, (B, S) [Pa].
        elements: hinges of each limb, even.
        chamber: law of the chambers, see analytic.scene.chain.
        twists: of each limb; as usual_twists has them if None.
        surface: whose adhesion pulls at the limbs.
    """
    if twists is None:
        twists = usual_twists(robot, elements)
    tree = Tree(robot, elements, twists, surface=surface)
    statics = Statics(tree, chamber)
    rest, rests = statics.flat(), []
    for row in counted(list(pressures)):
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
        tree, rests, pressures: what `shapes` gave, for pressures of the chambers, (B, S) [Pa].
        ground: what resists, by the place along x.
        law: of friction, a name of analytic.friction.laws.LAWS.
        times: of the shapes, (B,) [s], which viscous ground asks for.

    Raises:
        ValueError: see analytic.solvers.limbs.contacts.spans_of and
            analytic.friction.grip.check_feet_in_space.
    """
    spans = spans_of(tree.robot, ground, times, len(rests))
    check_feet_in_space(tree.robot, ground)
    finder = Contacts(tree, law)
    contacts = [finder.find(rest, row) for rest, row in zip(rests, pressures, strict=True)]
    place, heading = np.zeros((len(rests), 2)), np.zeros(len(rests))
    for i, (begin, end) in enumerate(pairwise(rests)):
        shift, turn = np.zeros(2), 0.0
        turned = rotation(heading[i])
        for state, row in zip(contacts[i : i + 2], pressures[i : i + 2], strict=True):
            if not state:
                continue
            weights = finder.weights(state)
            before, after = weights @ begin.nodes[:, :2], weights @ end.nodes[:, :2]
            x = place[i, 0] + before @ turned[0]
            bounds, viscous, nap = finder.friction(
                state, ground, x, 0.0, -heading[i], pressures=row
            )
            motion = least_dissipation_in_plane(
                bounds, 0.5 * (before + after), after - before, viscous / spans[i], shares(state),
                nap,
            )  # fmt: skip
            shift += 0.5 * motion.shift
            turn += 0.5 * motion.turn
        place[i + 1] = place[i] + rotation(heading[i] + 0.5 * turn) @ shift
        heading[i + 1] = heading[i] + turn
    when = np.arange(float(len(rests))) if times is None else times
    return Path(tree.robot, pressures, when, rests, contacts, place, heading)


def walk(
    robot: LimbedRobot, gait: Gait, ground: Ground, states: int = 40, elements: int = 6,
    cycles: int = 1, law: str = "constant", bent: bool = True, chamber: str = "linearized",
    path: Array | None = None, times: Array | None = None, incline: Incline = LEVEL,
    twists: int | None = None, all_on_tips: bool = False,
) -> Path:  # fmt: skip
    """Walk a gait quasi-statically, or along a path of pressures.

    Args:
        robot: its limbs.
        gait: fractions of the robot's peak pressure, one per chamber, in their order.
        ground: under it.
        states: of a change by the peak pressure.
        elements: hinges of each limb, even.
        cycles: how many.
        law: of friction, a name of analytic.friction.laws.LAWS.
        bent: whether friction bends the robot; else it only decides which contacts slide, as in
            the limit of weak friction.
        chamber: law of the chambers, see analytic.scene.chain.
        path, times: pressures in the chambers in place of the gait's, (B, S) [Pa], and when, (B,)
            [s].
        incline: of the ground; places are along it.
        twists: of each limb, half as many as its hinges at most; 0 where limbs do not twist; as
            analytic.scene.limbs.usual_twists has them if None.
        all_on_tips: of friction by load that bends the robot, see
            analytic.solvers.limbs.contacts.Contacts.

    Raises:
        ValueError: the gait or the path is not for so many chambers, a pressure is no number, times
            go back, there is no such law, there are no states, cycles or elements, too many
            twists, or the ground rises and friction does not bend the robot.
    """
    one_of("friction", law, LAWS)
    if incline.slope and not bent:
        raise ValueError("on a slope friction must bend the robot: bent must be true, got False")
    whole("states", states, 1)
    whole("cycles", cycles, 1)
    if gait.segments != len(robot.chambers):
        raise ValueError(
            f"gait {gait.name!r} is for {gait.segments} chambers, the robot has "
            f"{len(robot.chambers)}: {', '.join(robot.chambers)}"
        )
    if path is None:
        fractions, times = gait.path(states, cycles)
        path = robot.peak_pressure * fractions
    path, columns = np.asarray(path, dtype=float), len(robot.chambers)
    if path.ndim != 2 or path.shape[1] != columns or not len(path) or not np.isfinite(path).all():
        raise ValueError(
            f"pressures must be rows of {columns} numbers, one per chamber ("
            f"{', '.join(robot.chambers)}), got an array of shape {path.shape}"
            + ("" if np.isfinite(path).all() else " with values that are none")
        )
    if times is not None:
        times_of(times, len(path))
    spans_of(robot, ground, times, len(path))  # refuses what has no times and needs them
    clock = np.arange(float(len(path))) if times is None else np.asarray(times, dtype=float)
    path, times = _with_thresholds(robot, ground.at(0.0), acting_pressures(robot, path), clock)
    if twists is None:
        twists = usual_twists(robot, elements, incline)
    if bent:
        statics = Statics(Tree(robot, elements, twists, incline, ground.at(0.0)), chamber)
        return stick_slip_path(statics, path, ground, law, times, all_on_tips)
    tree, rests = shapes(robot, path, elements, chamber, twists, ground.at(0.0))
    return follow(tree, rests, path, ground, law, times)


def _with_thresholds(
    robot: LimbedRobot, surface: Surface, path: Array, times: Array
) -> tuple[Array, Array]:
    """Pressures (B, S) and times (B,) with states either side of where an end may begin to lie.

    What resists there jumps, and where it does is known: at a part of the peak pressure, or where
    it peels off.
    """
    level = flat_pressures(robot, surface)
    begin, change = path[:-1], np.diff(path, axis=0)
    parts = np.divide(level - begin, change, out=np.full_like(change, -1.0), where=change != 0)
    rows, columns = np.nonzero((parts > _APART) & (parts < 1 - _APART))
    at = rows + parts[rows, columns]
    places = np.unique(np.concatenate([np.arange(float(len(path))), at - _BESIDE, at + _BESIDE]))
    index = np.arange(float(len(path)))
    dense = np.stack([np.interp(places, index, column) for column in path.T], axis=1)
    return dense, np.interp(places, index, times)
