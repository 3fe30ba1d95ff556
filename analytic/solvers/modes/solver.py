"""The paper's contact modes (Appendix A), closed form but for one scalar root, over a batch."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene import pneunet
from analytic.scene.feet import refuse_proud
from analytic.scene.payload import refuse_payload
from analytic.scene.pressures import check_pressures
from analytic.scene.robot import Robot
from analytic.shapes import Flag, Shapes
from analytic.solvers.modes import beam
from analytic.solvers.modes.beam import SEGMENTS
from analytic.solvers.modes.liftoff import lift_off

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

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
            the paper's three equal segments or carries a payload.
    """
    if len(set(robot.segments)) > 1 or len(robot.segments) != SEGMENTS:
        raise ValueError(f"the modes are of three equal segments, got {robot.segments!r}")
    refuse_payload(robot, "the contact modes")
    refuse_proud(robot.feet, "the contact modes")
    p = check_pressures(robot, pressures_pa)
    k = pneunet.natural_curvature(robot, p) * robot.length
    g = robot.weight_per_length * robot.length**3 / pneunet.rigidity(robot, p)
    flat: Mask = np.asarray((k <= _FLAT).all(axis=1))
    a, b, status = _lifted_part(k, g, ~flat)

    lifted = beam.lift(k, g, a, b)
    lowest, highest = beam.extremes(lifted)
    # an end that lies flat has slope 0 there, so this looks at the ends in point contact only
    sinking = np.maximum(-lifted.slope[:, 0], lifted.slope_b) > _TOLERANCE
    status |= np.where(~flat & sinking, Flag.BOTH_FLAT, 0)
    status |= np.where(~flat & (lowest < -_TOLERANCE), Flag.PENETRATES, 0)
    on_ground = np.maximum(0.0, a[:, None] - beam.EDGES[:-1])
    on_ground = np.maximum(on_ground, beam.EDGES[1:] - b[:, None]) > _TOLERANCE
    status |= np.where(~flat & (on_ground & (k > _FLAT)).any(axis=1), Flag.HELD_FLAT, 0)

    scale = robot.length * np.where(status & Flag.NO_ROOT, np.nan, 1.0)
    shortened = beam.shortening(lifted, np.ones(1))[:, 0]
    return Shapes(
        robot=robot,
        separation=scale * np.where(flat, 1.0, 1 - shortened),
        contact_left=scale * np.where(flat, 0.5, a),
        contact_right=scale * np.where(flat, 0.5, 1 - b),
        amplitude=scale * np.where(flat, 0.0, highest),
        status=status,
        curve=_Curve(robot.length, lifted, flat, scale),
    )


def _lifted_part(k: Array, g: Array, up: Mask) -> tuple[Array, Array, NDArray[np.int_]]:
    """Ends a, b of the lifted part of strips, `up` or flat, and the status of the search for it."""
    a, b = np.zeros(len(k)), np.ones(len(k))
    status = np.full(len(k), Flag.OK, dtype=int)
    tip = beam.lift(k, g, a, b)
    into_left, into_right = -tip.slope[:, 0], tip.slope_b
    lies = (np.maximum(into_left, into_right) > 0) & up
    left = lies & (into_left >= into_right - _TOLERANCE)
    for side, order in ((left, 1), (lies & ~left, -1)):
        point = lift_off(k[side, ::order], g[side, ::order])
        status[side] |= np.where(point.roots == 0, Flag.NO_ROOT, 0)
        status[side] |= np.where(point.roots > 1, Flag.SEVERAL_ROOTS, 0)
        xi = np.nan_to_num(point.xi, nan=0.0)
        if order == 1:
            a[side] = xi
        else:
            b[side] = 1 - xi
    return a, b, status


class _Curve:
    """Material points of the strip, on demand (see Shapes.curve)."""

    def __init__(self, length: float, lifted: beam.LiftedPart, flat: Mask, scale: Array) -> None:
        self._length, self._lifted = length, lifted
        self._flat, self._scale = flat[:, None], scale[:, None]

    def __call__(self, s: Array) -> tuple[Array, Array]:
        u = np.asarray(s, dtype=float) / self._length
        height = np.where(self._flat, 0.0, beam.heights(self._lifted, u))
        # x(s) = s - int_0^s (y')^2 / 2, exactly (10)
        x = u - np.where(self._flat, 0.0, beam.shortening(self._lifted, u))
        return self._scale * x, self._scale * height
