"""Equilibria of a tree by Newton's method on a guess of its contacts.

Nodes that push are kept to the ground and contacts that hold to their places, by stiff springs
whose forces each step takes over; then nodes that pull let go, nodes below the ground push,
contacts beyond their bound slide, and those that slide against their traction hold (a primal-dual
active set). It finds most states in a few steps, as contacts change little between them, and gives
up where it does not.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.linalg.lapack import dposv

from analytic.solvers.limbs.friction import ContactFriction
from analytic.solvers.limbs.kinematics import IN_PLAN, WHOLE, Pose, Tree
from analytic.solvers.limbs.rest import Rest

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_STEPS = 16
_LONGEST = 0.5  # change of an angle in a step [rad]
_SMALL = 1e-4  # steps after which contacts are looked for again
_STILL = 1e-7  # a step that is the last one; the next would be a hundredth of it
_DEEP = 1e-9  # below the ground, over the length: a node that pushes
_FLAT = 1e-13  # of a direction without stiffness, over the stiffest
_RIDGE = 0.02  # weight times length: curvature down across a ridge, where symmetry may hold it
_SLACK = 1e4  # of bounds, over the square of a step: forces are as wrong before it; measured

Renewed = Callable[[Rest, ContactFriction | None], ContactFriction]


class Problem(NamedTuple):
    """A tree whose equilibrium is asked for.

    Attributes:
        tree: its links.
        scale: of the coordinates, (Q,).
        ground: stiffness of the springs that keep nodes to the ground [N/m].
        stiffness, bent: of the joints' springs [N m/rad], and their rest angles [rad].
        renewed: friction by the contacts of a state, from the friction so far; none if None.
    """

    tree: Tree
    scale: Array
    ground: float
    stiffness: Array
    bent: Array
    renewed: Renewed | None

    def slopes(
        self, q: Array, pose: Pose, force: Array, pushes: Flags, friction: ContactFriction | None
    ) -> tuple[Array, Array, Array, Array | None]:
        """Gradient (Q,) and Hessian (Q, Q) on given contacts; slopes of heights and of slips.

        Args:
            q: coordinates, (Q,).
            pose: of the tree there.
            force: of the ground so far, (P,) [N].
            pushes: nodes that are kept to the ground, (P,).
            friction: whose contacts hold and slide as they do.
        """
        rise, load, moves = self.tree.heights(pose), np.zeros_like(pose.nodes), None
        load[:, 2] = self.tree.weight - force
        pushed = rise[pushes]
        gradient = rise.T @ load[:, 2] + self.ground * pushed.T @ pose.nodes[pushes, 2]
        gradient[WHOLE:] += self.stiffness * (q[WHOLE:] - self.bent)
        hessian = self.ground * pushed.T @ pushed
        if friction is not None:
            moves, pull, stiff, drawn = friction.forces(self.tree, pose)
            gradient += pull
            hessian += stiff
            load += drawn
            if self.tree.incline.slope:
                gradient -= self.tree.pulled(pose)
                load[:, :2] -= self.tree.pull
        hessian += self.tree.bending(pose, load)
        joints = np.arange(WHOLE, len(q))
        hessian[joints, joints] += self.stiffness
        if friction is None:
            gradient[list(IN_PLAN)] = 0.0
            hessian[IN_PLAN, :] = hessian[:, IN_PLAN] = 0.0
            hessian[IN_PLAN, IN_PLAN] = self.ground
        return gradient, hessian, rise, moves


def on_contacts(
    problem: Problem, q: Array, force: Array
) -> tuple[Array, Array, ContactFriction | None] | None:
    """The equilibrium near a guess: coordinates, forces of the ground [N], and friction.

    Args:
        problem: what is asked for.
        q: guess of the coordinates, (Q,).
        force: of the ground there, (P,) [N].

    Returns:
        None if it is not found.
    """
    tree, renewed, scale = problem.tree, problem.renewed, problem.scale
    pose, pushes = tree.pose(q), force > 0
    length, weight = float(scale[0]), float(tree.weight.sum())
    friction = renewed(Rest(q, pose.nodes, force, False), None) if renewed else None
    looked = renewed is None  # whether the contacts are those of this state
    for _ in range(_STEPS):
        gradient, hessian, rise, moves = problem.slopes(q, pose, force, pushes, friction)
        step, down = newton_step(scale[:, None] * hessian * scale, scale * gradient)
        size = float(np.abs(step).max())
        if down < -_RIDGE * weight * length or not size < _LONGEST:
            return None
        step = scale * step
        ahead = pose.nodes[:, 2] + rise @ step
        force = np.where(pushes, force - problem.ground * ahead, 0.0)
        touches = np.where(pushes, force > 0, ahead < -_DEEP * length)
        same = np.array_equal(touches, pushes)
        pushes, force = touches, np.where(touches, force, 0.0)
        if friction is not None and moves is not None:
            after = friction.after(friction.slips(pose.nodes) + moves @ step, _SLACK * size**2)
            same &= np.array_equal(after.holds, friction.holds)
            friction = after
        q = q + step
        if same and looked and size < _STILL:
            return q, force, friction
        pose, looked = tree.pose(q), renewed is None
        if renewed and same and size < _SMALL:
            friction = renewed(Rest(q, pose.nodes, force, True), friction)
            looked = True
    return None


def newton_step(hessian: Array, gradient: Array) -> tuple[Array, float]:
    """Newton's step, (Q,), and the least curvature where it is below 0, else 0.

    Where the energy curves down the step is that as if it curved up as much.
    """
    _, step, failed = dposv(hessian, -gradient)  # by Cholesky's factors
    if not failed:
        return np.asarray(step), 0.0
    values, vectors = eigh(hessian, check_finite=False)
    sizes = np.maximum(np.abs(values), _FLAT * np.abs(values).max())
    step = -vectors @ ((vectors.T @ gradient) / sizes)
    return np.asarray(step), min(float(values[0]), 0.0)
