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

from analytic.scene.chain import link_lengths
from analytic.solvers.limbs.contacts import Contact, Contacts
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.statics import Rest
from mjsim.friction.rows import STANDS, Rows
from mjsim.model.limbs import joints_to, limb_body, limbed, places_of
from mjsim.model.pads import edges, pads_of
from mjsim.model.parts import PREFIX
from mjsim.results.status import THROWN
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

_WHOLE = 0.999  # of the bound: the place slides
_AHEAD = (1.0, 0.0)
_FAINT = 0.005  # of all bounds and drags, that viscosity adds at most; chosen
_TIPPED = 1.0  # rad of pitch or roll of the trunk as a whole: it fell over; chosen
_STEEP, _LEANS = math.tan(_TIPPED), math.sin(_TIPPED)
_POINT = 1e-8  # m^2; places that are closer do not tell a turn


class LimbFooting:
    """The rows of friction, set before each step; see mjsim.friction.footing.Footing.

    Args:
        scene, numerics: what is simulated.
        model, data: as compiled.

    Attributes:
        contacts: of the last state that was looked at.
    """

    columns: tuple[str, ...] = ("contacts",)

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        robot = limbed(scene)
        self._model, self._data, self._numerics = model, data, numerics
        self._ground, self._length = scene.ground, robot.length
        self._tree = Tree(robot, numerics.links)
        self._finder = Contacts(self._tree, scene.friction)
        self.contacts: list[Contact] = []
        self._held: list[Rows] = []
        self._rows = [
            [
                Rows(model, f"{PREFIX}{name}_hold_{place}",
                     len(joints_to(robot, numerics.links, i)))
                for place in range(places_of(robot, i))
            ]
            for i, name in enumerate(robot.names)
        ]  # fmt: skip
        self._by_tendon = {
            tendon: (own, row)
            for limb in self._rows for own in limb for row, tendon in enumerate(own.ids)
        }  # fmt: skip
        self._links = [
            [model.body(limb_body(name, i)).id for i in range(numerics.links + 1)]
            for name in robot.names
        ]
        last = float(link_lengths(robot.limbs[0].strip, numerics.links)[-1])
        self._trunk = self._links[0][0], self._links[0][-1], last
        self._starts = [starts.tolist() for starts in self._tree.starts]
        self._pads = edges(pads_of(model, scene))
        self._node_of_geom = np.zeros(model.ngeom, dtype=int)
        self._node_of_geom[self._pads] = np.arange(len(self._pads))
        mass = robot.weight / scene.gravity
        self._viscosity = mass / numerics.tie_time  # of all places together [N s/m]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)

    def prepare(self, pressures: Array) -> list[Array]:
        """Pressures of each step, as the contacts are found by them."""
        return list(pressures)

    def before_step(self, pressures: Array) -> None:
        """Read the contacts, and set what resists in the next step.

        Places of the state now, forces of the step before.

        Args:
            pressures: of the chambers, (S,) [Pa].
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
            whole = min(whole, _FAINT * (bound / max(pace, STANDS) + drag))
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

    def stands(self) -> bool:
        """Whether the trunk is as it can be on a walk: on the ground, and not tipped over.

        A long trunk bends by more than that at its beginning, so its ends tell its pitch; its side
        is level on every link alike.
        """
        data, (first, last, length) = self._data, self._trunk
        if not abs(data.qpos.item(2)) < self._length:
            return False
        (x, y, z), (u, v, w) = data.xpos[first].tolist(), data.xpos[last].tolist()
        along = data.xmat[last].tolist()
        ahead = u - x + length * along[0], v - y + length * along[3]
        rise, aside = w - z + length * along[6], along[7]
        if abs(rise) > _STEEP * math.hypot(*ahead) or abs(aside) > _LEANS:
            return False
        lowest = float(data.geom_xpos[self._pads, 2].min()) - self._numerics.pad_radius
        return lowest <= THROWN * self._length

    def places(self) -> Array:
        """Places of all pads, whose speed tells whether the robot is at rest, (P, 3) [m]."""
        return np.array(self._data.geom_xpos[self._pads])

    def side_contacts(self) -> Array:
        """Length over which each limb lay on its side when it was looked at last, (L,) [m]."""
        lengths = np.zeros(len(self._rows))
        for contact in self.contacts:
            lengths[contact.limb] += contact.length
        return lengths

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

    def after_step(self) -> tuple[float, ...]:
        """Take off what the step moved that friction holds, by the order of the integrator alone.

        Places are functions of angles that turn at constant rates in a step, and the step's
        friction stopped them at its end. What is held moved beyond that by the square of the step:
        of it the motion of the whole that explains most is taken off.

        Returns:
            How many limbs touched the ground in the step.
        """
        model, data, dt = self._model, self._data, self._numerics.timestep
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        touching = (float(len({contact.limb for contact in self.contacts})),)
        if not self._held:
            return touching
        moved = [rows.excess(data, dt) for rows in self._held]
        slow = 3 * min(speed for *_, speed in moved) + STANDS
        x0, y0 = data.qpos.item(0), data.qpos.item(1)
        w = wx = wy = wr = wu = wv = wt = 0.0
        for rows, (u, v, x, y, speed) in zip(self._held, moved, strict=True):
            if speed <= slow:
                weight, x, y = rows.bound + STANDS, x - x0, y - y0
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
        return touching
