"""Least dissipation in the plane: which contacts of a robot slide, and how the whole moves.

As analytic.friction.dissipation along one line: the robot's shape moves its contacts at r_j by m_j,
while the whole shifts by t and turns by a small angle w. The ground resists at each by a bound V_j
whatever the direction, and the motion dissipates least,

    (t, w) minimise  sum_j V_j |u_j| + k_j |u_j|^2 / 2,    u_j = m_j + t + w e x r_j,

e normal to the ground, k_j the viscous resistance over the time that the increment takes. It is
convex. Where several motions dissipate alike the limit of vanishing equal viscosity
decides: of them the least squares of the slips.

A contact that resists otherwise back or across than ahead (see Nap) takes

    V_j |S_j u_j| - p_j u_j

in place of V_j |u_j|, the norm of an ellipse and a constant force: the gradient of a convex
function, as friction of least dissipation must be. By coefficients along and across times the
direction of the slip (Hu et al. 2009) it would be none.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_SMOOTHEST, _SHARPEST = 1.0, 1e-10  # slips that count beside 0, over the largest move
_CLOSER = 0.2  # ratio of one to the next
_VISCOSITY = 1e-7  # force at the largest move, of the largest bound: vanishes
_MOST_STEPS, _ENOUGH = 60, 1e-13
_SHORTEST = 1e-12  # of a step that a line search tries
_NONE = 1e-100  # N


class Nap(NamedTuple):
    """Directions of contacts that resist otherwise back or across than ahead.

    Attributes:
        scale: S_j, (C, 2, 2).
        lean: p_j, constant forces on the contacts, (C, 2) [N].
    """

    scale: Array
    lean: Array

    def scaled(self, slips: Array) -> Array:
        """S_j u_j of slips u_j, (C, 2) [m]."""
        return np.asarray(np.einsum("cij,cj->ci", self.scale, slips))

    def traction(self, scaled: Array) -> Array:
        """Traction against slips from that against scaled slips, (C, 2) [N]."""
        return np.asarray(np.einsum("cji,cj->ci", self.scale, scaled)) - self.lean

    def stiffness(self, scaled: Array) -> Array:
        """Slopes of the traction by the slips from those of the scaled ones, (C, 2, 2) [N/m]."""
        return np.asarray(self.scale.transpose(0, 2, 1) @ scaled @ self.scale)


def nap_of(ahead: Array, back: Array, across: Array, axes: Array) -> tuple[Array, Nap]:
    """Bounds V_j and directions of contacts, by their bounds three ways.

    Args:
        ahead, back, across: bounds, (C,) [N].
        axes: directions of ahead in plan, (C, 2), of length 1.
    """
    along = 0.5 * (ahead + back)
    bounds = np.maximum(along, across)
    least = np.maximum(bounds, _NONE)
    scale = np.empty((len(bounds), 2, 2))
    scale[:, 0] = (along / least)[:, None] * axes
    scale[:, 1, 0] = -across / least * axes[:, 1]
    scale[:, 1, 1] = across / least * axes[:, 0]
    return bounds, Nap(scale, 0.5 * (back - ahead)[:, None] * axes)


class SmoothFriction(NamedTuple):
    """Friction of contacts in the plane, |u| taken as sqrt(u^2 + sharpness^2).

    Attributes:
        bounds: V_j, (C,) [N].
        viscous: k_j, (C,) [N/m].
        nap: directions, None where all resist alike in all of them.
    """

    bounds: Array
    viscous: Array
    nap: Nap | None = None

    def cost(self, slips: Array, sharpness: float) -> float:
        """Dissipation of slips, (C, 2) [m] -> [J]."""
        square = (slips**2).sum(axis=1)
        if self.nap is None:
            return float(self.bounds @ np.sqrt(square + sharpness**2) + 0.5 * self.viscous @ square)
        scaled = (self.nap.scaled(slips) ** 2).sum(axis=1)
        even = self.bounds @ np.sqrt(scaled + sharpness**2) + 0.5 * self.viscous @ square
        return float(even - (self.nap.lean * slips).sum())

    def slopes(self, slips: Array, sharpness: float) -> tuple[Array, Array]:
        """Slopes of the cost by the slips, (C, 2) [N], and their slopes, (C, 2, 2) [N/m]."""
        if self.nap is not None:
            even = SmoothFriction(self.bounds, np.zeros_like(self.viscous))
            pull, curvature = even.slopes(self.nap.scaled(slips), sharpness)
            film = self.viscous[:, None] * slips
            return self.nap.traction(pull) + film, (
                self.nap.stiffness(curvature) + self.viscous[:, None, None] * np.eye(2)
            )
        length = np.sqrt((slips**2).sum(axis=1) + sharpness**2)
        stiff = self.bounds / length
        across = np.einsum("ci,cj->cij", slips, slips) / (length**2)[:, None, None]
        curvature = stiff[:, None, None] * (np.eye(2) - across)
        curvature += self.viscous[:, None, None] * np.eye(2)
        return (stiff + self.viscous)[:, None] * slips, curvature


class PlanarMotion(NamedTuple):
    """Motion of a whole robot in the plane.

    Attributes:
        shift: of the origin, (2,) [m].
        turn: to the left [rad].
        slip: of each contact, (C, 2) [m].
    """

    shift: Array
    turn: float
    slip: Array


def least_dissipation_in_plane(
    bounds: Array,
    places: Array,
    moves: Array,
    viscous: Array | None = None,
    shares: Array | None = None,
    nap: Nap | None = None,
) -> PlanarMotion:
    """The motion of the whole that dissipates least.

    Args:
        bounds: V_j of the contacts, at least 0, shape (C,) [N].
        places: r_j, shape (C, 2) [m].
        moves: m_j by which the shape moves them, shape (C, 2) [m].
        viscous: k_j, at least 0, shape (C,) [N/m]; none if None.
        shares: of each in the equal viscosity that vanishes, shape (C,); 1 if None.
        nap: directions of the contacts, None where all resist alike in all of them.

    Raises:
        ValueError: the arrays are not of one number of contacts, or there is no contact.
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
        return PlanarMotion(np.zeros(2), 0.0, np.zeros_like(moves))
    centre = places.mean(axis=0)
    arms = places - centre
    reach = float(np.abs(arms).max()) or 1.0
    thick = np.zeros(count) if viscous is None else np.asarray(viscous, dtype=float) * size
    strongest = float(max(bounds.max(), thick.max())) or 1.0
    least = _VISCOSITY * (np.ones(count) if shares is None else shares)
    if nap is not None:
        nap = nap._replace(lean=nap.lean / strongest)
    friction = SmoothFriction(bounds / strongest, thick / strongest + least, nap)
    # how the slips, over the largest move, follow from the shift and the turn of the centre
    lever = np.zeros((count, 2, 3))
    lever[:, 0, 0] = lever[:, 1, 1] = 1.0
    lever[:, 0, 2], lever[:, 1, 2] = -arms[:, 1] / reach, arms[:, 0] / reach
    motion = _minimise(friction, lever, moves / size)
    slip = size * (moves / size + lever @ motion)
    turn = float(size * motion[2] / reach)
    shift = size * motion[:2] - turn * np.array([-centre[1], centre[0]])
    return PlanarMotion(shift, turn, slip)


def _minimise(friction: SmoothFriction, lever: Array, moves: Array) -> Array:
    """Shift and turn of least dissipation, (3,), by Newton's method on ever sharper corners."""
    # by viscosity alone: least squares
    root = np.sqrt(np.repeat(friction.viscous, 2))
    flat = root[:, None] * lever.reshape(-1, 3)
    motion: Array = np.asarray(
        np.linalg.lstsq(flat, -root * moves.ravel(), rcond=None)[0], dtype=float
    )
    sharpness = _SMOOTHEST
    while sharpness > _SHARPEST and friction.bounds.any():
        sharpness *= _CLOSER
        motion = _newton(friction, lever, moves, motion, sharpness)
    return motion


def _newton(
    friction: SmoothFriction, lever: Array, moves: Array, motion: Array, sharpness: float
) -> Array:
    cost = friction.cost(moves + lever @ motion, sharpness)
    for _ in range(_MOST_STEPS):
        pull, stiff = friction.slopes(moves + lever @ motion, sharpness)
        gradient = np.einsum("cij,ci->j", lever, pull)
        hessian = np.einsum("cik,cij,cjl->kl", lever, stiff, lever)
        step = -np.linalg.lstsq(hessian, gradient, rcond=1e-15)[0]
        fall, part = float(gradient @ step), 1.0
        if -fall <= _ENOUGH * max(abs(cost), sharpness):
            break
        while (new := friction.cost(moves + lever @ (motion + part * step), sharpness)) > (
            cost + 1e-4 * part * fall
        ):
            part *= 0.5
            if part < _SHORTEST:
                return motion
        motion, cost = motion + part * step, new
    return motion
