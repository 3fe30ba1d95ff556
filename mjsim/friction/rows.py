"""Rows of dry friction that hold one place of a robot in space, as MuJoCo has them."""

import math

import mujoco
import numpy as np

_STIFFER = (
    128.0  # than the tangent: the direction follows within steps and does not swing; measured
)
_VISCOUS = 100.0  # b dt; chosen
_SOFTEST, _FIRMEST = 1e-4, 0.9999  # what MuJoCo takes of a row's firmness
STANDS = 1e-9  # m/s; N: no place is held by less


class Rows:
    """Two rows of dry friction that hold one place.

    Attributes:
        ids: of the tendons.
        way: direction of the first row, (2,).
        body, own: that the place is fast to, and where in its frame along x [m].
        jacobian: of its motion, (3, nv); the coefficients of its motion in plan, (2, J).
        place: in plan, (2,) [m].
        bound, drag: of its friction [N]; its viscous resistance [N s/m].
        inverse_mass: that MuJoCo sees across, in the step before [1/kg].
    """

    def __init__(self, model: mujoco.MjModel, name: str, joints: int) -> None:
        first = model.tendon(f"{name}_0").id
        self.ids = (first, first + 1)
        self._bounds = model.tendon_frictionloss[first : first + 2]
        self._time = model.tendon_solref_fri[first + 1]
        self._firmness = model.tendon_solimp_fri[first + 1]
        self.inverse_mass = float(model.tendon_invweight0[first + 1])
        self._dt = model.opt.timestep
        self._drags = model.tendon_damping[first : first + 2]
        begin = model.tendon_adr[first]
        self._coefficients = model.wrap_prm[begin : begin + 2 * joints].reshape(2, joints)
        self._dofs = model.jnt_dofadr[model.wrap_objid[begin : begin + joints]]
        self.way, self.body, self.own = (1.0, 0.0), 0, 0.0
        self.bound = self.drag = 0.0
        self.place = self.velocity = (0.0, 0.0)
        self.jacobian = np.zeros((3, model.nv))
        self.release()

    def release(self) -> None:
        """Hold nothing."""
        self._bounds[:] = 0.0
        self._drags[:] = 0.0

    def look(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Find its Jacobian and its velocity, where it is now."""
        place = data.xpos[self.body] + self.own * data.xmat[self.body, ::3]
        mujoco.mj_jac(model, data, self.jacobian, None, place, self.body)
        self.place = (place.item(0), place.item(1))
        velocity = self.jacobian @ data.qvel
        self.velocity = (velocity.item(0), velocity.item(1))

    def hold(self, bound: float, drag: float) -> None:
        """Resist by so much [N, N s/m] in the next step."""
        self.bound, self.drag, (c, s) = bound, drag, self.way
        across, along = self.jacobian[:2].take(self._dofs, axis=1)[::-1]
        self._coefficients[0] = c * along + s * across
        self._coefficients[1] = c * across - s * along
        self._bounds[:] = bound
        self._drags[:] = drag
        # the discrete integrator makes of a row f = -D (dv/dt + b v), D = d / (1 - d) / its inverse
        # mass
        # and b = 2 / (d time): with b much above 1 / dt it is viscous, f = -D b v
        firm = (
            _STIFFER
            * bound
            * self.inverse_mass
            * self._dt
            / max(math.hypot(*self.velocity), STANDS)
            / _VISCOUS
        )
        firm = min(max(firm / (1.0 + firm), _SOFTEST), _FIRMEST)
        self._time[0] = 2.0 * self._dt / (firm * _VISCOUS)
        self._firmness[:2] = firm

    def learn(self, firmness: float) -> None:
        """Note how heavy the row across was, from D = d / (1 - d) / inverse mass."""
        part = self._firmness.item(0)
        self.inverse_mass = part / ((1.0 - part) * firmness)

    def excess(self, data: mujoco.MjData, dt: float) -> tuple[float, float, float, float, float]:
        """How far the last step moved it beyond dt times its velocity; its place and its speed."""
        place = data.xpos[self.body] + self.own * data.xmat[self.body, ::3]
        u, v, _ = (self.jacobian @ data.qvel).tolist()
        x, y = place.item(0), place.item(1)
        gone = x - self.place[0] - dt * u, y - self.place[1] - dt * v
        return *gone, x, y, math.hypot(u, v)
