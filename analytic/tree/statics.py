"""A tree of limbs at rest on the ground: weight, springs of the pneu-nets, nodes that push up.

The least energy over heights that are not below 0, found by an augmented Lagrangian (Hestenes and
Powell): Newton's method with exact second derivatives inside, multipliers outside, which are the
ground's forces in the end. Roll and pitch follow from it like every other angle. Friction bends
nothing: the limit of weak friction, as in section 2.2 of [Majidi13].
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from analytic.chain import joint_springs
from analytic.tree.kinematics import WHOLE, Tree

Array = NDArray[np.float64]

_STIFF = 3e4  # of the ground in the Lagrangian: weight over length; chosen
_INNER, _OUTER = 100, 60
_FLAT = 1e-9  # of a direction without stiffness, over the stiffest
_STILL = 1e-11  # of the gradient: weight times length
_SETTLED = 1e-8  # of forces: weight
_SHORTEST = 1e-9
_LONGEST = 0.5  # change of an angle in a step [rad]


class Rest(NamedTuple):
    """A tree at rest.

    Attributes:
        q: its coordinates, see analytic.tree.kinematics.
        nodes: places, (P, 3) [m]; x, y and yaw as in the first pose.
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
        iterations: Newton steps so far.
    """

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        nodes = tree.pose(np.zeros(len(tree.parent))).nodes
        self._length = float(np.ptp(nodes[:, 0]))
        self._weight = float(tree.weight.sum())
        self._scale = np.ones(len(tree.parent))
        self._scale[0] = self._length
        self._ground = _STIFF * self._weight / self._length
        self.iterations = 0

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

    def equilibrium(self, pressures: Array, guess: Rest) -> Rest:
        """The equilibrium near a guess.

        Args:
            pressures: of the limbs, (L,) [Pa].
            guess: of a neighbouring state.
        """
        stiffness, rest = self.springs(pressures)
        q, force = guess.q.copy(), guess.force.copy()
        for _ in range(_OUTER):
            q, still = self._minimise(q, force, stiffness, rest)
            pose = self.tree.pose(q)
            new = np.maximum(0.0, force - self._ground * pose.nodes[:, 2])
            change = float(np.abs(new - force).max())
            force = new
            if still and change < _SETTLED * self._weight:
                return Rest(q, pose.nodes, force, True)
        return Rest(q, self.tree.pose(q).nodes, force, False)

    def _minimise(
        self, q: Array, multiplier: Array, stiffness: Array, rest: Array
    ) -> tuple[Array, bool]:
        """Newton's method on the Lagrangian at given multipliers."""
        tree, ground = self.tree, self._ground
        still = _STILL * self._weight * self._length

        def energy(at: Array) -> float:
            height = tree.pose(at).nodes[:, 2]
            push = np.maximum(0.0, multiplier - ground * height)
            bent = at[WHOLE:] - rest
            return float(
                0.5 * stiffness @ bent**2 + tree.weight @ height + 0.5 * push @ push / ground
            )

        now = energy(q)
        for _ in range(_INNER):
            pose = tree.pose(q)
            push = np.maximum(0.0, multiplier - ground * pose.nodes[:, 2])
            rise = tree.heights(pose)
            net = tree.weight - push
            gradient = rise.T @ net
            gradient[WHOLE:] += stiffness * (q[WHOLE:] - rest)
            gradient *= self._scale
            if np.abs(gradient).max() < still:
                return q, True
            held = rise[push > 0]
            hessian = tree.bending(pose, net) + ground * held.T @ held
            hessian[np.arange(WHOLE, len(q)), np.arange(WHOLE, len(q))] += stiffness
            hessian *= self._scale[:, None] * self._scale
            values, vectors = eigh(hessian, check_finite=False)
            values = np.maximum(np.abs(values), _FLAT * np.abs(values).max())
            step = -vectors @ ((vectors.T @ gradient) / values)
            step *= min(1.0, _LONGEST / float(np.abs(step).max()))
            fall, part = float(gradient @ step), 1.0
            self.iterations += 1
            rounding = 1e-13 * abs(now)
            while (then := energy(q + part * self._scale * step)) > (
                now + 1e-4 * part * fall + rounding
            ):
                part *= 0.5
                if part < _SHORTEST:
                    return q, False
            q, now = q + part * self._scale * step, then
        return q, False
