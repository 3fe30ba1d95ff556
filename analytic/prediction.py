"""How far a robot goes in a cycle, by any solver, with the changes of anchor resolved."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.elastica import LINKS, solve_elastica
from analytic.equilibria import Shapes, Status
from analytic.friction import Friction, Surface
from analytic.gait import Gait
from analytic.locomotion import UNBENT, Locomotion, locomotion, mean_slip_fraction, slip_fraction
from analytic.modes import solve_modes
from analytic.obstacle import solve_obstacle
from analytic.robot import Robot

Array = NDArray[np.float64]

Solver = Callable[[Robot, ArrayLike], Shapes]

SOLVERS: dict[str, Solver] = {
    "modes": solve_modes,  # the paper's: small slopes, one flat end, closed form
    "obstacle": solve_obstacle,  # small slopes, exact contact
    "elastica": solve_elastica,  # finite rotations, exact contact: the reference
}
REFERENCE = "elastica"


class Prediction(NamedTuple):
    """One cycle by one solver.

    Attributes:
        pressures: states of the cycle, shape (B, 3) [Pa], denser where the anchor changes.
        shapes: their equilibria.
        locomotion: displacements along them.
        flags: every flag that a state carries.
    """

    pressures: Array
    shapes: Shapes
    locomotion: Locomotion
    flags: Status


def predict(
    robot: Robot,
    gait: Gait,
    surface: Surface,
    solver: str = REFERENCE,
    states_per_ramp: int = 50,
    refinement: int = 32,
    links: int = LINKS,
    friction: Friction = UNBENT,
    chamber: str = "linearized",
    path: ArrayLike | None = None,
) -> Prediction:
    """Walk one cycle quasi-statically.

    The anchor rule is right but for the increments in which the anchor changes: those are found in
    a first pass and divided into `refinement` parts in a second.

    Args:
        robot, gait, surface: the scene.
        solver: a name of SOLVERS.
        states_per_ramp: states per ramp of the gait in the first pass.
        refinement: parts of an increment in which the anchor changes.
        links: of the elastica's chain.
        friction: law, number and slope; "coulomb" needs a solver that knows forces, and elastica
            alone lets friction bend the strip.
        chamber: what the air does, see analytic.chain; elastica only, but for "linearized".
        path: pressures to follow instead of the gait's, from none, (B, S) [Pa].

    Raises:
        ValueError: there is no such solver or law, the solver does not know what it needs for them, or
            the gait is divided into no states.
    """
    if solver not in SOLVERS:
        raise ValueError(f"solver must be one of {', '.join(SOLVERS)}; got {solver!r}")
    if (friction.number or chamber != "linearized") and solver != REFERENCE:
        raise ValueError(
            f"{REFERENCE} alone knows gases and bending friction, got solver {solver!r}"
        )
    solve = SOLVERS[solver]
    if solver == REFERENCE:
        solve = partial(
            solve_elastica, links=links, chamber=chamber, surface=surface, friction=friction
        )
    path = (
        robot.peak_pressure * gait.pressures(states_per_ramp) if path is None else np.asarray(path)
    )
    shapes = solve(robot, path)
    changes = np.flatnonzero(_undecided_within(shapes, surface, friction))
    if len(changes) and refinement > 1:
        part = np.linspace(0, 1, refinement + 1)[1:-1, None]
        between = [path[i] + part * (path[i + 1] - path[i]) for i in changes]
        path = np.insert(
            path, np.repeat(changes + 1, refinement - 1), np.concatenate(between), axis=0
        )
        shapes = solve(robot, path)
    flags = Status(int(np.bitwise_or.reduce(shapes.status)))
    return Prediction(path, shapes, locomotion(shapes, surface, friction=friction), flags)


def _undecided_within(shapes: Shapes, surface: Surface, friction: Friction) -> NDArray[np.bool_]:
    """Increments in which the anchor changes, (B - 1,)."""
    share = mean_slip_fraction(shapes, surface, friction)
    change = np.diff(slip_fraction(shapes, surface, friction.law)) != 0
    return change | (np.abs(share - np.round(2 * share) / 2) > 0)
