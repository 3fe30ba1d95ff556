"""Least dissipation of many motions of a hub at once, as analytic.friction.dissipation_in_plane.

The same convex problem, solved for all rows together: a fit asks for thousands of motions. Corners
of dry friction stay rounded by SHARPEST of the largest move: 0.001 cm of a transition.
"""

import numpy as np

from studies import Array

SHARPEST = 1e-3
_SHARPNESS = (1.0, 0.3, 0.1, 0.03, 0.01, 0.003, SHARPEST)
_LEVER = 8.0  # cm, by which turns count as lengths; chosen
_MOST_STEPS, _HALVINGS, _ENOUGH = 30, 25, 1e-9


def cost(bounds: Array, viscous: Array, slips: Array, sharpness: float) -> Array:
    """Dissipation of slips (N, C, 2) by the bounds and viscous resistances (N, C), (N,)."""
    square = (slips**2).sum(axis=-1)
    rounded = np.sqrt(square + sharpness**2)
    return np.asarray((bounds * rounded + 0.5 * viscous * square).sum(axis=1))


def least_dissipation(bounds: Array, viscous: Array, places: Array, moves: Array) -> Array:
    """Shift and turn of each hub that dissipate least, (N, 3) [cm, cm, rad].

    Args:
        bounds: of the contacts, (N, C).
        viscous: resistance of each over its slip, (N, C) [1/cm].
        places, moves: of the contacts in the hub's frame, (N, C, 2) [cm].
    """
    centre = places.mean(axis=1)
    arms = places - centre[:, None]
    size = np.abs(moves).max(axis=(1, 2))
    size = np.where(size > 0, size, 1.0)
    lever = np.zeros((*places.shape, 3))
    lever[..., 0, 0] = lever[..., 1, 1] = 1.0
    lever[..., 0, 2], lever[..., 1, 2] = -arms[..., 1] / _LEVER, arms[..., 0] / _LEVER
    moves, viscous = moves / size[:, None, None], viscous * size[:, None]
    motion = np.zeros((len(bounds), 3))
    for sharpness in _SHARPNESS:
        _newton(bounds, viscous, lever, moves, motion, sharpness)
    turn = size * motion[:, 2] / _LEVER
    shift = size[:, None] * motion[:, :2]
    shift -= turn[:, None] * np.stack([-centre[:, 1], centre[:, 0]], axis=1)
    return np.column_stack([shift, turn])


def _newton(
    bounds: Array, viscous: Array, lever: Array, moves: Array, motion: Array, sharpness: float
) -> None:
    """Newton's method from motions (N, 3), which are changed, with steps halved where need be."""
    rows = np.arange(len(bounds))
    for _ in range(_MOST_STEPS):
        arm, bound, film, move = lever[rows], bounds[rows], viscous[rows], moves[rows]
        slip = move + np.einsum("ncij,nj->nci", arm, motion[rows])
        length = np.sqrt((slip**2).sum(axis=-1) + sharpness**2)
        even = bound / length
        pull = (even + film)[..., None] * slip
        stiff = -(even / length**2)[..., None, None] * slip[..., :, None] * slip[..., None, :]
        stiff[..., 0, 0] += even + film
        stiff[..., 1, 1] += even + film
        gradient = np.einsum("ncij,nci->nj", arm, pull)
        curvature = np.einsum("ncik,ncij,ncjl->nkl", arm, stiff, arm, optimize=True)
        step = -np.linalg.solve(curvature + 1e-9 * np.eye(3), gradient[..., None])[..., 0]
        fall, now = (gradient * step).sum(axis=1), cost(bound, film, slip, sharpness)
        part = np.ones(len(rows))
        for _ in range(_HALVINGS):
            tried = motion[rows] + part[:, None] * step
            ahead = cost(bound, film, move + np.einsum("ncij,nj->nci", arm, tried), sharpness)
            rises = ahead > now + 1e-4 * part * fall + 1e-14
            if not rises.any():
                break
            part[rises] *= 0.5
        motion[rows] += part[:, None] * step
        rows = rows[-fall > _ENOUGH * np.maximum(now, sharpness)]
        if not len(rows):
            break
