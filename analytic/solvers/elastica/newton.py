"""Equilibria of the heavy chain on the ground: Newton's method, contact and stability.

The chain of analytic.scene.chain at rest: N + 1 rigid links in a plane, N hinges with the springs
of the pneu-net laws, the weight of each link at its middle, and nodes (the links' ends) that the
ground may push up. With direction theta_i, internal vertical force V_i and horizontal tension H of
link i, height y_k and ground force f_k of node k,

    moments      m_i - m_{i+1} = V_i l_i cos(theta_i) - H l_i sin(theta_i),
                 m_i = k_i (theta_i - theta_{i-1} - r_i)
    kinematics   y_{i+1} - y_i = l_i sin(theta_i)
    nodes        W_k + V_{k-1} - V_k = f_k,    y_k >= 0, f_k >= 0, y_k f_k = 0.

Newton's method on (y_k, theta_k, V_k), a banded system, so that its cost is linear in the links.
Dimensionless: lengths over L, moments over D0 / L, forces over D0 / L^2.
"""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgbsv

from analytic.scene import pneunet
from analytic.scene.chain import (
    check_chamber,
    joint_springs,
    link_lengths,
    payload_on_nodes,
    sealed_springs,
)
from analytic.scene.feet import drops
from analytic.scene.robot import Robot
from analytic.scene.surface import Surface
from analytic.solvers.elastica.stability import stable
from analytic.solvers.elastica.state import ChainState, GroundTraction, Mask

Array = NDArray[np.float64]

_CONVERGED = 1e-10  # change of an angle in a Newton step that need not be made [rad]
_SETTLED = 0.05  # change below which the contact set may be revised [rad]
_ITERATIONS = 40
_ROUNDING = 1e-11  # of heights over L


class Chain:
    """The chain of one robot, loaded by one state of pressure at a time.

    Args:
        robot: the strip.
        links: N.
        chamber: law of the chambers, see analytic.scene.chain.
        clamped: fix the first node and the direction of the first link, which is that of the
            strip's end, and take the ground away: a heavy cantilever, to verify the rest by.
        slope: angle by which the ground rises towards +x [rad].
        surface: whose adhesion pulls at nodes within its reach, by constant forces, so that peeling
            a length off takes adhesion times its area.

    Attributes:
        iterations: Newton steps so far.
        floor: height of the nodes where they touch, over L: of an end on a foot that stands proud.
    """

    def __init__(
        self,
        robot: Robot,
        links: int,
        chamber: str = "linearized",
        clamped: bool = False,
        slope: float = 0.0,
        surface: Surface | None = None,
    ) -> None:
        check_chamber(robot, links, chamber)
        self.robot, self.links = robot, links
        self.chamber, self.clamped = chamber, clamped
        self._d0 = pneunet.base_rigidity(robot)
        self.force_unit = self._d0 / robot.length**2
        self.length = link_lengths(robot, links) / robot.length
        half = 0.5 * self.length * robot.weight_per_length * robot.length / self.force_unit
        strip_weight = np.zeros(links + 2)
        strip_weight[:-1] += half
        strip_weight[1:] += half
        self.weight = strip_weight + payload_on_nodes(robot, links) / self.force_unit
        # the weight's part downhill adds to the tension of the tractions
        self.hanging = math.sin(slope) * np.cumsum(self.weight)[:-1]
        self.adhesion, self.reach = np.zeros(links + 2), 0.0
        if surface and surface.adhesion:
            self.reach = surface.adhesion_reach / robot.length
            per_weight = surface.press(robot.width) / robot.weight_per_length
            self.adhesion = per_weight * strip_weight
        self.weight *= math.cos(slope)
        self.floor = np.zeros(links + 2)
        self.floor[[0, -1]] = np.array(drops(robot.feet)) / robot.length
        self.stiffness, self.rest = np.zeros(links), np.zeros(links)
        self.pressure = np.zeros(len(robot.segments))
        self.iterations = 0
        self._least_force = -_ROUNDING * self.weight.sum()
        # general band storage: entry (i, j) at [kl + ku + i - j, j], kl = ku = 3
        self._band = np.zeros((10, 3 * links + 4), order="F")
        self._band[5, 3::3] = 1.0  # kinematics, row 3 i + 2
        self._band[8, 0:-1:3] = -1.0
        self._damping: tuple[float, Array] | None = None

    def flat(self) -> ChainState:
        """The strip without pressure on the ground, or sticking out from the wall."""
        n = self.links
        active = np.ones(n + 2, bool)
        active[1:] = not self.clamped
        zero = np.zeros(n + 1)
        return ChainState(np.zeros(n + 2), zero, zero, active, zero, 0.0, active)

    def load_at(self, pressure: Array) -> None:
        """Set the hinges from segment pressures, shape (S,) [Pa]."""
        stiffness, rest = joint_springs(self.robot, self.links, pressure[None, :], self.chamber)
        self.stiffness, self.rest = stiffness[0] * (self.robot.length / self._d0), rest[0]
        self.pressure = pressure

    def hinges(self, theta: Array) -> tuple[Array, Array]:
        """Stiffness and rest angle of the hinges' springs, or of the tangents to a chamber law."""
        stiffness, rest = self.stiffness, self.rest
        if self.chamber == "sealed":
            tangent, rest = sealed_springs(self.robot, self.links, self.pressure, np.diff(theta))
            stiffness = tangent * (self.robot.length / self._d0)
        if self._damping is None:
            return stiffness, rest
        drag, turn = self._damping
        return (1 + drag) * stiffness, (rest + drag * turn) / (1 + drag)

    def damp(self, drag: float, state: ChainState | None = None) -> None:
        """Let the hinges resist turning from a state, at drag times their stiffness; 0 ends it."""
        self._damping = (drag, np.diff(state.theta)) if drag and state else None

    def equilibrium(
        self, guess: ChainState, traction: GroundTraction | None = None
    ) -> ChainState | None:
        """The stable equilibrium that Newton's method finds from a guess, or None.

        Args:
            guess: near it; without traction its tension stays as it is.
            traction: of the ground, which then decides tension and place.
        """
        state, revisions, updates, before = guess, 0, 0, 0.0
        most = traction.updates if traction else 0
        for _ in range(_ITERATIONS + most):
            new = self._newton(state, traction)
            if new is None:
                return None
            change = float(np.abs(new.theta - state.theta).max())
            if not change < 1.0:
                return None
            state = new
            # steps shrink as the squares of those before, so that the next would change by less
            left, before = change * (change / before) ** 2 if before else math.inf, change
            if change > _SETTLED:
                continue
            revised = self._revise(state, revisions)
            if revised is not None:
                revisions, before = revisions + 1, 0.0
                state = revised
                continue
            if traction is not None and change > traction.balanced:
                continue
            if traction is not None and updates < most and not traction.update(state):
                updates, before = updates + 1, 0.0
            elif min(change, left) < _CONVERGED:
                return state if stable(self, state, traction) else None
        return None

    def _newton(self, state: ChainState, traction: GroundTraction | None) -> ChainState | None:
        """One step for the active nodes, all unknowns at once."""
        self.iterations += 1
        cosine, sine = self.length * np.cos(state.theta), self.length * np.sin(state.theta)
        stiffness, rest = self.hinges(state.theta)
        turn = stiffness * rest
        tension = state.tension + self.hanging
        geometric = state.shear * sine + tension * cosine
        free = (~state.active).astype(float)
        band = self._band.copy(order="F")
        # nodes, row 3 k: y_k = 0, or V_k - V_{k-1} = W_k
        band[6, 0::3] = state.active
        band[4, 2::3] = free[:-1]  # V_k in the row of node k
        band[7, 2::3] = -free[1:]  # V_k in the row of node k + 1
        # moments, row 3 i + 1
        diagonal = geometric.copy()
        diagonal[:-1] += stiffness
        diagonal[1:] += stiffness
        band[6, 1::3] = diagonal
        band[9, 1:-3:3] = band[3, 4::3] = -stiffness
        band[5, 2::3] = band[7, 1::3] = -cosine
        columns = traction.tensions() if traction else np.zeros((len(sine), 0))
        right = np.zeros((band.shape[1], 1 + columns.shape[1]), order="F")
        right[0::3, 0] = self._down(state) * free + self.floor * state.active
        pulling = self.hanging if traction else tension
        moment = geometric * state.theta - pulling * sine
        moment[:-1] -= turn
        moment[1:] += turn
        right[1::3, 0] = moment
        right[2::3, 0] = sine - cosine * state.theta
        right[1::3, 1:] = -columns * sine[:, None]
        if self.clamped:
            band[[6, 3, 5], [1, 4, 2]], right[1] = (1.0, 0.0, 0.0), 0.0
        _, _, x, info = dgbsv(3, 3, band, right, overwrite_ab=True, overwrite_b=True)
        if info != 0:
            return None
        new = state._replace(y=x[0::3, 0], theta=x[1::3, 0], shear=x[2::3, 0])
        if traction is None:
            return new
        more = state._replace(y=x[0::3, 1:], theta=x[1::3, 1:], shear=x[2::3, 1:], tension=columns)
        return traction.resolve(state, new, more)

    def ground_force(self, state: ChainState) -> Array:
        """Force of the ground on each node, shape (N + 2,)."""
        force = self._down(state).copy()
        force[1:] += state.shear
        force[:-1] -= state.shear
        return np.asarray(force * state.active)

    def _down(self, state: ChainState) -> Array:
        """Weight and adhesion on each node."""
        return self.weight + self.adhesion * state.near if self.reach else self.weight

    def _revise(self, state: ChainState, revisions: int) -> ChainState | None:
        """The state with other nodes active or pulled, or None if these are right."""
        active = None if self.clamped else self._other_nodes(state, revisions)
        if self.reach:
            near = state.active | (state.y - self.floor < self.reach)
            if (near != state.near).any():
                return state._replace(near=near, active=state.active if active is None else active)
        return None if active is None else state._replace(active=active)

    def _other_nodes(self, state: ChainState, revisions: int) -> Mask | None:
        """Other active nodes, or None if these are right; one at a time after many tries."""
        gap = state.y - self.floor
        sinking = (gap < -_ROUNDING) & ~state.active
        force = self.ground_force(state)
        pulled = force < self._least_force
        if not (sinking.any() or pulled.any()):
            return None
        if revisions < 8:
            return np.asarray((state.active | sinking) & ~pulled)
        active = state.active.copy()
        if sinking.any():
            active[int(np.argmin(np.where(sinking, gap, 0.0)))] = True
        else:
            active[int(np.argmin(force))] = False
        return active

    def residual(self, state: ChainState) -> float:
        """Largest violation of contact and balance, heights over L, forces over the weight."""
        total = self.weight.sum()
        force = self.ground_force(state) / total
        moment = np.zeros(self.links + 2)
        stiffness, rest = self.hinges(state.theta)
        moment[1:-1] = stiffness * (np.diff(state.theta) - rest)
        cosine, sine = self.length * np.cos(state.theta), self.length * np.sin(state.theta)
        torque = (
            moment[:-1] - moment[1:] - state.shear * cosine + (state.tension + self.hanging) * sine
        )
        kinematic = np.diff(state.y) - sine
        pulled = self.adhesion @ state.near / total
        gap = state.y - self.floor
        parts = (-gap, -force, np.abs(force * gap), np.abs(torque) / total,
                 np.abs(kinematic), [abs(force.sum() - 1 - pulled)])  # fmt: skip
        return max(float(np.max(part)) for part in parts)
