"""How far a robot goes in a cycle, by any rung, with the changes of anchor resolved."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.elastica import solve_elastica
from analytic.friction import Surface
from analytic.gait import Gait
from analytic.locomotion import Locomotion, anchor_share, locomotion
from analytic.modes import solve_modes
from analytic.obstacle import solve_obstacle
from analytic.robot import Robot
from analytic.shapes import Shapes, Status

Array = NDArray[np.float64]

Solver = Callable[[Robot, ArrayLike], Shapes]

RUNGS: dict[str, Solver] = {
    "modes": solve_modes,  # the seed's: small slopes, one flat end, closed form
    "obstacle": solve_obstacle,  # small slopes, exact contact
    "elastica": solve_elastica,  # finite rotations, exact contact: the reference
}
REFERENCE = "elastica"


class Prediction(NamedTuple):
    """One cycle by one rung.

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
    rung: str = REFERENCE,
    n_per_leg: int = 50,
    refinement: int = 32,
    solver: Solver | None = None,
    law: str = "paper",
    friction_number: float = 0.0,
) -> Prediction:
    """Walk one cycle quasi-statically.

    The anchor rule is right but for the increments in which the anchor changes: those are found in
    a first pass and divided into `refinement` parts in a second.

    Args:
        robot, gait, surface: the scene.
        rung: a name of RUNGS.
        n_per_leg: states per ramp of the gait in the first pass.
        refinement: parts of an increment in which the anchor changes.
        solver: used instead of the rung's own, for instance with more links.
        law: of friction, see analytic.friction; "coulomb" needs a rung that knows forces.
        friction_number: Phi, where friction is to bend the strip as well; elastica only.

    Raises:
        ValueError: there is no such rung or law, the rung does not know what it needs for them, or
            the gait is divided into no states.
    """
    if rung not in RUNGS:
        raise ValueError(f"rung must be one of {', '.join(RUNGS)}; got {rung!r}")
    if friction_number and rung != "elastica":
        raise ValueError(f"friction bends the strip in elastica only, not in {rung}")
    solve = solver or RUNGS[rung]
    if friction_number:
        solve = partial(solve_elastica, surface=surface, friction_number=friction_number, law=law)
    path = robot.peak_pressure * gait.pressures(n_per_leg)
    shapes = solve(robot, path)
    changes = np.flatnonzero(np.diff(anchor_share(shapes, surface, law)))
    if len(changes) and refinement > 1:
        part = np.linspace(0, 1, refinement + 1)[1:-1, None]
        between = [path[i] + part * (path[i + 1] - path[i]) for i in changes]
        path = np.insert(
            path, np.repeat(changes + 1, refinement - 1), np.concatenate(between), axis=0
        )
        shapes = solve(robot, path)
    flags = Status(int(np.bitwise_or.reduce(shapes.status)))
    return Prediction(path, shapes, locomotion(shapes, surface, law=law), flags)
