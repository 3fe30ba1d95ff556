"""A tree of limbs at rest on the ground: weight, springs of the pneu-nets, nodes that push up.

The least energy over heights that are not below 0, found by an augmented Lagrangian (Hestenes and
Powell): Newton's method with exact second derivatives inside, multipliers outside, which are the
ground's forces in the end. Roll and pitch follow from it like every other angle. Adhesive ground
pulls at nodes within its reach by constant forces, so that peeling takes adhesion times area.
Without friction x, y and yaw stay as they are: the limit of weak friction, as in section 2.2 of
[Majidi13].
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import joint_springs, torsion_stiffness
from analytic.scene.limbs import chambers_by_limb, rotation
from analytic.solvers.limbs.active_set import Problem, Renewed, newton_step, on_contacts
from analytic.solvers.limbs.friction import ContactFriction
from analytic.solvers.limbs.kinematics import HEIGHT, IN_PLAN, WHOLE, Tree
from analytic.solvers.limbs.rest import Rest

Array = NDArray[np.float64]

_STIFF = 3e4  # of the ground in the Lagrangian: weight over length; chosen
_INNER, _OUTER = 100, 60
_STILL, _STILL_SHARP = 1e-11, 1e-9  # of the gradient, weight times length; sharp friction rounds
_SETTLED, _SETTLED_SHARP = 1e-8, 1e-5  # of forces: weight
_GAIN_SHARP = 1e-16  # of energy, weight times length: less is none
_SHORTEST = 1e-9
_LONGEST = 0.5  # change of an angle in a step [rad]
_TRIES = 4  # to find the contacts of a state that rest on its own forces
_TRIES_BY_SPEED = 12  # and bounds by how fast they slide; measured
_SMOOTH, _SHARP, _SHARPER = 1e-3, 1e-7, 0.05  # slips that count beside 0, over the length


class Statics:
    """Equilibria of a tree.

    Args:
        tree: its links.
        chamber: law of the chambers, see analytic.scene.chain.

    Attributes:
        length: of the robot along its trunk [m].
    """

    def __init__(self, tree: Tree, chamber: str = "linearized") -> None:
        self.tree, self._chamber = tree, chamber
        self._torsion = np.array(
            [[torsion_stiffness(limb.strip, tree.twists)] for limb in tree.robot.limbs]
        )
        nodes = tree.pose(np.zeros(len(tree.parent))).nodes
        self.length = float(np.ptp(nodes[:, :2] @ rotation(tree.robot.limbs[0].angle)[:, 0]))
        self._weight = float((tree.weight + tree.adhesion).sum())
        self._scale = np.ones(len(tree.parent))
        self._scale[: HEIGHT + 1] = self.length
        self._ground = _STIFF * self._weight / self.length

    def flat(self) -> Rest:
        """The tree flat on the ground, without pressure."""
        q = np.zeros(len(self.tree.parent))
        return Rest(q, self.tree.pose(q).nodes, self.tree.weight + self.tree.adhesion, True)

    def springs(self, pressures: Array) -> tuple[Array, Array]:
        """Stiffness and rest angle of all joints at pressures of the chambers, (S,) [Pa]."""
        tree, robot = self.tree, self.tree.robot
        springs = np.zeros((2, len(robot.limbs), tree.elements + tree.twists))
        springs[0][:, tree.twist_places] = self._torsion
        for i, (limb, chambers) in enumerate(
            zip(robot.limbs, chambers_by_limb(robot), strict=True)
        ):
            row = pressures[None, chambers]
            stiffness, rest = joint_springs(limb.strip, tree.elements, row, self._chamber)
            springs[:, i, tree.hinge_places] = stiffness[0], rest[0]
        stiffness, rest = springs.reshape(2, -1)
        return stiffness, rest

    def equilibrium(self, pressures: Array, guess: Rest) -> Rest:
        """The equilibrium without friction near a guess.

        Args:
            pressures: of the chambers, (S,) [Pa].
            guess: of a neighbouring state.
        """
        return self.equilibrium_with_friction(pressures, guess, None)[0]

    def equilibrium_with_friction(
        self, pressures: Array, guess: Rest, renewed: Renewed | None
    ) -> tuple[Rest, ContactFriction | None]:
        """The equilibrium near a guess, and the friction there.

        Args:
            pressures: of the chambers, (S,) [Pa].
            guess: of a neighbouring state.
            renewed: friction by the contacts of a state, from the friction so far, None at first;
                no friction if None.
        """
        stiffness, bent = self.springs(pressures)
        problem = Problem(self.tree, self._scale, self._ground, stiffness, bent, renewed)
        solution = on_contacts(problem, guess.q, guess.force)
        if solution:
            q, force, friction = solution
            return Rest(q, self.tree.pose(q).nodes, force, True), friction
        rest, friction = guess, renewed(guess, None) if renewed else None
        for tried in range(1, _TRIES_BY_SPEED + 1):
            rest = self._least(stiffness, bent, rest, friction)
            if friction is None or renewed is None:
                return rest, friction
            before = friction
            friction = renewed(rest, friction.least(rest.nodes, _SHARP * self.length))
            by_speed = friction.speeds.any()
            if friction.agrees(before) or (tried >= _TRIES and not by_speed):
                return rest, friction
        return rest._replace(converged=False), friction

    def _least(
        self, stiffness: Array, bent: Array, guess: Rest, friction: ContactFriction | None
    ) -> Rest:
        """The state of least energy and dissipation near a guess, from springs and friction."""
        q, sharpness = guess.q.copy(), _SMOOTH * self.length
        lagrangian = _Lagrangian(
            self.tree, self._ground, stiffness, bent, friction, guess.force, sharpness
        )
        settled = (_SETTLED if friction is None else _SETTLED_SHARP) * self._weight
        for _ in range(_OUTER):
            q, still = self._minimise(q, lagrangian)
            nodes = self.tree.pose(q).nodes
            force = lagrangian.push(nodes)
            change = float(np.abs(force - lagrangian.multiplier).max())
            if friction is not None and sharpness > _SHARP * self.length:
                sharpness = max(_SHARPER * sharpness, _SHARP * self.length)
            elif still and change < settled:
                return Rest(q, nodes, force, True)
            lagrangian = lagrangian._replace(multiplier=force, sharpness=sharpness)
        return Rest(q, nodes, force, False)

    def _minimise(self, q: Array, lagrangian: "_Lagrangian") -> tuple[Array, bool]:
        """Newton's method on the Lagrangian at given multipliers; True where it is still."""
        unit, sharp = self._weight * self.length, lagrangian.friction is not None
        still = (_STILL_SHARP if sharp else _STILL) * unit
        energy = lagrangian.energy(q)
        for _ in range(_INNER):
            gradient, hessian = lagrangian.slopes(q)
            gradient *= self._scale
            if np.abs(gradient).max() < still:
                return q, True
            hessian *= self._scale[:, None] * self._scale
            step, _ = newton_step(hessian, gradient)
            step *= min(1.0, _LONGEST / float(np.abs(step).max()))
            fall, part = float(gradient @ step), 1.0
            if sharp and -fall < _GAIN_SHARP * unit:
                return q, True
            step, rounding = self._scale * step, 1e-13 * abs(energy)
            while (trial := lagrangian.energy(q + part * step)) > (
                energy + 1e-4 * part * fall + rounding
            ):
                part *= 0.5
                if part < _SHORTEST:
                    return q, False
            q, energy = q + part * step, trial
        return q, False


class _Lagrangian(NamedTuple):
    """Energy of a tree and its augmented constraints on the ground.

    Attributes:
        tree: its links.
        ground: stiffness of the constraints [N/m].
        stiffness, rest: of the joints' springs [N m/rad, rad].
        friction: on the way there; none if None.
        multiplier: forces of the ground so far, (P,) [N].
        sharpness: of the friction [m].
    """

    tree: Tree
    ground: float
    stiffness: Array
    rest: Array
    friction: ContactFriction | None
    multiplier: Array
    sharpness: float

    def push(self, nodes: Array) -> Array:
        """Forces of the ground on nodes at places (P, 3) [m], (P,) [N]."""
        return np.maximum(0.0, self.multiplier - self.ground * nodes[:, 2])

    def energy(self, q: Array) -> float:
        """Lagrangian at coordinates (Q,) [J]."""
        nodes = self.tree.pose(q).nodes
        push, bent = self.push(nodes), q[WHOLE:] - self.rest
        stored = 0.5 * self.stiffness @ bent**2 + self.tree.weight @ nodes[:, 2]
        stored += self.tree.adhesion @ np.minimum(nodes[:, 2], self.tree.reach)
        stored += 0.5 * push @ push / self.ground
        if self.friction is None:
            return float(stored)
        stored -= (self.tree.pull * nodes[:, :2]).sum()
        return float(stored) + self.friction.cost(nodes, self.sharpness)

    def slopes(self, q: Array) -> tuple[Array, Array]:
        """Gradient, (Q,), and Hessian, (Q, Q), by the coordinates."""
        pose = self.tree.pose(q)
        push, rise = self.push(pose.nodes), self.tree.heights(pose)
        force = np.zeros_like(pose.nodes)
        force[:, 2] = self.tree.down(pose.nodes[:, 2]) - push
        gradient = rise.T @ force[:, 2]
        if self.friction is not None and self.tree.incline.slope:
            gradient -= self.tree.pulled(pose)
            force[:, :2] -= self.tree.pull
        gradient[WHOLE:] += self.stiffness * (q[WHOLE:] - self.rest)
        pushed = rise[push > 0]
        hessian = self.tree.bending(pose, force) + self.ground * pushed.T @ pushed
        joints = np.arange(WHOLE, len(hessian))
        hessian[joints, joints] += self.stiffness
        if self.friction is None:
            gradient[list(IN_PLAN)] = 0.0
            hessian[IN_PLAN, :] = hessian[:, IN_PLAN] = 0.0
            hessian[IN_PLAN, IN_PLAN] = self.ground
            return gradient, hessian
        pull, stiff = self.friction.slopes(self.tree, pose, self.sharpness)
        return gradient + pull, hessian + stiff
