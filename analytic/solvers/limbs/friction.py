"""Friction on the contacts of a tree of limbs in one increment, with its exact derivatives."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.dissipation_in_plane import SmoothFriction
from analytic.solvers.limbs.kinematics import Pose, Tree

Array = NDArray[np.float64]


class ContactFriction(NamedTuple):
    """Friction on the contacts of an increment.

    Attributes:
        weights: of the nodes in each place that resists, (C, P).
        before: places at the beginning of the increment, (C, 2) [m].
        law: bounds and viscous resistance of each place.
    """

    weights: Array
    before: Array
    law: SmoothFriction

    def cost(self, nodes: Array, sharpness: float) -> float:
        """Dissipation on the way to nodes at places (P, 3) [m], see SmoothFriction [J]."""
        return self.law.cost(self.weights @ nodes[:, :2] - self.before, sharpness)

    def slopes(self, tree: Tree, pose: Pose, sharpness: float) -> tuple[Array, Array]:
        """Slopes of the cost by the coordinates, (Q,), and their slopes, (Q, Q)."""
        pull, stiff = self.law.slopes(self.weights @ pose.nodes[:, :2] - self.before, sharpness)
        near = np.flatnonzero(self.weights.any(axis=0))
        moves = np.tensordot(self.weights[:, near], tree.moves(pose, near)[:, :2], axes=1)
        force = np.zeros_like(pose.nodes)
        force[:, :2] = self.weights.T @ pull
        flat = moves.reshape(-1, moves.shape[-1])  # (2 C, Q)
        bent = flat.T @ (stiff @ moves).reshape(flat.shape)
        return flat.T @ pull.ravel(), bent + tree.bending(pose, force)
