"""Who slides where a robot touches the ground in the plane: the way of least dissipation.

As analytic.friction.dissipation along one line: the robot's shape moves its contacts at r_j by m_j,
while the whole shifts by t and turns by a small angle w. The ground resists at each by a bound V_j
whatever the direction, and the motion dissipates least,

    (t, w) minimise  sum_j V_j |u_j| + k_j |u_j|^2 / 2,    u_j = m_j + t + w e x r_j,

e normal to the ground, k_j the viscous resistance over the time that the increment takes. It is
convex. Where several motions dissipate alike the limit of vanishing equal viscosity
decides: of them the least squares of the slips.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_SMOOTHEST, _SHARPEST = 1.0, 1e-10  # slips that are told apart from 0, of the largest move
_CLOSER = 0.2  # ratio of one to the next
_VISCOSITY = 1e-7  # force at the largest move, of the largest bound: vanishes
_MOST_STEPS, _ENOUGH = 60, 1e-13
_SHORTEST = 1e-12  # of a step that a line search tries


class PlanarMotion(NamedTuple):
    """How the whole moves.

    Attributes:
        shift: of the origin, (2,) [m].
        turn: to the left [rad].
        slip: of each contact, (C, 2) [m].
        dissipated: by all of them [J].
    """

    shift: Array
    turn: float
    slip: Array
    dissipated: float


def least_dissipation_in_plane(
    bounds: Array, places: Array, moves: Array, viscous: Array | None = None
) -> PlanarMotion:
    """The motion of the whole.

    Args:
        bounds: V_j of the contacts, at least 0, shape (C,) [N].
        places: r_j, shape (C, 2) [m].
        moves: m_j by which the shape moves them, shape (C, 2) [m].
        viscous: k_j, at least 0, shape (C,) [N/m]; none if None.

    Raises:
        ValueError: they are not alike many, or there is no contact.
    """
    bounds, places, moves = (np.asarray(a, dtype=float) for a in (bounds, places, moves))
    count = len(bounds)
    if not count or places.shape != (count, 2) or moves.shape != (count, 2):
        raise ValueError(
            f"need a place and a move (x, y) for each of one bound at least, got {count} bounds, "
            f"places {places.shape} and moves {moves.shape}"
        )
    size = float(np.abs(moves).max())
    if size == 0.0:
        return PlanarMotion(np.zeros(2), 0.0, np.zeros_like(moves), 0.0)
    centre = places.mean(axis=0)
    arms = places - centre
    reach = float(np.abs(arms).max()) or 1.0
    thick = np.zeros(count) if viscous is None else np.asarray(viscous, dtype=float) * size
    strongest = float(max(bounds.max(), thick.max())) or 1.0
    weights, thick = bounds / strongest, thick / strongest + _VISCOSITY
    # how the slips, over the largest move, follow from the shift and the turn of the centre
    lever = np.zeros((count, 2, 3))
    lever[:, 0, 0] = lever[:, 1, 1] = 1.0
    lever[:, 0, 2], lever[:, 1, 2] = -arms[:, 1] / reach, arms[:, 0] / reach
    found = _minimise(weights, thick, lever, moves / size)
    slip = size * (moves / size + lever @ found)
    turn = float(size * found[2] / reach)
    shift = size * found[:2] - turn * np.array([-centre[1], centre[0]])
    lost = bounds @ np.hypot(*slip.T)
    if viscous is not None:
        lost += np.asarray(viscous) @ (slip**2).sum(axis=1)
    return PlanarMotion(shift, turn, slip, float(lost))


def _minimise(weights: Array, thick: Array, lever: Array, moves: Array) -> Array:
    """Newton's method on ever sharper corners: |u| as sqrt(u^2 + sharpness^2)."""
    # by viscosity alone: least squares
    root = np.sqrt(np.repeat(thick, 2))
    flat = root[:, None] * lever.reshape(-1, 3)
    motion: Array = np.asarray(
        np.linalg.lstsq(flat, -root * moves.ravel(), rcond=None)[0], dtype=float
    )
    sharpness = _SMOOTHEST
    while sharpness > _SHARPEST and weights.any():
        sharpness *= _CLOSER
        motion = _newton(weights, thick, lever, moves, motion, sharpness)
    return motion


def _newton(
    weights: Array, thick: Array, lever: Array, moves: Array, motion: Array, sharpness: float
) -> Array:
    def cost(at: Array) -> float:
        slip = moves + lever @ at
        square = (slip**2).sum(axis=1)
        smooth = float(weights @ np.sqrt(square + sharpness**2))
        return smooth + 0.5 * float(thick @ square)

    now = cost(motion)
    for _ in range(_MOST_STEPS):
        slip = moves + lever @ motion
        length = np.sqrt((slip**2).sum(axis=1) + sharpness**2)
        pull = (weights / length + thick)[:, None] * slip
        gradient = np.einsum("cij,ci->j", lever, pull)
        across = np.einsum("ci,cj->cij", slip, slip) / (length**2)[:, None, None]
        stiff = (weights / length)[:, None, None] * (np.eye(2) - across)
        stiff += thick[:, None, None] * np.eye(2)
        hessian = np.einsum("cik,cij,cjl->kl", lever, stiff, lever)
        step = -np.linalg.lstsq(hessian, gradient, rcond=1e-15)[0]
        fall, part = float(gradient @ step), 1.0
        if -fall <= _ENOUGH * max(now, sharpness):
            break
        while (then := cost(motion + part * step)) > now + 1e-4 * part * fall:
            part *= 0.5
            if part < _SHORTEST:
                return motion
        motion, now = motion + part * step, then
    return motion
