"""Friction at points of a robot in space, as rows of MuJoCo's dry friction, three of each.

A point resists by its bound V as it slips. One that stands for an area also turns: with its slip u,
its turning rate w and the mean distance r of the area from it the limit surface is taken as an
ellipsoid (Howe and Cutkosky 1996),

    power = V |s|,    s = (u_x, u_y, r w),

exact where it only slips and where it only turns. So its traction lies along s: of its rows the
first is laid along s, or along the traction where it does not slide, and the others across.

A row is a tendon over all joints that move the point; its coefficients, set at each step, are the
Jacobian of s along the row. On ground with a nap s is the slip as that scales it, and a constant
force leans on the point besides (see analytic.friction.dissipation_in_plane.Nap). Points that do
not resist have tendons of no joint, which cost MuJoCo nothing. Plain floats and few calls of numpy,
which cost more than the few numbers of a step.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.friction.row_layout import Kind, Layout, Tendons
from mjsim.model.limbs import ROWS

Array = NDArray[np.float64]
Numbers = NDArray[np.int_]
Vector = tuple[float, float, float]
Directions = tuple[float, float, float, float, float, float]  # S by rows, and p [N]

# over the tangent: the direction follows within steps and does not swing; measured
_STIFFER = 128.0
_VISCOUS = 100.0  # b dt; chosen
_SOFTEST, _STIFFEST = 1e-4, 0.9999  # impedances that MuJoCo takes
_WHOLE = 0.999  # of the bound: the contact slides
STANDS = 1e-9  # m/s; N: no point is anchored by less
_AHEAD = (1.0, 0.0, 0.0)
_AHEAD_AND_LEFT = np.array([0, 3, 6, 1, 4, 7])  # of a rotation, by rows
_LEVEL = 1e-6  # of a direction: its part in plan is none


class Point(NamedTuple):
    """A point that resists, on its link.

    Attributes:
        number: its place among all that there may be.
        body: the link.
        along, aside: how far it is from the link's beginning, ahead and to the left [m].
    """

    number: int
    body: int
    along: float
    aside: float


class FrictionRows:
    """The rows of all points that there may be, and the motion of those that touch.

    Args:
        model, data: as compiled.
        names: of the points, before the numbers of their rows.
        joints: how many move each.

    Attributes:
        numbers: places among all of the points that touch in the coming step.
        points: those.
        places: x + i y of them [m].
        speeds: sizes |s| of their slips now [m/s].
        bounds: of their friction [N].
    """

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, names: Sequence[str],
        joints: Sequence[int],
    ) -> None:  # fmt: skip
        self._model, self._data, self._dt = model, data, model.opt.timestep
        self._tendons = [Tendons.of(model, *named) for named in zip(names, joints, strict=True)]
        every = np.array([own.rows for own in self._tendons])
        self._qvel, self._applied = data.qvel, data.qfrc_applied
        self._origins, self._frames = data.xpos.reshape(-1), data.xmat.reshape(-1)  # of links
        self._frictionloss, self._damping = model.tendon_frictionloss, model.tendon_damping
        self._joints, self._joints_of = model.tendon_num, model.tendon_num.copy()
        self._coefficients = model.wrap_prm
        self._times = model.tendon_solref_fri.reshape(-1)
        self._impedances = model.tendon_solimp_fri.reshape(-1)
        self._release(every.ravel())
        # of all points: inverse masses that MuJoCo sees in the rows across, in the step before
        # [1/kg], and directions of the rows, one after the other
        self._inverse_masses: list[list[float]] = model.tendon_invweight0[every[:, 1:]].tolist()
        self._axes = [_axes(*_AHEAD)] * len(names)
        # of those that touch: Jacobians of the rotation and of the place of each, (C, 6, nv)
        self._jacobians = np.zeros((len(names), 6, model.nv))
        self._spaces = [(both[:3], both[3:]) for both in self._jacobians]
        self._at = np.zeros((len(names), 3))  # their places [m]
        self._at_of_each = list(self._at)
        self.points: list[Point] = []
        self._jacobian = self._jacobians[:0].reshape(0, model.nv)
        self.numbers: list[int] = []
        self._before: list[int] = []
        self._bodies: list[int] = []
        self._indices: tuple[Numbers, ...] = ()  # of the links
        self._links: list[tuple[list[float], list[float]]] = []  # their origins and directions
        self._radii: list[float] = []
        self._rates: list[Vector] = []  # (u_x, u_y, r w)
        self._slips: list[Vector] = []  # s
        self._naps: list[Directions] | None = None
        self.places: list[complex] = []
        self.speeds: list[float] = []
        self.bounds: list[float] = []
        self._layout = Layout.of([], self._tendons, model.nv)

    def turn(self) -> None:
        """Lay the first rows along slips or tractions, by the forces of the step before."""
        data, layout = self._data, self._layout
        count = data.nf
        if count != layout.bounded:  # before the first step
            return
        forces, inverse_masses = data.efc_force[:count].tolist(), data.efc_diagA[:count].tolist()
        end, h = 0, 0.0
        for slot, number, rows in layout.in_order:
            begin, end = end, end + rows
            f, g = forces[begin], forces[begin + 1]
            if rows == ROWS:
                h = forces[begin + 2]
                self._inverse_masses[number] = inverse_masses[begin + 1 : end]
            else:
                h = 0.0
                self._inverse_masses[number][0] = inverse_masses[begin + 1]
            size = self.speeds[slot]
            if size > 0 and abs(f) > _WHOLE * self.bounds[slot]:
                x, y, z = self._slips[slot]
            else:
                a, b, c, d, e, _, i, j, k = self._axes[number]
                x, y, z = f * a + g * d + h * i, f * b + g * e + h * j, f * c + h * k
                size = math.hypot(x, y, z)
            if size > 0:
                self._axes[number] = _axes(x / size, y / size, z / size)

    def move_to(self, points: list[Point]) -> None:
        """Take the points that touch in the coming step, with their places now."""
        model, data, count = self._model, self._data, len(points)
        self._before, self.numbers = self.numbers, [point.number for point in points]
        self._jacobian = self._jacobians[:count].reshape(6 * count, model.nv)
        self.points, bodies = points, [point.body for point in points]
        if bodies != self._bodies:
            self._bodies, links = bodies, np.array(bodies, dtype=int)[:, None]
            # of their origins, and of the first two columns of their rotations
            self._indices = 3 * links + np.arange(3), 9 * links + _AHEAD_AND_LEFT
            self._look()
        places = [
            (x + along * a + aside * d, y + along * b + aside * e, z + along * c + aside * f)
            for (_, _, along, aside), ((x, y, z), (a, b, c, d, e, f)) in zip(
                points, self._links, strict=True
            )
        ]
        if places:
            self._at[:count] = places
        self.places = [complex(x, y) for x, y, _ in places]
        for (rotation, move), at, body in zip(self._spaces, self._at_of_each, bodies,
                                              strict=False):  # fmt: skip
            mujoco.mj_jac(model, data, move, rotation, at, body)

    def slip(self, radii: list[float], naps: list[Directions] | None = None) -> None:
        """Take the slips now, by which the rows of points lie that did not touch before.

        Args:
            radii: r of each, 0 of one that cannot turn [m].
            naps: of each, None where all resist alike in all directions.
        """
        self._radii, self._naps, before = radii, naps, self._before
        self._note_rates()
        for number, radius, (u, v, w), speed in zip(
            self.numbers, radii, self._slips, self.speeds, strict=True
        ):
            # it was in the air; or it had an area to turn, which is gone
            if number not in before or (not radius and self._axes[number][2]):
                self._axes[number] = (
                    _axes(u / speed, v / speed, w / speed) if speed > 0 else _axes(*_AHEAD)
                )

    def resist(self, bounds: list[float], drags: list[float], viscosities: list[float]) -> None:
        """Write the rows of the points that touch.

        Args:
            bounds, drags: dry friction and viscous resistance of each [N, N s/m].
            viscosities: of each, whatever resists besides [N s/m].
        """
        self.bounds = bounds
        wet = any(drags)
        kinds: list[Kind] = []
        along: list[float] = []
        viscous: list[float] = []
        forces: list[float] = []
        damping: list[float] = []
        impedances: list[float] = []
        times: list[float] = []
        # the discrete integrator makes of a row f = -D (dv/dt + b v), D = d / (1 - d) / its inverse
        # mass and b = 2 / (d time): with b much above 1 / dt it is viscous, f = -D b v
        stiffness, time = _STIFFER * self._dt / _VISCOUS, 2.0 * self._dt / _VISCOUS
        for number, bound, drag, viscosity, radius, (u, v, w), speed in zip(
            self.numbers, bounds, drags, viscosities, self._radii, self._rates, self.speeds,
            strict=True,
        ):  # fmt: skip
            kinds.append((number, bound > 0, drag > 0, radius > 0))
            x, y, z, a, b, c, i, j, k = self._axes[number]
            along += (radius * z, x, y, radius * c, a, b, radius * k, i, j)
            viscous += (-viscosity * radius * w, -viscosity * u, -viscosity * v)
            forces += (bound, bound, bound if radius else 0.0)
            if wet:
                damping += (drag, drag, drag if radius else 0.0)
            factor = stiffness * bound / (speed if speed > STANDS else STANDS)
            for inverse in self._inverse_masses[number]:
                ratio = factor * inverse
                impedance = ratio / (1.0 + ratio)
                if impedance < _SOFTEST:
                    impedance = _SOFTEST
                elif impedance > _STIFFEST:
                    impedance = _STIFFEST
                impedances.append(impedance)
                times.append(time / impedance)
        if self._naps is not None:
            self._turn_naps(along, viscous)
        layout = self._layout
        if kinds != layout.kinds:
            self._release(layout.rows)
            layout = self._layout = Layout.of(kinds, self._tendons, self._model.nv)
            self._joints[layout.resisting] = self._joints_of[layout.resisting]
        layout.along.reshape(-1)[layout.blocks] = along + viscous
        rows = layout.along.dot(self._jacobian)
        self._applied[:] = rows[-1]
        self._coefficients[layout.coefficients] = rows.reshape(-1)[layout.parts]
        self._frictionloss[layout.rows] = forces
        if wet:
            self._damping[layout.rows] = damping
        self._times[layout.times] = times
        self._impedances[layout.impedances] = impedances + impedances

    def after_step(self) -> list[tuple[float, complex, complex, float]]:
        """Bound, place x + i y, motion beyond dt times its slip, and speed of each [N, m, m/s]."""
        dt, moved = self._dt, []
        self._look()
        self._note_rates()
        for bound, before, (_, _, along, aside), ((x, y, _), (a, b, _, d, e, _)), (u, v, _) in zip(
            self.bounds, self.places, self.points, self._links, self._rates, strict=True
        ):
            place = complex(x + along * a + aside * d, y + along * b + aside * e)
            beyond = place - before - dt * complex(u, v)
            moved.append((bound, place, beyond, math.hypot(u, v)))
        return moved

    def _look(self) -> None:
        """Note where the links of the points that touch are now."""
        origins = self._origins[self._indices[0]].tolist()
        directions = self._frames[self._indices[1]].tolist()
        self._links = list(zip(origins, directions, strict=True))

    def _note_rates(self) -> None:
        """Note slips at the rates now, by the Jacobians of the step's beginning [m/s]."""
        rates = iter(self._jacobian.dot(self._qvel).tolist())
        self._rates = self._slips = [
            (u, v, radius * turning)
            for radius, _, _, turning, u, v, _ in zip(self._radii, *[rates] * 6, strict=True)
        ]
        if self._naps is not None:
            self._slips = [
                (a * u + b * v, c * u + d * v, w)
                for (u, v, w), (a, b, c, d, _, _) in zip(self._rates, self._naps, strict=True)
            ]
        self.speeds = [math.hypot(*slip) for slip in self._slips]

    def _turn_naps(self, along: list[float], viscous: list[float]) -> None:
        """Take rows along s to those along the slip, and add what leans to what is viscous."""
        assert self._naps is not None
        for slot, (a, b, c, d, p, q) in enumerate(self._naps):
            for row in range(9 * slot, 9 * slot + 9, 3):
                x, y = along[row + 1 : row + 3]
                along[row + 1 : row + 3] = a * x + c * y, b * x + d * y
            viscous[3 * slot + 1] += p
            viscous[3 * slot + 2] += q

    def _release(self, rows: Numbers) -> None:
        """Let rows resist by nothing, and be of no joint."""
        self._frictionloss[rows] = 0.0
        self._damping[rows] = 0.0
        self._joints[rows] = 0


def _axes(x: float, y: float, z: float) -> tuple[float, ...]:
    """Three axes at right angles of which the first is given; the second lies in plan."""
    level = math.hypot(x, y)
    if level > _LEVEL:
        a, b = -y / level, x / level
    else:
        a, b = 1.0, 0.0
    return x, y, z, a, b, 0.0, -z * b, z * a, x * b - y * a
