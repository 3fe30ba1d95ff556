"""Friction at points of a robot in space, as rows of MuJoCo's dry friction, three of each.

A point resists by its bound V as it slips. One that stands for an area also turns: with its slip u,
its turning rate w and the mean distance r of the area from it the limit surface is taken as an
ellipsoid (Howe and Cutkosky 1996),

    power = V |s|,    s = (u_x, u_y, r w),

exact where it only slips and where it only turns. So its traction lies along s: of its rows the
first is laid along s, or along the traction where it does not slide, and the others across.

A row is a tendon over all joints that move the point; its coefficients, set at each step, are the
Jacobian of s along the row, from MuJoCo's motions of the joints about the robot's centre of mass.
On ground with a nap s is the slip as that scales it, and a constant force leans on the point
besides (see analytic.friction.dissipation_in_plane.Nap). Points that do not resist have tendons of
no joint, which cost MuJoCo nothing. Plain floats and few calls of numpy, which cost more than the
few numbers of a step.
"""

import math
from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.friction.row_layout import Kind, Layout, Tendons
from mjsim.model.bodies.limbs import ROWS

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
_ROUND: Directions = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
_AHEAD_AND_LEFT = np.array([0, 3, 6, 1, 4, 7])  # of a rotation, by rows
_NONE = np.zeros(0, dtype=int)
_LEVEL = 1e-6  # of a direction: its part in plan is none


class FrictionRows:
    """The rows of all points that there may be, and the motion of those that touch.

    Args:
        model, data: as compiled.
        names: of the points, before the numbers of their rows.
        joints: how many move each.

    Attributes:
        numbers: places among all of the points that touch in the coming step.
        bodies: links that they are of.
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
        every = np.array([tendons.rows for tendons in self._tendons])
        self._qvel, self._applied = data.qvel, data.qfrc_applied
        self._origins, self._frames = data.xpos.reshape(-1), data.xmat.reshape(-1)  # of links
        self._frictionloss, self._damping = model.tendon_frictionloss, model.tendon_damping
        self._joints, self._joints_of = model.tendon_num, model.tendon_num.copy()
        self._coefficients = model.wrap_prm
        self._times = model.tendon_solref_fri.reshape(-1)
        self._impedances = model.tendon_solimp_fri.reshape(-1)
        self._release(every.ravel())
        # of all points: inverse masses that MuJoCo sees in the rows across, in the step before
        # [1/kg], and directions of the first rows
        self._inverse_masses: list[list[float]] = model.tendon_invweight0[every[:, 1:]].tolist()
        self._directions = [_AHEAD] * len(names)
        # motions at unit rates of the coordinates, and of the links, about the centre of mass
        self._motions, self._velocities = data.cdof[:, :5].T, data.cvel
        self._moving = _moving(model)  # which of them move which links
        self._moved: Array | None = None  # and which the points of the rows
        self._centre = data.subtree_com[model.body_rootid[model.jnt_bodyid[0]]]
        self.numbers: list[int] = []
        self._before: list[int] = []
        self.bodies: list[int] = []
        self._offsets: list[tuple[float, float]] = []
        self._which = _NONE  # links, as an array
        self._indices: tuple[Numbers, Numbers] = (_NONE, _NONE)  # of numbers of the links
        self._links: list[tuple[list[float], list[float]]] = []  # their origins and directions
        self._arms: list[Vector] = []  # of the points about the centre of mass [m]
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
        end = 0
        for slot, number, rows in layout.in_order:
            begin, end = end, end + rows
            size, (x, y, z) = self.speeds[slot], self._directions[number]
            f, g = forces[begin], forces[begin + 1]
            slides = size > 0 and abs(f) > _WHOLE * self.bounds[slot]
            if rows == ROWS:
                self._inverse_masses[number] = inverse_masses[begin + 1 : end]
                if not slides:
                    h, ((a, b, c), (i, j, k)) = forces[begin + 2], _across(x, y, z)
                    x, y, z = f * x + g * a + h * i, f * y + g * b + h * j, f * z + g * c + h * k
            else:
                self._inverse_masses[number][0] = inverse_masses[begin + 1]
                if not slides:
                    x, y = f * x - g * y, f * y + g * x
            if slides:
                x, y, z = self._slips[slot]
            else:
                size = math.hypot(x, y, z)
            if size > 0:
                self._directions[number] = x / size, y / size, z / size

    def move_to(
        self, numbers: list[int], bodies: list[int], offsets: list[tuple[float, float]]
    ) -> None:
        """Take the points that touch in the coming step, with their places now.

        Args:
            numbers: places of the points among all.
            bodies: link that each is of.
            offsets: how far ahead and to the left of the link's beginning each is [m].
        """
        self._before, self.numbers, self._offsets = self.numbers, numbers, offsets
        if bodies != self.bodies:
            self.bodies, self._which = bodies, np.array(bodies, dtype=int)
            links = self._which[:, None]
            self._moved = None
            # of their origins, and of the first two columns of their rotations
            self._indices = 3 * links + np.arange(3), 9 * links + _AHEAD_AND_LEFT
            self._look()
        x0, y0, z0 = self._centre.tolist()
        self._arms, self.places = [], []
        for (along, aside), ((x, y, z), (a, b, c, d, e, f)) in zip(
            offsets, self._links, strict=True
        ):
            x, y = x + along * a + aside * d, y + along * b + aside * e
            self.places.append(complex(x, y))
            self._arms.append((x - x0, y - y0, z + along * c + aside * f - z0))

    def slip(self, radii: list[float], naps: list[Directions] | None = None) -> None:
        """Take the slips now, by which the rows of points lie that did not touch before.

        Args:
            radii: r of each, 0 of one that cannot turn [m].
            naps: of each, None where all resist alike in all directions.
        """
        self._radii, self._naps, before = radii, naps, self._before
        self.note_rates()
        for number, radius, (u, v, w), speed in zip(
            self.numbers, radii, self._slips, self.speeds, strict=True
        ):
            # it was in the air; or it had an area to turn, which is gone
            if number not in before or (not radius and self._directions[number][2]):
                self._directions[number] = (
                    (u / speed, v / speed, w / speed) if speed > 0 else _AHEAD
                )

    def resist(self, bounds: list[float], drags: list[float], viscosities: list[float]) -> None:
        """Write the rows of the points that touch.

        Args:
            bounds, drags: dry friction and viscous resistance of each [N, N s/m].
            viscosities: of each, whatever resists besides [N s/m].
        """
        self.bounds = bounds
        kinds: list[Kind] = []
        rows: list[float] = []  # torques about the vertical and level ones, forces along x and y
        viscous: list[float] = []
        forces: list[float] = []
        damping: list[float] = []
        impedances: list[float] = []
        times: list[float] = []
        # the discrete integrator makes of a row f = -D (dv/dt + b v), D = d / (1 - d) / its inverse
        # mass and b = 2 / (d time): with b much above 1 / dt it is viscous, f = -D b v
        stiffness, time = _STIFFER * self._dt / _VISCOUS, 2.0 * self._dt / _VISCOUS
        for number, bound, drag, viscosity, radius, (dx, dy, dz), nap, (u, v, w), speed in zip(
            self.numbers, bounds, drags, viscosities, self._radii, self._arms,
            self._naps or [_ROUND] * len(bounds), self._rates, self.speeds, strict=True,
        ):  # fmt: skip
            kinds.append((number, bound > 0, drag > 0, radius > 0))
            x, y = -viscosity * u, -viscosity * v
            if nap is not _ROUND:
                x, y = x + nap[4], y + nap[5]
            viscous += (-dz * y, dz * x, dx * y - dy * x - viscosity * radius * w, x, y)
            if not (bound or drag):
                continue
            x, y, z = self._directions[number]
            if not radius and nap is _ROUND:
                a, b, c = dx * y - dy * x, dx * x + dy * y, dz
                rows += (-c * y, c * x, a, x, y, -c * x, -c * y, b, -y, x)
                forces += (bound, bound)
                damping += (drag, drag)
            else:
                for i, j, k in ((x, y, z), *_across(x, y, z)[: 2 if radius else 1]):
                    a, b, c, d, _, _ = nap
                    x, y = a * i + c * j, b * i + d * j
                    rows += (-dz * y, dz * x, dx * y - dy * x + radius * k, x, y)
                    forces.append(bound)
                    damping.append(drag)
            factor = stiffness * bound / (speed if speed > STANDS else STANDS)
            inverses = self._inverse_masses[number]
            for inverse in inverses if radius else inverses[:-1]:
                ratio = factor * inverse
                impedance = ratio / (1.0 + ratio)
                if impedance < _SOFTEST:
                    impedance = _SOFTEST
                elif impedance > _STIFFEST:
                    impedance = _STIFFEST
                impedances.append(impedance)
                times.append(time / impedance)
        layout = self._layout
        if kinds != layout.kinds:
            self._release(layout.rows)
            layout = self._layout = Layout.of(kinds, self._tendons, self._model.nv)
            self._joints[layout.rows] = self._joints_of[layout.rows]
            self._moved = None
        if self._moved is None:
            self._moved = self._moving[self._which[layout.points]]
        motions = np.array(rows + viscous).reshape(-1, 5).dot(self._motions)
        motions *= self._moved
        np.add.reduce(motions[len(layout.rows) :], out=self._applied)
        self._coefficients[layout.coefficients] = motions.reshape(-1)[layout.parts]
        self._frictionloss[layout.rows] = forces
        if any(drags):
            self._damping[layout.rows] = damping
        self._times[layout.times] = times
        self._impedances[layout.impedances] = impedances + impedances

    def after_step(self) -> list[tuple[float, complex, complex, float]]:
        """Bound, place x + i y, motion beyond dt times its slip, and speed of each [N, m, m/s]."""
        dt, moved = self._dt, []
        self._look()
        for bound, before, (along, aside), ((x, y, _), (a, b, _, d, e, _)), (u, v, _) in zip(
            self.bounds, self.places, self._offsets, self._links, self._rates, strict=True
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

    def note_rates(self) -> None:
        """Note slips at the rates now, the places being those that MuJoCo saw last [m/s]."""
        mujoco.mj_comVel(self._model, self._data)
        self._rates = self._slips = [
            (u + q * z - r * y, v + r * x - p * z, radius * r)
            for (p, q, r, u, v, _), (x, y, z), radius in zip(
                self._velocities[self._which].tolist(), self._arms, self._radii, strict=True
            )
        ]
        if self._naps is not None:
            self._slips = [
                (a * u + b * v, c * u + d * v, w)
                for (u, v, w), (a, b, c, d, _, _) in zip(self._rates, self._naps, strict=True)
            ]
        self.speeds = [math.hypot(*slip) for slip in self._slips]

    def _release(self, rows: Numbers) -> None:
        """Let rows resist by nothing, and be of no joint."""
        self._frictionloss[rows] = 0.0
        self._damping[rows] = 0.0
        self._joints[rows] = 0


def _across(x: float, y: float, z: float) -> tuple[Vector, Vector]:
    """Two axes at right angles to a direction and to each other, of which the first is in plan."""
    level = math.hypot(x, y)
    a, b = (-y / level, x / level) if level > _LEVEL else (1.0, 0.0)
    return (a, b, 0.0), (-z * b, z * a, x * b - y * a)


def _moving(model: mujoco.MjModel) -> Array:
    """1 of the coordinates that move each body, else 0, (B, nv)."""
    moving = np.zeros((model.nbody, model.nv))
    for body in range(1, model.nbody):  # those that carry others come first
        moving[body] = moving[model.body_parentid[body]]
        moving[body, model.dof_bodyid == body] = 1.0
    return moving
