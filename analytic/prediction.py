"""How far a robot goes in a cycle, by any rung, with the changes of anchor resolved."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.elastica import LINKS, solve_elastica
from analytic.friction import Friction, Surface
from analytic.gait import Gait
from analytic.locomotion import PAPER, Locomotion, anchor_share, locomotion, mean_share
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
    links: int = LINKS,
    friction: Friction = PAPER,
    gas: str = "affine",
    path: ArrayLike | None = None,
) -> Prediction:
    """Walk one cycle quasi-statically.

    The anchor rule is right but for the increments in which the anchor changes: those are found in
    a first pass and divided into `refinement` parts in a second.

    Args:
        robot, gait, surface: the scene.
        rung: a name of RUNGS.
        n_per_leg: states per ramp of the gait in the first pass.
        refinement: parts of an increment in which the anchor changes.
        links: of the elastica's chain.
        friction: law, number and slope; "coulomb" needs a rung that knows forces, and elastica
            alone lets friction bend the strip.
        gas: what the air does, see analytic.chain; elastica only, but for "affine".
        path: pressures to follow instead of the gait's, from none, (B, S) [Pa].

    Raises:
        ValueError: there is no such rung or law, the rung does not know what it needs for them, or
            the gait is divided into no states.
    """
    if rung not in RUNGS:
        raise ValueError(f"rung must be one of {', '.join(RUNGS)}; got {rung!r}")
    if (friction.number or gas != "affine") and rung != REFERENCE:
        raise ValueError(f"{REFERENCE} alone knows gases and bending friction, got rung {rung!r}")
    solve = RUNGS[rung]
    if rung == REFERENCE:
        solve = partial(solve_elastica, links=links, gas=gas, surface=surface, friction=friction)
    path = robot.peak_pressure * gait.pressures(n_per_leg) if path is None else np.asarray(path)
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
    share = mean_share(shapes, surface, friction)
    change = np.diff(anchor_share(shapes, surface, friction.law)) != 0
    return change | (np.abs(share - np.round(2 * share) / 2) > 0)
