"""A tree of limbs at rest on the ground: weight, springs of the pneu-nets, nodes that push up.

The least energy over heights that are not below 0, found by an augmented Lagrangian (Hestenes and
Powell): Newton's method with exact second derivatives inside, multipliers outside, which are the
ground's forces in the end. Roll and pitch follow from it like every other angle. Without friction
x, y and yaw stay as they are: the limit of weak friction, as in section 2.2 of [Majidi13].
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve, eigh

from analytic.scene.chain import joint_springs
from analytic.scene.limbs import rotation
from analytic.solvers.limbs.friction import ContactFriction
from analytic.solvers.limbs.kinematics import HEIGHT, IN_PLAN, WHOLE, Pose, Tree

Array = NDArray[np.float64]

_STIFF = 3e4  # of the ground in the Lagrangian: weight over length; chosen
_INNER, _OUTER = 100, 60
_FLAT = 1e-13  # of a direction without stiffness, over the stiffest
_STILL, _STILL_SHARP = 1e-11, 1e-9  # of the gradient, weight times length; sharp friction rounds
_SETTLED, _SETTLED_SHARP = 1e-8, 1e-5  # of forces: weight
_GAIN_SHARP = 1e-16  # of energy, weight times length: less is none
_SHORTEST = 1e-9
_LONGEST = 0.5  # change of an angle in a step [rad]
_SMOOTH, _SHARP, _SHARPER = 1e-3, 1e-7, 0.2  # slips that count beside 0, over the length


class Rest(NamedTuple):
    """A tree at rest.

    Attributes:
        q: its coordinates, see analytic.solvers.limbs.kinematics.
        nodes: places, (P, 3) [m].
        force: of the ground on each, (P,) [N].
        converged: whether forces and heights are those of an equilibrium.
    """

    q: Array
    nodes: Array
    force: Array
    converged: bool


class Statics:
    """Equilibria of a tree.

    Args:
        tree: its links.

    Attributes:
        length: of the robot along its trunk [m].
    """

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        nodes = tree.pose(np.zeros(len(tree.parent))).nodes
        self.length = float(np.ptp(nodes[:, :2] @ rotation(tree.robot.limbs[0].angle)[:, 0]))
        self._weight = float(tree.weight.sum())
        self._scale = np.ones(len(tree.parent))
        self._scale[: HEIGHT + 1] = self.length
        self._ground = _STIFF * self._weight / self.length

    def flat(self) -> Rest:
        """Lying on the ground without pressure."""
        q = np.zeros(len(self.tree.parent))
        return Rest(q, self.tree.pose(q).nodes, self.tree.weight.copy(), True)

    def springs(self, pressures: Array) -> tuple[Array, Array]:
        """Stiffness and rest angle of all hinges at pressures of the limbs, (L,) [Pa]."""
        parts = [
            joint_springs(limb.strip, self.tree.elements, np.array([[pressure]]))
            for limb, pressure in zip(self.tree.robot.limbs, pressures, strict=True)
        ]
        stiffness, rest = (np.concatenate([part[i][0] for part in parts]) for i in (0, 1))
        return stiffness, rest

    def equilibrium(
        self, pressures: Array, guess: Rest, friction: ContactFriction | None = None
    ) -> Rest:
        """The equilibrium near a guess.

        Args:
            pressures: of the limbs, (L,) [Pa].
            guess: of a neighbouring state.
            friction: on the way there; none if None.
        """
        stiffness, rest = self.springs(pressures)
        q, force = guess.q.copy(), guess.force.copy()
        sharpness = _SMOOTH * self.length
        for _ in range(_OUTER):
            q, still = self._minimise(q, force, (stiffness, rest), friction, sharpness)
            pose = self.tree.pose(q)
            new = np.maximum(0.0, force - self._ground * pose.nodes[:, 2])
            change = float(np.abs(new - force).max())
            force = new
            if friction is not None and sharpness > _SHARP * self.length:
                sharpness = max(_SHARPER * sharpness, _SHARP * self.length)
            elif (
                still and change < (_SETTLED if friction is None else _SETTLED_SHARP) * self._weight
            ):
                return Rest(q, pose.nodes, force, True)
        return Rest(q, self.tree.pose(q).nodes, force, False)

    def _minimise(
        self,
        q: Array,
        multiplier: Array,
        springs: tuple[Array, Array],
        friction: ContactFriction | None,
        sharpness: float,
    ) -> tuple[Array, bool]:
        """Newton's method on the Lagrangian at given multipliers."""
        tree, ground, (stiffness, rest) = self.tree, self._ground, springs
        still = (_STILL if friction is None else _STILL_SHARP) * self._weight * self.length

        def energy(at: Array) -> float:
            nodes = tree.pose(at).nodes
            height = nodes[:, 2]
            push = np.maximum(0.0, multiplier - ground * height)
            bent = at[WHOLE:] - rest
            stored = 0.5 * stiffness @ bent**2 + tree.weight @ height + 0.5 * push @ push / ground
            return float(stored) + (friction.cost(nodes, sharpness) if friction else 0.0)

        value = energy(q)
        for _ in range(_INNER):
            pose = tree.pose(q)
            push = np.maximum(0.0, multiplier - ground * pose.nodes[:, 2])
            rise = tree.heights(pose)
            net = tree.weight - push
            gradient = rise.T @ net
            gradient[WHOLE:] += stiffness * (q[WHOLE:] - rest)
            hessian = self._hessian(pose, net, rise[push > 0], stiffness)
            if friction is None:
                gradient[list(IN_PLAN)] = 0.0
                hessian[IN_PLAN, :] = hessian[:, IN_PLAN] = 0.0
                hessian[IN_PLAN, IN_PLAN] = ground
            else:
                pull, stiff = friction.slopes(tree, pose, sharpness)
                gradient, hessian = gradient + pull, hessian + stiff
            gradient *= self._scale
            if np.abs(gradient).max() < still:
                return q, True
            hessian *= self._scale[:, None] * self._scale
            step = -_solved(hessian, gradient)
            step *= min(1.0, _LONGEST / float(np.abs(step).max()))
            fall, part = float(gradient @ step), 1.0
            if friction is not None and -fall < _GAIN_SHARP * self._weight * self.length:
                return q, True
            rounding = 1e-13 * abs(value)
            while (trial := energy(q + part * self._scale * step)) > (
                value + 1e-4 * part * fall + rounding
            ):
                part *= 0.5
                if part < _SHORTEST:
                    return q, False
            q, value = q + part * self._scale * step, trial
        return q, False

    def _hessian(self, pose: Pose, net: Array, pushed: Array, stiffness: Array) -> Array:
        """Hessian of springs, weight and the ground's push, whose nodes rise by `pushed` (., Q)."""
        force = np.zeros_like(pose.nodes)
        force[:, 2] = net
        hessian = self.tree.bending(pose, force) + self._ground * pushed.T @ pushed
        hinges = np.arange(WHOLE, len(hessian))
        hessian[hinges, hinges] += stiffness
        return np.asarray(hessian)


def _solved(hessian: Array, gradient: Array) -> Array:
    """Newton's step; where the energy curves down, as if it curved up as much."""
    try:
        factor = cho_factor(hessian, check_finite=False)
        return np.asarray(cho_solve(factor, gradient, check_finite=False))
    except LinAlgError:
        values, vectors = eigh(hessian, check_finite=False)
        values = np.maximum(np.abs(values), _FLAT * np.abs(values).max())
        return np.asarray(vectors @ ((vectors.T @ gradient) / values))
