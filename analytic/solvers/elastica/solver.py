"""The strip with finite rotations and unilateral contact, followed quasi-statically."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.friction.contact_length import side_contact
from analytic.friction.laws import Friction
from analytic.scene.chain import link_lengths, node_positions
from analytic.scene.feet import refuse_proud
from analytic.scene.ground import check_adhesion
from analytic.scene.pressures import check_pressures
from analytic.scene.robot import Robot
from analytic.scene.surface import Ground
from analytic.shapes import ContactShapes
from analytic.solvers.elastica.branch import NO_NUMBERS, Branch
from analytic.solvers.elastica.newton import Chain
from analytic.solvers.elastica.stick_slip import StickSlip

Array = NDArray[np.float64]

LINKS = 60  # of the chain, unless told otherwise; chosen


def solve_elastica(
    robot: Robot,
    pressures_pa: ArrayLike,
    links: int = LINKS,
    chamber: str = "linearized",
    ground: Ground | None = None,
    friction: Friction | None = None,
    times: ArrayLike | None = None,
    added: bool = False,
) -> ContactShapes:
    """Equilibria along a path of pressures that starts with the strip flat and without pressure.

    Args:
        robot: the strip.
        pressures_pa: segment pressures along the path, left first, (B, S) or (S,) [Pa], at least 0.
        links: of the chain; multiples of 6 are the most accurate. The error falls with its square.
        chamber: law of the chambers, see analytic.scene.chain.
        ground, friction: let friction of a tension above 0 bend the strip, and a slope tilt it; see
            analytic.solvers.elastica.stick_slip. Without them no shear acts, the limit of section
            2.2.
        times: of the states, (B,) [s]; what resists by speed acts as at rest without them.
        added: whether to return, besides the states at the pressures, those between that were found
            where contacts change while friction bends the strip.

    Returns:
        Shapes of B states. From where the stable branch ends (the strip rolls up, topples, snaps,
        or slides down a slope as a whole) the states are NaN with BRANCH_END, and where an end
        curls up off the ground, with ROLLED_UP; the last one before tells the pressure. Where
        friction gives way at once, the first state after, which is where damped hinges lead, has
        JUMPED.

    Raises:
        ValueError: the pressures are bad, there is no such chamber law, links is below 6, or
            sealed chambers do not fit them, or ground that changes along x is adhesive.
    """
    p = check_pressures(robot, pressures_pa, both_ways=chamber != "sealed")
    if links < 6:
        raise ValueError(f"links must be at least 6, got {links}")
    friction = friction or Friction()
    surface = None
    if ground and friction.contacts == "ends":
        refuse_proud(robot.feet, "friction at the ends alone")
    if ground:
        check_adhesion(ground)
        surface = ground.at(0.0)
    chain = Chain(robot, links, chamber, slope=friction.slope, surface=surface)
    traction = StickSlip(chain, ground, friction) if ground and friction.tension else None
    branch = Branch(chain, traction, friction.contacts == "all", p, times)
    points = [point for point in branch.points() if added or point.row % 1 == 0]
    states = [branch.missing if point.status & NO_NUMBERS else point.state for point in points]
    theta = np.array([state.theta for state in states])
    height = np.array([state.y for state in states]) * robot.length
    gap = height - chain.floor * robot.length
    force = np.array([chain.ground_force(state) for state in states]) * chain.force_unit
    place = np.array([state.left for state in states]) * robot.length
    nodes, lengths = node_positions(robot, links), link_lengths(robot, links)
    p = np.array([point.pressure for point in points])
    left, right = side_contact(robot, nodes, force, gap, p, surface)
    return ContactShapes(
        robot=robot,
        separation=np.cos(theta) @ lengths,
        contact_left=left,
        contact_right=right,
        amplitude=height.max(axis=1),
        status=np.array([int(point.status) for point in points]),
        curve=_Curve(nodes, lengths, theta, height),
        nodes=nodes,
        force=force,
        pressures=p,
        rows=np.array([point.row for point in points]),
        residual=np.array([point.residual for point in points]),
        iterations=np.array([point.iterations for point in points]),
        left=place - place[0] if traction else None,
    )


class _Curve:
    """Material points on the links, on demand (see Shapes.curve)."""

    def __init__(self, nodes: Array, lengths: Array, theta: Array, y: Array) -> None:
        self._nodes = nodes
        x = np.cumsum(lengths * np.cos(theta), axis=1)
        self._x = np.concatenate([np.zeros_like(x[:, :1]), x], axis=1)
        self._y = y

    def __call__(self, s: Array) -> tuple[Array, Array]:
        index = np.clip(np.searchsorted(self._nodes, s) - 1, 0, len(self._nodes) - 2)
        part = (np.asarray(s) - self._nodes[index]) / np.diff(self._nodes)[index]
        return tuple(  # type: ignore[return-value]
            (1 - part) * values[:, index] + part * values[:, index + 1]
            for values in (self._x, self._y)
        )
