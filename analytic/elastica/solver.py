"""The strip with finite rotations and unilateral contact, followed quasi-statically.

States are a path: each starts from the last, in smaller steps of pressure where a step fails, and
every one is tested for stability. So the branch of equilibria that begins with the strip lying flat
is followed as far as it is stable, and no other is ever returned.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.chain import link_lengths, node_positions
from analytic.contact import contact_mode, side_contact
from analytic.elastica.continuation import follow
from analytic.elastica.newton import Chain, ChainState
from analytic.elastica.stick_slip import StickSlip
from analytic.equilibria import ContactShapes, Status
from analytic.friction import Friction
from analytic.pressures import check_pressures
from analytic.robot import Robot
from analytic.surface import Ground, Surface

Array = NDArray[np.float64]

_LEAST_STEP = 1e-4  # of the way between two states, below which the branch is taken to end
_CURLED = 0.02  # slope that an end in flat contact does not have, even where it lifts off [rad]
_LEAP = 0.3  # change of a direction in one step that may be a leap to another branch [rad]

LINKS = 60  # of the chain, unless told otherwise; chosen


def solve_elastica(
    robot: Robot,
    pressures_pa: ArrayLike,
    links: int = LINKS,
    chamber: str = "linearized",
    ground: Ground | None = None,
    friction: Friction | None = None,
) -> ContactShapes:
    """Equilibria along a path of pressures that starts with the strip flat and without pressure.

    Args:
        robot: the strip.
        pressures_pa: segment pressures along the path, left first, (B, S) or (S,) [Pa], at least 0.
        links: of the chain; multiples of 6 are the most accurate. The error falls with its square.
        chamber: law of the chambers, see analytic.chain.
        ground, friction: let friction of a tension above 0 bend the strip, and a slope tilt it; see
            analytic.elastica.stick_slip. Without them no shear acts, the limit of section 2.2.

    Returns:
        Shapes of B states. From where the stable branch ends (the strip rolls up, topples, snaps,
        or slides down a slope as a whole) the states are NaN with BRANCH_END, and where an end
        curls up off the ground, with ROLLED_UP; the last one before tells the pressure.

    Raises:
        ValueError: the pressures are bad, there is no such chamber law, links is below 6, sealed
            chambers do not fit them, or friction bends the strip on ground that changes along x.
    """
    p = check_pressures(robot, pressures_pa)
    if links < 6:
        raise ValueError(f"links must be at least 6, got {links}")
    friction = friction or Friction()
    chain = Chain(robot, links, chamber, slope=friction.slope)
    stick_slip = None
    if ground and friction.tension:
        if not isinstance(ground, Surface):
            raise ValueError(
                f"friction bends the strip on uniform ground only, got {ground.name!r}"
            )
        stick_slip = StickSlip(chain, ground, friction)
    count = len(p)
    y, theta = np.full((count, links + 2), np.nan), np.full((count, links + 1), np.nan)
    force = np.full((count, links + 2), np.nan)
    residual = np.full(count, np.nan)
    status = np.full(count, int(Status.BRANCH_END))
    iterations = np.zeros(count, dtype=int)

    state, last, here = chain.flat(), None, np.zeros(len(robot.segments))
    for i in range(count):
        begun = chain.iterations
        chain.load_at(p[i])
        guess = state if last is None else _extrapolate(last, state, p, i)
        candidate = _unless_it_leaps(state, chain.equilibrium(guess))
        if candidate is None:
            candidate = _in_smaller_steps(chain, state, here, p[i])
        if candidate is not None and stick_slip is not None:
            candidate = stick_slip.apply(state, candidate)
        iterations[i] = chain.iterations - begun
        if candidate is None:
            break
        last, state, here = state, candidate, p[i]
        if _rolled_up(candidate):
            status[i] = Status.ROLLED_UP
            continue
        y[i], theta[i], status[i] = candidate.y, candidate.theta, Status.OK
        force[i] = chain.ground_force(candidate)
        residual[i] = chain.residual(candidate)

    nodes = node_positions(robot, links)
    newtons = force * chain.force_unit
    left, right = side_contact(robot, nodes, newtons, y * robot.length, p)
    lengths = link_lengths(robot, links)
    return ContactShapes(
        robot=robot,
        separation=np.cos(theta) @ lengths,
        contact_left=left,
        contact_right=right,
        amplitude=y.max(axis=1) * robot.length,
        mode=contact_mode(robot, np.nan_to_num(left), np.nan_to_num(right)),
        status=status,
        curve=_Curve(nodes, lengths, theta, y * robot.length),
        nodes=nodes,
        force=newtons,
        pressures=p,
        residual=residual,
        iterations=iterations,
    )


def _extrapolate(before: ChainState, now: ChainState, p: Array, i: int) -> ChainState:
    """Linear prediction where the path goes on in the same direction, else the last state."""
    if i < 2:
        return now
    step, previous = p[i] - p[i - 1], p[i - 1] - p[i - 2]
    size = float(previous @ previous)
    if size == 0:
        return now
    ratio = float(step @ previous) / size
    if np.abs(step - ratio * previous).max() > 1e-6 * np.abs(step).max() or not 0 < ratio <= 2:
        return now
    return now._replace(
        theta=now.theta + ratio * (now.theta - before.theta),
        shear=now.shear + ratio * (now.shear - before.shear),
    )


def _rolled_up(state: ChainState) -> bool:
    """Whether an end is off the ground and not for lying nearly flat."""
    ends = ((state.y[0], state.theta[0]), (state.y[-1], state.theta[-1]))
    return any(y > 1e-9 and abs(theta) > _CURLED for y, theta in ends)


def _unless_it_leaps(before: ChainState, candidate: ChainState | None) -> ChainState | None:
    """An equilibrium near the last one, or None: one far away may lie on another branch."""
    if candidate is None or np.abs(candidate.theta - before.theta).max() > _LEAP:
        return None
    return candidate


def _in_smaller_steps(
    chain: Chain, start: ChainState, from_p: Array, to_p: Array
) -> ChainState | None:
    """Go from one state to the next by continuation; None if the branch ends on the way."""

    def solve(part: float, near: ChainState) -> ChainState | None:
        chain.load_at(from_p + part * (to_p - from_p))
        return _unless_it_leaps(near, chain.equilibrium(near))

    return follow(start, solve, first=0.25, shrink=0.5, least=_LEAST_STEP)


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
