"""The strip with finite rotations and unilateral contact, followed quasi-statically.

States are a path: each starts from the last, in smaller steps of pressure where a step fails, and
every one is tested for stability. So the branch of equilibria that begins with the strip lying flat
is followed as far as it is stable, and no other is ever returned.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.friction.contact_length import contact_mode, side_contact
from analytic.friction.laws import Friction
from analytic.scene.chain import link_lengths, node_positions
from analytic.scene.ground import check_adhesion
from analytic.scene.pressures import check_pressures
from analytic.scene.robot import Robot
from analytic.scene.surface import Ground
from analytic.shapes import ContactShapes, Status
from analytic.solvers.elastica.continuation import follow
from analytic.solvers.elastica.newton import Chain
from analytic.solvers.elastica.state import ChainState
from analytic.solvers.elastica.stick_slip import StickSlip

Array = NDArray[np.float64]

_LEAST_STEP = 1e-4  # of the way between two states, below which the branch is taken to end
_LEAST_GRIPPED = 1e-2  # the same where friction or adhesion may let go, and damped motion goes on
_CURLED = 0.02  # slope that an end in flat contact does not have, even where it lifts off [rad]
_JUMP = 0.03  # change of a direction at one pressure that is told as a jump [rad]; chosen
_LEAP = 0.3  # change of a direction in one step that may be a leap to another branch [rad]

_FIRST_DRAG, _LEAST_DRAG, _MOST_DRAG = 10.0, 1e-3, 1e6  # over the hinges' stiffness; chosen
_FLOW_STEPS = 200

LINKS = 60  # of the chain, unless told otherwise; chosen


def solve_elastica(
    robot: Robot,
    pressures_pa: ArrayLike,
    links: int = LINKS,
    chamber: str = "linearized",
    ground: Ground | None = None,
    friction: Friction | None = None,
    times: ArrayLike | None = None,
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

    Returns:
        Shapes of B states. From where the stable branch ends (the strip rolls up, topples, snaps,
        or slides down a slope as a whole) the states are NaN with BRANCH_END, and where an end
        curls up off the ground, with ROLLED_UP; the last one before tells the pressure. Where
        friction held the strip until it let go at once, the first state after, which is where
        damped hinges lead, has JUMPED.

    Raises:
        ValueError: the pressures are bad, there is no such chamber law, links is below 6, or
            sealed chambers do not fit them, or ground that changes along x is adhesive.
    """
    p = check_pressures(robot, pressures_pa, both_ways=chamber != "sealed")
    durations = np.full(len(p), np.inf)
    if times is not None:
        durations[1:] = np.diff(np.asarray(times, dtype=float))
    if links < 6:
        raise ValueError(f"links must be at least 6, got {links}")
    friction = friction or Friction()
    surface = None
    if ground:
        check_adhesion(ground)
        surface = ground.at(0.0)
    chain = Chain(robot, links, chamber, slope=friction.slope, surface=surface)
    stick_slip = None
    if ground and friction.tension:
        stick_slip = StickSlip(chain, ground, friction)
    count = len(p)
    y, theta = np.full((count, links + 2), np.nan), np.full((count, links + 1), np.nan)
    force = np.full((count, links + 2), np.nan)
    residual = np.full(count, np.nan)
    status = np.full(count, int(Status.BRANCH_END))
    iterations = np.zeros(count, dtype=int)
    place, signs = np.full(count, np.nan), []

    state, last, here = chain.flat(), None, np.zeros(len(robot.segments))
    for i in range(count):
        begun = chain.iterations
        chain.load_at(p[i])
        guess = state if last is None else _extrapolate(last, state, p, i)
        if stick_slip:
            stick_slip.begin(state, durations[i])
        candidate = _unless_it_leaps(state, chain.equilibrium(guess, stick_slip))
        if candidate is None:
            candidate = _in_smaller_steps(chain, state, here, p[i], stick_slip, durations[i])
        jumped = False
        if candidate is None and (stick_slip or chain.reach):
            chain.load_at(p[i])
            candidate = _damped(chain, state, stick_slip)
            jumped = candidate is not None and _apart(candidate, state) > _JUMP
        iterations[i] = chain.iterations - begun
        if candidate is None:
            break
        last, state, here = state, candidate, p[i]
        if friction.contacts == "ends" and _rolled_up(candidate):
            status[i] = Status.ROLLED_UP
            continue
        y[i], theta[i] = candidate.y, candidate.theta
        status[i] = Status.JUMPED if jumped else Status.OK
        force[i] = chain.ground_force(candidate)
        residual[i] = chain.residual(candidate)
        place[i] = candidate.left * robot.length
        signs.append(stick_slip.signature() if stick_slip else ())

    nodes = node_positions(robot, links)
    newtons = force * chain.force_unit
    press = surface.press(robot.width) if surface else 0.0
    left, right = side_contact(robot, nodes, newtons, y * robot.length, p, press)
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
        left=place - place[0] if stick_slip else None,
        switches=_switches(signs, count) if stick_slip else None,
    )


def _switches(signs: Sequence[tuple[object, ...]], count: int) -> NDArray[np.bool_]:
    """Increments between unlike signs; none from where states are missing."""
    unlike = [one != two for one, two in pairwise(signs)]
    return np.array(unlike + [False] * (count - 1 - len(unlike)), dtype=bool)


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
    return None if candidate is None or _apart(candidate, before) > _LEAP else candidate


def _apart(one: ChainState, two: ChainState) -> float:
    """Greatest difference of a direction [rad]."""
    return float(np.abs(one.theta - two.theta).max())


def _in_smaller_steps(
    chain: Chain,
    start: ChainState,
    from_p: Array,
    to_p: Array,
    grip: StickSlip | None,
    duration: float,
) -> ChainState | None:
    """Go from one state to the next by continuation; None if the branch ends on the way."""
    done = 0.0

    def solve(part: float, near: ChainState) -> ChainState | None:
        nonlocal done
        chain.load_at(from_p + part * (to_p - from_p))
        if grip:
            grip.begin(near, (part - done) * duration)
        found = _unless_it_leaps(near, chain.equilibrium(near, grip))
        done = done if found is None else part
        return found

    least = _LEAST_GRIPPED if grip or chain.reach else _LEAST_STEP
    return follow(start, solve, first=0.25, shrink=0.5, least=least)


def _damped(chain: Chain, state: ChainState, grip: StickSlip | None) -> ChainState | None:
    """Where hinges that resist turning, ever less, lead to at one pressure; None if nowhere."""
    drag, steps = _FIRST_DRAG, 0
    while drag < _MOST_DRAG and steps < _FLOW_STEPS:
        steps += 1
        chain.damp(drag, state)
        if grip:
            grip.begin(state)
        candidate = _unless_it_leaps(state, chain.equilibrium(state, grip))
        chain.damp(0.0)
        if candidate is None:
            drag *= 4.0
            continue
        moved = _apart(candidate, state)
        state = candidate
        if moved < _LEAP / 3:
            drag *= 0.5
        if drag < _LEAST_DRAG:
            if grip:
                grip.begin(state)
            return _unless_it_leaps(state, chain.equilibrium(state, grip))
    return None


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
