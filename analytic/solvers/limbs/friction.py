"""Friction on the contacts of a tree of limbs in one increment, with its exact derivatives."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.dissipation_in_plane import Nap, SmoothFriction
from analytic.solvers.limbs.kinematics import Pose, Tree

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_TINY = 1e-100
_FAR = 2.0  # slips within which a spring holds, that are no direction yet
_ALIKE = 0.01  # of the greatest bound, by which bounds may change and count as the same; chosen
_WORST = 0.99  # of the greatest excess: what gives way at once


class ContactFriction(NamedTuple):
    """Friction on the contacts of an increment.

    A contact that holds is drawn by a stiff spring from the traction that it had; one that slides
    is drawn by its bound along its slip.

    Attributes:
        weights: of the nodes in each place that resists, (C, P).
        before: places at the beginning of the increment, (C, 2) [m].
        bounds: of the tractions, (C,) [N].
        viscous: resistance to slips, (C,) [N/m].
        spring: stiffness of what holds, (C,) [N/m].
        held: tractions so far, against slips as the nap scales them, (C, 2) [N].
        holds: which contacts hold, (C,).
        speeds: of slips that the bounds are of, (C,) [m/s]; 0 where they do not depend on them.
        nap: directions of the contacts, None where all resist alike in all of them.
    """

    weights: Array
    before: Array
    bounds: Array
    viscous: Array
    spring: Array
    held: Array
    holds: Flags
    speeds: Array
    nap: Nap | None = None

    def agrees(self, before: "ContactFriction") -> bool:
        """Tell whether contacts, and bounds by the speed of slips, are as they were before."""
        if len(self.bounds) != len(before.bounds):
            return False
        change = np.abs(self.bounds - before.bounds)
        slides = (self.speeds > 0) | (before.speeds > 0)
        return not (change[slides] > _ALIKE * self.bounds.max(initial=0.0)).any()

    def slips(self, nodes: Array) -> Array:
        """Slips with nodes at places (P, 3) [m], (C, 2) [m]."""
        return self.weights @ nodes[:, :2] - self.before

    def cost(self, nodes: Array, sharpness: float) -> float:
        """Dissipation on the way to nodes at places (P, 3) [m], see SmoothFriction [J]."""
        return self._smooth.cost(self.slips(nodes), sharpness)

    def slopes(self, tree: Tree, pose: Pose, sharpness: float) -> tuple[Array, Array]:
        """Slopes of the cost by the coordinates, (Q,), and their slopes, (Q, Q)."""
        pull, stiff = self._smooth.slopes(self.slips(pose.nodes), sharpness)
        _, gradient, hessian = self._by_coordinates(tree, pose, pull, stiff)
        return gradient, hessian + tree.bending(pose, self._on_nodes(pull))

    def forces(self, tree: Tree, pose: Pose) -> tuple[Array, Array, Array, Array]:
        """Forces of contacts that hold and slide as they do.

        Returns:
            Slopes of the slips by the coordinates, (C, 2, Q); forces by the coordinates, (Q,), and
            their slopes as far as the forces change, (Q, Q); and the forces on the nodes, (P, 3).
        """
        slips = self.slips(pose.nodes)
        pull = self._pull(self._scaled(slips))
        size = _sizes(pull)
        part = np.where(self.holds, 1.0, self.bounds / size)
        stiff = self.spring * part
        across = np.where(self.holds, 0.0, stiff / size**2)
        stiffness = -across[:, None, None] * pull[:, :, None] * pull[:, None]
        stiffness[:, 0, 0] += stiff
        stiffness[:, 1, 1] += stiff
        pull = part[:, None] * pull
        # springs are stiff: what they pull while they settle turns nothing
        turning = np.where(self.holds[:, None], self.held, pull)
        if self.nap is not None:
            pull, turning = self.nap.traction(pull), self.nap.traction(turning)
            stiffness = self.nap.stiffness(stiffness)
        stiffness[:, 0, 0] += self.viscous
        stiffness[:, 1, 1] += self.viscous
        pull = pull + self.viscous[:, None] * slips
        return (*self._by_coordinates(tree, pose, pull, stiffness), self._on_nodes(turning))

    def after(self, slips: Array, slack: float = 0.0) -> "ContactFriction":
        """Friction after slips (C, 2) [m]: its tractions, and which contacts hold.

        Args:
            slips: (C, 2) [m].
            slack: of the bounds, by which a contact that holds may exceed its own.
        """
        slips = self._scaled(slips)
        pull = self._pull(slips)
        size = _sizes(pull)
        excess = np.where(self.holds, size / np.maximum(self.bounds, _TINY), 0.0)
        excess[self.bounds == 0] = 0.0
        gives = excess > max(1.0 + slack, _WORST * float(excess.max(initial=0.0)))
        back = (slips * self.held).sum(axis=1) < 0
        holds = np.where(self.holds, ~gives, back) & (self.bounds > 0)
        part = np.where(holds & self.holds, 1.0, np.minimum(1.0, self.bounds / size))
        return self._replace(held=part[:, None] * pull, holds=holds)

    def least(self, nodes: Array, sharpness: float) -> "ContactFriction":
        """Friction where the smooth cost is least, nodes at places (P, 3) [m]."""
        slips = self._scaled(self.slips(nodes))
        size = np.sqrt((slips**2).sum(axis=1) + sharpness**2)
        held = (self.bounds / size)[:, None] * slips
        return self._replace(held=held, holds=(size < _FAR * sharpness) & (self.bounds > 0))

    @property
    def _smooth(self) -> SmoothFriction:
        return SmoothFriction(self.bounds, self.viscous, self.nap)

    def _scaled(self, slips: Array) -> Array:
        return slips if self.nap is None else self.nap.scaled(slips)

    def _pull(self, slips: Array) -> Array:
        """Traction that would hold each contact; of one that slid far only its direction counts."""
        pull = self.spring[:, None] * slips
        far = ~self.holds & (_sizes(pull) > _FAR * self.bounds)
        return np.where(far[:, None], pull, pull + self.held)

    def _by_coordinates(
        self, tree: Tree, pose: Pose, pull: Array, stiff: Array
    ) -> tuple[Array, Array, Array]:
        near = np.flatnonzero(self.weights.any(axis=0))
        moves = np.tensordot(self.weights[:, near], tree.moves(pose, near)[:, :2], axes=1)
        flat = moves.reshape(-1, moves.shape[-1])  # (2 C, Q)
        return moves, flat.T @ pull.ravel(), flat.T @ (stiff @ moves).reshape(flat.shape)

    def _on_nodes(self, pull: Array) -> Array:
        force = np.zeros((self.weights.shape[1], 3))
        force[:, :2] = self.weights.T @ pull
        return force


def _sizes(vectors: Array) -> Array:
    return np.maximum(np.sqrt(vectors[:, 0] ** 2 + vectors[:, 1] ** 2), _TINY)
