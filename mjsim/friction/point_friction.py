"""Friction of one point of a robot in space, as two rows of MuJoCo's dry friction."""

import math

import mujoco
import numpy as np

# over the tangent: the direction follows within steps and does not swing; measured
_STIFFER = 128.0
_VISCOUS = 100.0  # b dt; chosen
_SOFTEST, _STIFFEST = 1e-4, 0.9999  # impedances that MuJoCo takes
STANDS = 1e-9  # m/s; N: no point is anchored by less


class PointFriction:
    """Two rows of dry friction at one point: along a direction, and across it.

    Attributes:
        ids: of the tendons that the rows are of.
        direction: of the first row, (2,).
        body, offset: link that the point is of, and where it is in its frame along x [m].
        jacobian: of the point's motion, (3, nv).
        place, velocity: of the point in plan, (2,) [m, m/s].
        bound, drag: of its friction [N]; its viscous resistance [N s/m].
        inverse_mass: that MuJoCo sees across, in the step before [1/kg].
    """

    def __init__(self, model: mujoco.MjModel, name: str, joints: int) -> None:
        first = model.tendon(f"{name}_0").id
        self.ids = (first, first + 1)
        self._bounds = model.tendon_frictionloss[first : first + 2]
        self._time = model.tendon_solref_fri[first + 1]
        self._impedance = model.tendon_solimp_fri[first + 1]
        self.inverse_mass = float(model.tendon_invweight0[first + 1])
        self._dt = model.opt.timestep
        self._drags = model.tendon_damping[first : first + 2]
        begin = model.tendon_adr[first]
        self._coefficients = model.wrap_prm[begin : begin + 2 * joints].reshape(2, joints)
        self._dofs = model.jnt_dofadr[model.wrap_objid[begin : begin + joints]]
        self.direction, self.body, self.offset = (1.0, 0.0), 0, 0.0
        self.bound = self.drag = 0.0
        self.place = self.velocity = (0.0, 0.0)
        self.jacobian = np.zeros((3, model.nv))
        self.release()

    def release(self) -> None:
        """Resist by nothing."""
        self._bounds[:] = 0.0
        self._drags[:] = 0.0

    def move_to(self, model: mujoco.MjModel, data: mujoco.MjData, body: int, offset: float) -> None:
        """Take a point of a link, with its Jacobian and its velocity in this state."""
        self.body, self.offset = body, offset
        place = data.xpos[body] + offset * data.xmat[body, ::3]
        mujoco.mj_jac(model, data, self.jacobian, None, place, body)
        self.place = (place.item(0), place.item(1))
        velocity = self.jacobian @ data.qvel
        self.velocity = (velocity.item(0), velocity.item(1))

    def resist(self, bound: float, drag: float) -> None:
        """Set the bound and the viscous resistance of the next step [N, N s/m]."""
        self.bound, self.drag, (c, s) = bound, drag, self.direction
        across, along = self.jacobian[:2].take(self._dofs, axis=1)[::-1]
        self._coefficients[0] = c * along + s * across
        self._coefficients[1] = c * across - s * along
        self._bounds[:] = bound
        self._drags[:] = drag
        # the discrete integrator makes of a row f = -D (dv/dt + b v), D = d / (1 - d) / its inverse
        # mass and b = 2 / (d time): with b much above 1 / dt it is viscous, f = -D b v
        speed = max(math.hypot(*self.velocity), STANDS)
        ratio = _STIFFER * bound * self.inverse_mass * self._dt / speed / _VISCOUS
        impedance = min(max(ratio / (1.0 + ratio), _SOFTEST), _STIFFEST)
        self._time[0] = 2.0 * self._dt / (impedance * _VISCOUS)
        self._impedance[:2] = impedance

    def update_inverse_mass(self, stiffness: float) -> None:
        """Take the inverse mass of the row across from its D = d / (1 - d) / inverse mass."""
        impedance = self._impedance.item(0)
        self.inverse_mass = impedance / ((1.0 - impedance) * stiffness)

    def after_step(self, data: mujoco.MjData, dt: float) -> tuple[complex, complex, float]:
        """Place x + i y, its motion beyond dt times its velocity, and its speed [m, m, m/s]."""
        place = data.xpos[self.body] + self.offset * data.xmat[self.body, ::3]
        u, v, _ = (self.jacobian @ data.qvel).tolist()
        x, y = place.item(0), place.item(1)
        excess = complex(x - self.place[0] - dt * u, y - self.place[1] - dt * v)
        return complex(x, y), excess, math.hypot(u, v)
