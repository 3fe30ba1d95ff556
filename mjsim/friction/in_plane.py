"""Friction of a robot of limbs: each contact resists by a bound in the plane, over its area.

Contacts and their bounds are those of analytic.solvers.limbs.contacts, found from the forces of the
step before. Each has three rows, see mjsim.friction.point_friction: dry friction of the whole bound
V along its slip s, turning included, or along the traction where it does not slide, and across that
V v / |s|, where s is the slip of the step before: together the tangent of V s / |s|, as in Newton's
method, so that friction opposes the slip whatever its direction. What the bounds leave open is left
to viscosity at all contacts alike, as in analytic.friction.dissipation_in_plane; it is small beside
them.
"""

import math
from bisect import bisect_right

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import link_lengths
from analytic.scene.surface import Surface
from analytic.solvers.limbs.contact_search import Contact, parts_of
from analytic.solvers.limbs.contacts import Contacts
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.rest import Rest
from mjsim.friction.ceiling import CeilingPush
from mjsim.friction.point_friction import AHEAD, STANDS, PointFriction
from mjsim.model.limbs import ROWS, contact_name, joints_to, limbed, link_prefix
from mjsim.model.pads import edges, node_of_geom, pads_of
from mjsim.results.status import THROWN
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

_WHOLE = 0.999  # of the bound: the point slides
_WEAK = 0.005  # of all bounds and drags, that viscosity adds at most; chosen
_TIPPED = 1.0  # rad of pitch or roll of the trunk as a whole: it fell over; chosen
_STEEP, _LEANS = math.tan(_TIPPED), math.sin(_TIPPED)
_POINT = 1e-8  # m^2; points that are closer do not tell a turn


class LimbFooting:
    """Friction at the points of all contacts; see mjsim.friction.footing.Footing.

    Args:
        scene, numerics: what is simulated.
        model, data: as compiled.

    Attributes:
        columns: see Footing.
        contacts: in the coming step.
    """

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        robot = limbed(scene)
        self._model, self._data, self._numerics = model, data, numerics
        self._ground, self._length = scene.ground, robot.length
        self._ceiling = CeilingPush(model, data)
        self.columns = ("contacts", *self._ceiling.columns)
        self._tree = Tree(
            robot, numerics.links, incline=scene.incline, surface=scene.ground.at(0.0)
        )
        self._finder = Contacts(self._tree, scene.friction)
        self.contacts: list[Contact] = []
        self._resisting: list[PointFriction] = []
        self._rows = [
            {
                part: PointFriction(model, contact_name(limb.name, part),
                                    len(joints_to(robot, numerics.links, i, numerics.twists)))
                for part in parts_of(limb, robot)
            }
            for i, limb in enumerate(robot.limbs)
        ]  # fmt: skip
        self._by_tendon = {
            tendon: (rows, number)
            for limb in self._rows for rows in limb.values() for number, tendon in
            enumerate(rows.ids)
        }  # fmt: skip
        self._links = [
            [model.body(f"{link_prefix(name)}{i}").id for i in range(numerics.links + 1)]
            for name in robot.names
        ]
        length = float(link_lengths(robot.limbs[0].strip, numerics.links)[-1])
        self._trunk = self._links[0][0], self._links[0][-1], length
        self._starts = [starts.tolist() for starts in self._tree.starts]
        self._pads = edges(pads_of(model, scene))
        self._node_of_geom = node_of_geom(model, self._pads, other=-1)
        mass = robot.weight / scene.gravity
        self._viscosity = mass / numerics.tie_time  # of all points together [N s/m]
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
        model, data = self._model, self._data
        self.contacts = self._finder.find(self._rest(), pressures)
        self._turn()
        for point in self._resisting:
            point.release()
        resisting = []
        for contact in self.contacts:
            point, at = self._rows[contact.limb][contact.part], contact.middle
            starts = self._starts[contact.limb]
            link = min(bisect_right(starts, at), len(starts)) - 1
            body = self._links[contact.limb][link]
            point.move_to(model, data, body, at - starts[link], self._finder.radius(contact))
            if point not in self._resisting:
                point.turn(AHEAD)
                point.turn(point.velocity)
            point.resist(*self._resistance(contact, point))
            resisting.append(point)
        viscous = self._viscous(resisting)
        applied = np.zeros(model.nv)
        for point in resisting:
            applied -= viscous * np.array(point.velocity) @ point.jacobian
        data.qfrc_applied[:] = applied
        self._resisting = resisting

    def _resistance(self, contact: Contact, point: PointFriction) -> tuple[float, float]:
        """Bound [N] and viscous resistance [N s/m]; on ground that changes their sum over it."""
        speed = math.hypot(*point.velocity)
        if isinstance(self._ground, Surface):
            return self._finder.resistance(contact, self._ground, speed)
        ahead, left = self._data.xmat[point.body, :2].tolist()
        along, aside = np.array(contact.at) - contact.middle, np.array(contact.aside)
        places = point.place[0] + along * ahead + aside * left
        bounds, drags = self._finder.resistances([contact], self._ground, places, speed)
        return float(bounds.sum()), float(drags.sum())

    def _viscous(self, points: list[PointFriction]) -> float:
        """Resistance of each contact to what the bounds leave open [N s/m]."""
        bound, drag = sum(point.bound for point in points), sum(point.drag for point in points)
        speed = max((math.hypot(*point.velocity) for point in points), default=0.0)
        whole = self._viscosity
        if bound > 0.0 or drag > 0.0:
            whole = min(whole, _WEAK * (bound / max(speed, STANDS) + drag))
        return whole / max(len(points), 1)

    def _rest(self) -> Rest:
        data = self._data
        contact = data.contact
        row = contact.efc_address
        node = self._node_of_geom[contact.geom2]
        acts = (row >= 0) & (node >= 0)
        force = np.bincount(node[acts], data.efc_force[row[acts]], len(self._pads))
        nodes = data.geom_xpos[self._pads]
        nodes[:, 2] -= self._numerics.pad_radius
        return Rest(data.qpos, nodes, np.asarray(force, dtype=float), True)

    def stands(self) -> bool:
        """Tell whether the trunk is as it can be on a walk: on the ground, and not tipped over.

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
        """Length over which each limb lies on its side in the coming step, (L,) [m]."""
        lengths = np.zeros(len(self._rows))
        for contact in self.contacts:
            lengths[contact.limb] += contact.length
        return lengths

    def _turn(self) -> None:
        """Lay the first row of each point along its slip, or along its friction if it sticks."""
        data, count = self._data, self._data.nf
        forces: dict[PointFriction, list[float]] = {}
        columns = (data.efc_id, data.efc_force, data.efc_D)
        lists = (column[:count].tolist() for column in columns)
        for tendon, force, stiffness in zip(*lists, strict=True):
            point, row = self._by_tendon[tendon]
            forces.setdefault(point, [0.0] * ROWS)[row] = force
            if row:
                point.update_inverse_mass(row, stiffness)
        for point, rows in forces.items():
            u, v, w = (point.jacobian @ data.qvel).tolist()
            if abs(rows[0]) > _WHOLE * point.bound and math.hypot(u, v, w) > 0:
                point.turn((u, v, w))
            else:
                x, y, z = (sum(f * axis[i] for f, axis in zip(rows, point.axes, strict=True))
                           for i in range(ROWS))  # fmt: skip
                point.turn((x, y, z))

    def after_step(self) -> tuple[float, ...]:
        """Take off how far the step moved anchored points, by the order of the integrator alone.

        Places are functions of angles that turn at constant rates in a step, and the step's
        friction stopped them at its end. Anchored points moved beyond that by the square of the
        step: of it the motion of the whole that explains most is taken off.

        Returns:
            Number of limbs that touched the ground in the step, and the ceiling's push.
        """
        model, data, dt = self._model, self._data, self._numerics.timestep
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        touching = (float(len({c.limb for c in self.contacts})), *self._ceiling.numbers())
        if not self._resisting:
            return touching
        moved = [(point.bound + STANDS, *point.after_step(data, dt)) for point in self._resisting]
        slow = 3 * min(speed for *_, speed in moved) + STANDS
        shift, turn = rigid_motion(
            [(weight, place, excess) for weight, place, excess, speed in moved if speed <= slow],
            complex(data.qpos.item(0), data.qpos.item(1)),
        )
        data.qpos[0] -= shift.real
        data.qpos[1] -= shift.imag
        data.qpos[3] -= turn
        return touching


def rigid_motion(
    points: list[tuple[float, complex, complex]], origin: complex
) -> tuple[complex, float]:
    """Motion of a rigid body in the plane nearest to those of points, by weighted least squares.

    With x + i y for (x, y) it minimises sum w |m - s - i r p|^2 over s and r:
    r (sum w |p|^2 - |sum w p|^2 / W) = Im(sum w p* m - (sum w p)* (sum w m) / W), and
    s = (sum w m - i r sum w p) / W, with W = sum w.

    Args:
        points: weight w, place and displacement m of each [1, m, m]; p is its place from o.
        origin: o, about which the body turns [m].

    Returns:
        s and r [m, rad]; r is 0 where the points are too close to tell it.
    """
    total = square = 0.0
    place = move = product = 0j
    for weight, p, m in points:
        p -= origin
        total, place, move = total + weight, place + weight * p, move + weight * m
        square += weight * (p.conjugate() * p).real
        product += weight * (p.conjugate() * m)
    spread = square - (place.conjugate() * place).real / total
    turned = (product - place.conjugate() * move / total).imag
    turn = turned / spread if spread > _POINT * total else 0.0
    return (move - 1j * turn * place) / total, turn
