"""Friction on the contacts of a tree of limbs in one increment, with its exact derivatives."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from analytic.solvers.limbs.kinematics import Pose, Tree

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Grip:
    """Friction on the contacts of an increment.

    Attributes:
        weights: of the nodes in each place, (C, P).
        before: places before it, (C, 2) [m].
        bounds: V_j, (C,) [N].
        viscous: k_j, (C,) [N/m].
    """

    weights: Array
    before: Array
    bounds: Array
    viscous: Array

    def slips(self, nodes: Array) -> Array:
        """From the places before, (C, 2) [m]."""
        return np.asarray(self.weights @ nodes[:, :2] - self.before)

    def cost(self, nodes: Array, sharpness: float) -> float:
        """What it dissipates, |u| taken as sqrt(u^2 + sharpness^2) [J]."""
        square = (self.slips(nodes) ** 2).sum(axis=1)
        return float(self.bounds @ np.sqrt(square + sharpness**2) + 0.5 * self.viscous @ square)

    def pulls(self, nodes: Array, sharpness: float) -> tuple[Array, Array]:
        """Slopes of the cost by the slips, (C, 2) [N], and their slopes, (C, 2, 2) [N/m]."""
        slip = self.slips(nodes)
        length = np.sqrt((slip**2).sum(axis=1) + sharpness**2)
        firm = (self.bounds / length)[:, None, None]
        across = np.einsum("ci,cj->cij", slip, slip) / (length**2)[:, None, None]
        pull = (self.bounds / length + self.viscous)[:, None] * slip
        return pull, firm * (np.eye(2) - across) + self.viscous[:, None, None] * np.eye(2)


def held(tree: Tree, pose: Pose, grip: Grip, sharpness: float) -> tuple[Array, Array]:
    """Slopes of a grip's cost by the coordinates, (Q,), and their slopes, (Q, Q)."""
    pull, firm = grip.pulls(pose.nodes, sharpness)
    near = np.flatnonzero(grip.weights.any(axis=0))
    moves = np.tensordot(grip.weights[:, near], tree.moves(pose, near)[:, :2], axes=1)  # (C, 2, Q)
    force = np.zeros_like(pose.nodes)
    force[:, :2] = grip.weights.T @ pull
    flat = moves.reshape(-1, moves.shape[-1])  # (2 C, Q)
    bent = flat.T @ (firm @ moves).reshape(flat.shape)
    return flat.T @ pull.ravel(), bent + tree.bending(pose, force)
