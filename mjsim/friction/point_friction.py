"""Friction of one contact of a robot in space, as rows of MuJoCo's dry friction.

A contact with area resists by its bound V as it slips and turns about its middle: with the slip u
of its middle, its turning rate w and its mean distance r from the middle the limit surface is taken
as an ellipsoid (Howe and Cutkosky 1996),

    power = V |s|,    s = (u_x, u_y, r w),

exact where it only slips and where it only turns. So its traction lies along s, in three rows.
"""

import math

import mujoco
import numpy as np

from mjsim.model.limbs import ROWS

Slip = tuple[float, float, float]

# over the tangent: the direction follows within steps and does not swing; measured
_STIFFER = 128.0
_VISCOUS = 100.0  # b dt; chosen
_SOFTEST, _STIFFEST = 1e-4, 0.9999  # impedances that MuJoCo takes
STANDS = 1e-9  # m/s; N: no contact is anchored by less
AHEAD = (1.0, 0.0, 0.0)
_LEVEL = 1e-6  # of a direction: its part in plan is none


class PointFriction:
    """Rows of dry friction of one contact: along a direction of s, and across it.

    Attributes:
        ids: of the tendons that the rows are of.
        axes: directions of the rows, the first along the slip, each a part of s.
        body, offset: link that its middle is of, and where that is in its frame along x [m].
        radius: r [m].
        jacobian: of s, (3, nv).
        place, velocity: of the middle in plan, (2,) [m]; s [m/s].
        bound, drag: of its friction [N]; its viscous resistance [N s/m].
        inverse_mass: that MuJoCo sees in the rows across, in the step before [1/kg].
    """

    def __init__(self, model: mujoco.MjModel, name: str, joints: int) -> None:
        first = model.tendon(f"{name}_0").id
        self.ids = tuple(range(first, first + ROWS))
        rows, across = slice(first, first + ROWS), slice(first + 1, first + ROWS)
        self._bounds = model.tendon_frictionloss[rows]
        self._times = model.tendon_solref_fri[across, 0]
        self._impedances = model.tendon_solimp_fri[across, :2]
        self.inverse_mass: list[float] = model.tendon_invweight0[across].tolist()
        self._dt = model.opt.timestep
        self._drags = model.tendon_damping[rows]
        begin = model.tendon_adr[first]
        self._coefficients = model.wrap_prm[begin : begin + ROWS * joints].reshape(ROWS, joints)
        self._dofs = model.jnt_dofadr[model.wrap_objid[begin : begin + joints]]
        self.axes = _axes(AHEAD)
        self.body, self.offset, self.radius = 0, 0.0, 0.0
        self.bound = self.drag = 0.0
        self.place, self.velocity = (0.0, 0.0), (0.0, 0.0, 0.0)
        self.jacobian, self._turning = np.zeros((3, model.nv)), np.zeros((3, model.nv))
        self.release()

    def release(self) -> None:
        """Resist by nothing."""
        self._bounds[:] = 0.0
        self._drags[:] = 0.0

    def move_to(
        self, model: mujoco.MjModel, data: mujoco.MjData, body: int, offset: float, radius: float
    ) -> None:
        """Take a place on a link, with the Jacobian and the value of s in this state."""
        self.body, self.offset, self.radius = body, offset, radius
        place = data.xpos[body] + offset * data.xmat[body, ::3]
        turning = self._turning if radius else None
        mujoco.mj_jac(model, data, self.jacobian, turning, place, body)
        self.jacobian[2] = radius * self._turning[2]
        self.place = (place.item(0), place.item(1))
        u, v, w = (self.jacobian @ data.qvel).tolist()
        self.velocity = (u, v, w)
        if not radius and self.axes[0][2]:  # it had an area, which is gone
            self.turn(AHEAD)
            self.turn(self.velocity)

    def turn(self, slip: Slip) -> None:
        """Lay the first row along a slip, or along a traction; as they are if it is none."""
        size = math.hypot(*slip)
        if size > 0:
            x, y, z = slip
            self.axes = _axes((x / size, y / size, z / size))

    def resist(self, bound: float, drag: float) -> None:
        """Set the bound and the viscous resistance of the next step [N, N s/m]."""
        self.bound, self.drag = bound, drag
        self._coefficients[:] = np.array(self.axes) @ self.jacobian.take(self._dofs, axis=1)
        # one that cannot turn has no row for it, and its slip is in plan
        rows = ROWS if self.radius else ROWS - 1
        self._bounds[:rows], self._bounds[rows:] = bound, 0.0
        self._drags[:rows] = drag
        # the discrete integrator makes of a row f = -D (dv/dt + b v), D = d / (1 - d) / its inverse
        # mass and b = 2 / (d time): with b much above 1 / dt it is viscous, f = -D b v
        speed = max(math.hypot(*self.velocity), STANDS)
        factor = _STIFFER * bound * self._dt / speed / _VISCOUS
        for row, inverse in enumerate(self.inverse_mass):
            ratio = factor * inverse
            impedance = min(max(ratio / (1.0 + ratio), _SOFTEST), _STIFFEST)
            self._times[row] = 2.0 * self._dt / (impedance * _VISCOUS)
            self._impedances[row] = impedance

    def update_inverse_mass(self, row: int, stiffness: float) -> None:
        """Take the inverse mass of a row across from its D = d / (1 - d) / inverse mass."""
        impedance = self._impedances.item(row - 1, 0)
        self.inverse_mass[row - 1] = impedance / ((1.0 - impedance) * stiffness)

    def after_step(self, data: mujoco.MjData, dt: float) -> tuple[complex, complex, float]:
        """Place x + i y, its motion beyond dt times its velocity, and its speed [m, m, m/s]."""
        place = data.xpos[self.body] + self.offset * data.xmat[self.body, ::3]
        u, v, _ = (self.jacobian @ data.qvel).tolist()
        x, y = place.item(0), place.item(1)
        excess = complex(x - self.place[0] - dt * u, y - self.place[1] - dt * v)
        return complex(x, y), excess, math.hypot(u, v)


def _axes(first: Slip) -> tuple[Slip, Slip, Slip]:
    """Three axes at right angles of which the first is given; the second lies in plan."""
    x, y, z = first
    level = math.hypot(x, y)
    a, b = (-y / level, x / level) if level > _LEVEL else (1.0, 0.0)
    return first, (a, b, 0.0), (-z * b, z * a, x * b - y * a)
