"""Friction of a robot of limbs: each contact is held at its place by a bound in the plane.

Contacts and their bounds are those of analytic.solvers.limbs.contacts, found from the forces of the
step before. A place is held by two rows: dry friction of the whole bound V along the slip, or along
the force where it does not slide, and across that V v / |u|, where u is the slip of the step
before: together the tangent of V u / |u|, as in Newton's method, so that friction opposes the slip
whatever its direction. What the bounds leave open is left to viscosity at all places alike, as in
analytic.friction.dissipation_in_plane; it is small beside them.
"""

import math
from bisect import bisect_right
from collections.abc import Iterator

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.solvers.limbs.contacts import Contact, Contacts
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.statics import Rest
from mjsim.model.limbs import joints_to, limb_body, places_of
from mjsim.model.parts import PREFIX
from mjsim.scene.limbs import TreeNumerics, TreeScene

Array = NDArray[np.float64]

_WHOLE = 0.999  # of the bound: the place slides
_STIFFER = (
    128.0  # than the tangent: the direction follows within steps and does not swing; measured
)
_VISCOUS = 100.0  # b dt; chosen
_SOFTEST, _FIRMEST = 1e-4, 0.9999  # what MuJoCo takes of a row's firmness
_AHEAD = (1.0, 0.0)
_FAINT = 0.005  # of all bounds and drags, that viscosity adds at most; chosen
_STANDS = 1e-9  # m/s; N: no place is held by less
_POINT = 1e-8  # m^2; places that are closer do not tell a turn


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
            / max(math.hypot(*self.velocity), _STANDS)
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


class Grips:
    """The rows of friction, set before each step.

    Args:
        scene, numerics: what is simulated.
        model, data: as compiled.

    Attributes:
        contacts: of the last state that was looked at.
    """

    def __init__(
        self,
        scene: TreeScene,
        numerics: TreeNumerics,
        model: mujoco.MjModel,
        data: mujoco.MjData,
    ) -> None:
        self._model, self._data, self._numerics = model, data, numerics
        self._ground, robot = scene.ground, scene.robot
        self._tree = Tree(robot, numerics.elements)
        self._finder = Contacts(self._tree, scene.friction)
        self.contacts: list[Contact] = []
        self._held: list[Rows] = []
        self._rows = [
            [
                Rows(model, f"{PREFIX}{name}_hold_{place}",
                     len(joints_to(robot, numerics.elements, i)))
                for place in range(places_of(robot, i))
            ]
            for i, name in enumerate(robot.names)
        ]  # fmt: skip
        self._by_tendon = {
            tendon: (own, row)
            for limb in self._rows for own in limb for row, tendon in enumerate(own.ids)
        }  # fmt: skip
        self._links = [
            [model.body(limb_body(name, i)).id for i in range(numerics.elements + 1)]
            for name in robot.names
        ]
        self._starts = [starts.tolist() for starts in self._tree.starts]
        self._pads, self._node_of_geom = _pads_of(model, robot.names, numerics.elements + 2)
        mass = robot.weight / scene.gravity
        self._viscosity = mass / numerics.tie_time  # of all places together [N s/m]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)

    def before_step(self, pressures: Array) -> None:
        """Read the contacts, and set what resists in the next step.

        Places of the state now, forces of the step before.

        Args:
            pressures: of the limbs, (L,) [Pa].
        """
        model, data, held = self._model, self._data, []
        self.contacts = self._finder.find(self._rest(), pressures)
        self._turn()
        for rows in self._held:
            rows.release()
        applied = np.zeros(model.nv)
        for contact, at, rows in self._places():
            starts = self._starts[contact.limb]
            link = min(bisect_right(starts, at), len(starts)) - 1
            rows.body, rows.own = self._links[contact.limb][link], at - starts[link]
            rows.look(model, data)
            if rows not in self._held:
                pace = math.hypot(*rows.velocity)
                rows.way = (rows.velocity[0] / pace, rows.velocity[1] / pace) if pace else _AHEAD
            rows.hold(*self._finder.resistance(contact, self._ground.at(rows.place[0])))
            held.append(rows)
        share = self._viscous(held)
        for rows in held:
            u, v = rows.velocity
            applied -= (share * u) * rows.jacobian[0] + (share * v) * rows.jacobian[1]
        data.qfrc_applied[:] = applied
        self._held = held

    def _viscous(self, held: list[Rows]) -> float:
        """Resistance of each place to what the bounds leave open [N s/m]."""
        bound, drag = sum(rows.bound for rows in held), sum(rows.drag for rows in held)
        pace = max((math.hypot(*rows.velocity) for rows in held), default=0.0)
        whole = self._viscosity
        if bound > 0.0 or drag > 0.0:
            whole = min(whole, _FAINT * (bound / max(pace, _STANDS) + drag))
        return whole / max(len(held), 1)

    def _rest(self) -> Rest:
        data = self._data
        contact = data.contact
        row = contact.efc_address
        acts = row >= 0
        force = np.bincount(
            self._node_of_geom[contact.geom2[acts]], data.efc_force[row[acts]], len(self._pads)
        )
        nodes = data.geom_xpos[self._pads]
        nodes[:, 2] -= self._numerics.pad_radius
        return Rest(data.qpos, nodes, np.asarray(force, dtype=float), True)

    def lowest(self) -> float:
        """Height of the lowest node over flat rest [m]."""
        return float(self._data.geom_xpos[self._pads, 2].min()) - self._numerics.pad_radius

    def _turn(self) -> None:
        """Lay the first row of each place along its slip, or where friction holds it."""
        data, count = self._data, self._data.nf
        pulled: dict[Rows, list[float]] = {}
        parts = (part[:count].tolist() for part in (data.efc_id, data.efc_force,
                                                    data.efc_D))  # fmt: skip
        for tendon, force, firmness in zip(*parts, strict=True):
            rows, row = self._by_tendon[tendon]
            pulled.setdefault(rows, [0.0, 0.0])[row] = force
            if row:
                rows.learn(firmness)
        for rows, (along, across) in pulled.items():
            size, (c, s) = math.hypot(along, across), rows.way
            u, v, _ = (rows.jacobian @ data.qvel).tolist()
            pace = math.hypot(u, v)
            if abs(along) > _WHOLE * rows.bound and pace > 0:
                rows.way = u / pace, v / pace
            elif size > 0:
                rows.way = (c * along - s * across) / size, (s * along + c * across) / size

    def _places(self) -> Iterator[tuple[Contact, float, Rows]]:
        """Contacts, the arclength of each of their places, and the rows that hold it."""
        for contact in self.contacts:
            rows, at = self._rows[contact.limb], contact.at
            length = self._tree.robot.limbs[contact.limb].strip.length
            first = 0
            if len(rows) > 2:  # it carries others: its beginning, its end, or between
                first = 2 if sum(at) > 0.5 * length * len(at) else 0
                if len(at) == 1 and at[0] not in (0.0, length):
                    first = 4
            for number, place in enumerate(at):
                yield contact, place, rows[first + number]

    def after_step(self) -> None:
        """Take off what the step moved that friction holds, by the order of the integrator alone.

        Places are functions of angles that turn at constant rates in a step, and the step's
        friction stopped them at its end. What is held moved beyond that by the square of the step:
        of it the motion of the whole that explains most is taken off.
        """
        model, data, dt = self._model, self._data, self._numerics.timestep
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        if not self._held:
            return
        moved = [rows.excess(data, dt) for rows in self._held]
        slow = 3 * min(speed for *_, speed in moved) + _STANDS
        x0, y0 = data.qpos.item(0), data.qpos.item(1)
        w = wx = wy = wr = wu = wv = wt = 0.0
        for rows, (u, v, x, y, speed) in zip(self._held, moved, strict=True):
            if speed <= slow:
                weight, x, y = rows.bound + _STANDS, x - x0, y - y0
                w, wx, wy, wr = (
                    w + weight,
                    wx + weight * x,
                    wy + weight * y,
                    wr + weight * (x * x + y * y),
                )
                wu, wv, wt = wu + weight * u, wv + weight * v, wt + weight * (x * v - y * u)
        spread = wr - (wx * wx + wy * wy) / w
        turn = (wt - (wx * wv - wy * wu) / w) / spread if spread > _POINT * w else 0.0
        shift = (wu + turn * wy) / w, (wv - turn * wx) / w
        data.qpos[0] -= shift[0]
        data.qpos[1] -= shift[1]
        data.qpos[3] -= turn


def _pads_of(
    model: mujoco.MjModel, names: tuple[str, ...], nodes: int
) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
    """Pads in the order of analytic.solvers.limbs's nodes, and the node of each geom."""
    pads = [
        model.geom(f"{PREFIX}{name}_pad_{node}_{side}").id
        for side in ("right", "left") for name in names for node in range(nodes)
    ]  # fmt: skip
    node_of = np.zeros(model.ngeom, dtype=int)
    node_of[pads] = np.arange(len(pads))
    return np.array(pads), node_of
