"""The paper's contact modes (Appendix A), closed form but for one scalar root, over a batch."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene import pneunet
from analytic.scene.pressures import check_pressures
from analytic.scene.robot import Robot
from analytic.shapes import Mode, Shapes, Status
from analytic.solvers.modes import beam
from analytic.solvers.modes.beam import SEGMENTS
from analytic.solvers.modes.liftoff import lift_off

Array = NDArray[np.float64]

_TOLERANCE = 1e-9  # of slopes and of heights over L, far above rounding, far below interest
_FLAT = 1e-12  # kappa L below which a strip is as good as flat: it lifts less than 1e-5 of L


def solve_modes(robot: Robot, pressures_pa: ArrayLike) -> Shapes:
    """Equilibria in the paper's modes: tip contact, or one end flat and the other a tip.

    An end lies flat if its slope in tip contact points into the ground; if both do, the steeper
    one. (The paper compares the magnitudes of the two slopes; that is the same where both point
    into the ground, and where only one does, the sign has to decide. If they are equal, the left
    end is taken.)

    Args:
        robot: the strip.
        pressures_pa: segment pressures, left first, shape (B, 3) or (3,) [Pa], at least 0.

    Returns:
        Shapes of B states; `status` says where the assumptions break.

    Raises:
        ValueError: the shape is wrong, a pressure is negative or not finite, or the robot has not
            the paper's three equal segments.
    """
    if len(set(robot.segments)) > 1 or len(robot.segments) != SEGMENTS:
        raise ValueError(f"the modes are of three equal segments, got {robot.segments!r}")
    p = check_pressures(robot, pressures_pa)
    k = pneunet.natural_curvature(robot, p) * robot.length
    g = robot.weight_per_length * robot.length**3 / pneunet.rigidity(robot, p)
    a, b, mode, status = _contact(k, g)

    lifted = beam.lift(k, g, a, b)
    lowest, highest = beam.extremes(lifted)
    # an end that lies flat has slope 0 there, so this looks at the ends in point contact only
    sinking = np.maximum(-lifted.slope[:, 0], lifted.slope_b) > _TOLERANCE
    up = mode != Mode.FLAT
    status |= np.where(up & sinking, Status.BOTH_FLAT, 0)
    status |= np.where(up & (lowest < -_TOLERANCE), Status.PENETRATES, 0)
    on_ground = np.maximum(0.0, a[:, None] - beam.EDGES[:-1])
    on_ground = np.maximum(on_ground, beam.EDGES[1:] - b[:, None]) > _TOLERANCE
    status |= np.where(up & (on_ground & (k > _FLAT)).any(axis=1), Status.HELD_FLAT, 0)

    lost = (status & Status.NO_ROOT) != 0
    blank = np.where(lost, np.nan, 1.0)
    flat = mode == Mode.FLAT
    length = robot.length
    return Shapes(
        robot=robot,
        separation=length
        * blank
        * np.where(flat, 1.0, 1 - beam.shortening(lifted, np.ones(1))[:, 0]),
        contact_left=length * blank * np.where(flat, 0.5, a),
        contact_right=length * blank * np.where(flat, 0.5, 1 - b),
        amplitude=length * blank * np.where(flat, 0.0, highest),
        mode=mode,
        status=status,
        curve=_Curve(length, lifted, flat, blank),
    )


def _contact(k: Array, g: Array) -> tuple[Array, Array, NDArray[np.int_], NDArray[np.int_]]:
    """Lifted part [a, b], mode and the status of the search for it."""
    count = len(k)
    zero, ones = np.zeros(count), np.ones(count)
    a, b = zero.copy(), ones.copy()
    mode = np.full(count, Mode.TIP, dtype=int)
    status = np.full(count, Status.OK, dtype=int)

    flat = (k <= _FLAT).all(axis=1)
    mode[flat] = Mode.FLAT

    tip = beam.lift(k, g, zero, ones)
    into_left, into_right = -tip.slope[:, 0], tip.slope_b
    lies = (np.maximum(into_left, into_right) > 0) & ~flat
    left = lies & (into_left >= into_right - _TOLERANCE)
    right = lies & ~left
    for side, first_mode in ((left, Mode.LEFT_1), (right, Mode.RIGHT_1)):
        rows = np.flatnonzero(side)
        if len(rows) == 0:
            continue
        mirror = slice(None) if first_mode == Mode.LEFT_1 else slice(None, None, -1)
        lift = lift_off(k[rows, mirror], g[rows, mirror])
        status[rows] |= np.where(lift.roots == 0, Status.NO_ROOT, 0)
        status[rows] |= np.where(lift.roots > 1, Status.SEVERAL_ROOTS, 0)
        xi = np.nan_to_num(lift.xi, nan=0.0)
        if first_mode == Mode.LEFT_1:
            a[rows] = xi
            at = xi
        else:
            b[rows] = at = 1 - xi
        mode[rows] = first_mode + np.clip((at * SEGMENTS).astype(int), 0, SEGMENTS - 1)
    return a, b, mode, status


class _Curve:
    """Material points of the strip, on demand (see Shapes.curve)."""

    def __init__(
        self, length: float, lifted: beam.Lifted, flat: NDArray[np.bool_], blank: Array
    ) -> None:
        self._length, self._lifted = length, lifted
        self._flat, self._blank = flat, blank

    def __call__(self, s: Array) -> tuple[Array, Array]:
        u = np.asarray(s, dtype=float) / self._length
        height = np.where(self._flat[:, None], 0.0, beam.heights(self._lifted, u))
        # x(s) = s - int_0^s (y')^2 / 2, exactly (10)
        x = u - np.where(self._flat[:, None], 0.0, beam.shortening(self._lifted, u))
        scale = self._length * self._blank[:, None]
        return scale * x, scale * height
