"""Friction of a robot of limbs: each contact resists by a bound in the plane, over its area.

Contacts and their bounds are those of analytic.solvers.limbs.contacts, found from the forces of the
step before. A tip resists at its points, a side at its middle, by load at that of its load, as it
slips and turns. Each point has three rows, see mjsim.friction.friction_rows: dry friction of the
whole bound V along its slip s, turning included, or along the traction where it does not slide, and
across that V v / |s|, where s is the slip of the step before: together the tangent of V s / |s|, as
in Newton's method, so that friction opposes the slip whatever its direction. What the bounds leave
open is left to viscosity at all contacts alike, as in analytic.friction.dissipation_in_plane; it is
small beside them.
"""

import math
from bisect import bisect_right
from itertools import chain

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.friction.dissipation_in_plane import nap_of
from analytic.scene.chain import link_lengths
from analytic.scene.ground import depends_on_speed
from analytic.scene.surface import Surface, Way
from analytic.solvers.limbs.contact_search import parts_of
from analytic.solvers.limbs.contact_state import TETHER, Contact
from analytic.solvers.limbs.contacts import Contacts, axes_of
from analytic.solvers.limbs.kinematics import Tree
from mjsim.friction.ceiling import CeilingPush
from mjsim.friction.friction_rows import STANDS, Directions, FrictionRows
from mjsim.friction.rigid_motion import rigid_motion
from mjsim.model.bodies.limbs import POINTS, TIP_POINTS, joints_to, limbed, link_prefix, point_names
from mjsim.model.pads import edges, node_of_geom, pads_of
from mjsim.results.status import THROWN
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

_WEAK = 0.005  # of all bounds and drags, that viscosity adds at most; chosen
_TIPPED = 1.0  # rad of pitch or roll of the trunk as a whole: it fell over; chosen
_STEEP, _LEANS = math.tan(_TIPPED), math.sin(_TIPPED)
_YAW = 3  # of the coordinates
_MIDDLE: tuple[float, ...] = (0.0,)  # aside


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
            robot, numerics.links, numerics.twists, scene.incline, scene.ground.at(0.0)
        )
        self._finder = Contacts(self._tree, scene.friction)
        # whether points of one contact may resist unlike each other
        self._varies = not isinstance(scene.ground, Surface) or depends_on_speed(scene.ground)
        self._round = self._finder.is_round(scene.ground)
        self.contacts: list[Contact] = []
        self._pressures: list[float] = []
        self._owners: list[tuple[Contact, float]] = []  # of the points, and their parts of these
        parts = [(i, part) for i, limb in enumerate(robot.limbs) for part in parts_of(limb, robot)]
        names = [point_names(robot.names[i], part) for i, part in parts]
        joints = [len(joints_to(robot, numerics.links, i, numerics.twists)) for i, _ in parts]
        self._rows = FrictionRows(
            model, data, list(chain.from_iterable(names)), np.repeat(joints, POINTS).tolist()
        )
        self._numbers: list[dict[str, int]] = [{} for _ in robot.limbs]
        for number, (limb, part) in enumerate(parts):
            self._numbers[limb][part] = POINTS * number
        self._links = [
            [model.body(f"{link_prefix(name)}{i}").id for i in range(numerics.links + 1)]
            for name in robot.names
        ]
        length = float(link_lengths(robot.limbs[0].strip, numerics.links)[-1])
        self._trunk = self._links[0][0], self._links[0][-1], length
        self._starts = [starts.tolist() for starts in self._tree.starts]
        self._pads = edges(pads_of(model, scene))
        vertices = len(self._pads) // 2  # of which each has a pad at either edge
        node = node_of_geom(model, self._pads, other=-1)
        self._vertex_of_geom = np.where(node < 0, node, node % vertices)
        self._heights_of_geoms = data.geom_xpos[:, 2]
        mass = robot.weight / scene.gravity
        self._viscosity = mass / numerics.tie_time  # of all points together [N s/m]
        self._look()

    def prepare(self, pressures: Array) -> list[tuple[list[list[int]], list[float]]]:
        """Bends of the ends of each limb at each step by its pressures, and these [Pa]."""
        bends: list[list[list[int]]] = self._finder.bends(pressures).tolist()
        return list(zip(bends, pressures.tolist(), strict=True))

    def before_step(self, prepared: tuple[list[list[int]], list[float]]) -> None:
        """Read the contacts, and set what resists in the next step.

        Places of the state now, forces of the step before.

        Args:
            prepared: how the two ends of each limb do, see analytic.solvers.limbs.contact_state;
                and pressures in the chambers, which switch feet [Pa].
        """
        rows, (bends, self._pressures) = self._rows, prepared
        self.contacts = self._finder.search(self._pushes(), self._heights, bends)
        rows.turn()
        radii = self._move_rows()
        rows.slip(radii)
        if self._round:
            bounds, drags = self._resistances()
        else:
            bounds, drags, naps = self._naps()
            radii = [
                radius * self._part_of_turning(contact, body, nap)
                for radius, (contact, _), body, nap in zip(radii, self._owners, rows.bodies, naps,
                                                           strict=True)
            ]  # fmt: skip
            rows.slip(radii, naps)
        rows.resist(bounds, drags, self._viscosities(sum(bounds), sum(drags)))

    def _move_rows(self) -> list[float]:
        """Take the rows to the points of the contacts; note whose these are, return their radii."""
        numbers, bodies, offsets, radii = [], [], [], []
        self._owners = owners = []
        for contact in self.contacts:
            limb = contact.limb
            number, starts = self._numbers[limb][contact.part], self._starts[limb]
            at, asides, radius = contact.at[0], contact.aside, 0.0
            if contact.length:  # a side
                at, asides, radius = contact.middle, _MIDDLE, self._finder.radius(contact)
                number += TIP_POINTS
            link, owner = bisect_right(starts, at) - 1, (contact, 1 / len(asides))
            body, along = self._links[limb][link], at - starts[link]
            for aside in asides:
                numbers.append(number)
                bodies.append(body)
                offsets.append((along, aside))
                radii.append(radius)
                owners.append(owner)
                number += 1
        self._rows.move_to(numbers, bodies, offsets)
        return radii

    def _naps(self) -> tuple[list[float], list[float], list[Directions]]:
        """Bounds, viscous resistances and directions of the points."""
        ahead, back, across = (self._resistances(way) for way in ("ahead", "back", "across"))
        x = [place.real for place in self._rows.places]
        axes = axes_of(self._ground, x, self._data.qpos.item(_YAW), 0.0)
        bounds, nap = nap_of(np.array(ahead[0]), np.array(back[0]), np.array(across[0]), axes)
        columns = np.concatenate([nap.scale.reshape(-1, 4), nap.lean], axis=1)
        return bounds.tolist(), ahead[1], list(map(tuple, columns.tolist()))

    def _part_of_turning(self, contact: Contact, body: int, nap: Directions) -> float:
        """Resistance of a contact to turning over that by its bound in all directions [1]."""
        ahead, left = self._data.xmat[body, :2].tolist()
        a, b, c, d, _, _ = nap
        scaled = whole = 0.0
        middle = contact.middle
        for along, aside, part in zip(contact.at, contact.aside, contact.shares, strict=True):
            u = -(along - middle) * left - aside * ahead
            v = (along - middle) * ahead - aside * left
            whole += part * math.hypot(u, v)
            scaled += part * math.hypot(a * u + b * v, c * u + d * v)
        return scaled / whole if whole else 1.0

    def _resistances(self, way: Way | None = None) -> tuple[list[float], list[float]]:
        """Bounds [N] and viscous resistances [N s/m] of the points.

        Against motion one way where the ground or a foot has a nap.
        """
        rows, finder, ground, bounds, drags = self._rows, self._finder, self._ground, [], []
        alike = ((ground, 1.0),) if isinstance(ground, Surface) else None
        bound = drag = 0.0
        before = None
        for (contact, share), body, place, speed in zip(
            self._owners, rows.bodies, rows.places, rows.speeds, strict=True
        ):
            if self._varies or contact is not before:
                under = alike or self._under(contact, body, place.real)
                bound, drag, before = 0.0, 0.0, contact
                for surface, of_contact in under:
                    part = share * of_contact
                    dry, wet = finder.resistance(
                        contact, surface.against(way) if way else surface, speed, way or "ahead",
                        self._pressures,
                    )  # fmt: skip
                    bound, drag = bound + part * dry, drag + part * wet
            bounds.append(bound)
            drags.append(drag)
        return bounds, drags

    def _under(self, contact: Contact, body: int, x: float) -> list[tuple[Surface, float]]:
        """Surfaces under what a point at x [m] stands for, and their parts of it.

        Of a side those under all places that it resists at.
        """
        ground = self._ground
        if not contact.length:
            return [(ground.at(x), 1.0)]
        ahead, left = self._data.xmat[body, :2].tolist()
        middle = contact.middle
        return [
            (ground.at(x + (along - middle) * ahead + aside * left), part)
            for along, aside, part in zip(contact.at, contact.aside, contact.shares, strict=True)
        ]

    def _viscosities(self, bound: float, drag: float) -> list[float]:
        """Resistance of each point to what the bounds leave open [N s/m].

        Args:
            bound, drag: of all points together [N, N s/m].
        """
        whole, fastest = self._viscosity, max(self._rows.speeds, default=0.0)
        if bound > 0.0 or drag > 0.0:
            whole = min(whole, _WEAK * (bound / max(fastest, STANDS) + drag))
        each = whole / max(len(self.contacts), 1)
        return [each * share for _, share in self._owners]

    def _look(self) -> None:
        """Place the links as the coordinates say; note the heights of the limbs' vertices."""
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        heights = self._heights_of_geoms[self._pads]
        half = len(heights) // 2
        lowest = self._finder.heights(heights[:half], heights[half:]) - self._numerics.pad_radius
        self._heights: list[float] = lowest.tolist()

    def _pushes(self) -> list[float]:
        """Force of the ground on each vertex, both edges together [N]."""
        data, contact = self._data, self._data.contact
        vertex, first = self._vertex_of_geom.take(contact.geom2), data.nefc - data.ncon
        if first == data.nf and not self._ceiling.columns:
            forces = data.efc_force[first:]  # a row each, after those of dry friction
        else:  # or MuJoCo had no memory for the rows
            row = contact.efc_address
            acts = (row >= 0) & (vertex >= 0)
            vertex, forces = vertex[acts], data.efc_force[row[acts]]
        force = np.bincount(vertex, forces, len(self._heights))
        pushes: list[float] = force.tolist()
        return pushes

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
        return min(self._heights) <= THROWN * self._length

    def places(self) -> Array:
        """Places of all pads, whose speed tells whether the robot is at rest, (P, 3) [m]."""
        return np.array(self._data.geom_xpos[self._pads])

    def side_contacts(self) -> Array:
        """Length over which each limb lies on its side in the coming step, (L,) [m]."""
        lengths = np.zeros(len(self._links))
        for contact in self.contacts:
            lengths[contact.limb] += contact.length
        return lengths

    def after_step(self) -> tuple[float, ...]:
        """Take off how far the step moved anchored points, by the order of the integrator alone.

        Places are functions of angles that turn at constant rates in a step, and the step's
        friction stopped them at its end. Anchored points moved beyond that by the square of the
        step: of it the motion of the whole that explains most is taken off.

        Returns:
            Number of limbs that touched the ground in the step, and the ceiling's push.
        """
        self._rows.note_rates()
        self._look()
        limbs = {contact.limb for contact in self.contacts if contact.part != TETHER}
        touching = (float(len(limbs)),
                    *self._ceiling.numbers())  # fmt: skip
        if not self.contacts:
            return touching
        moved = self._rows.after_step()
        slow = 3 * min([speed for *_, speed in moved]) + STANDS
        qpos = self._data.qpos
        shift, turn = rigid_motion(
            [(bound + STANDS, place, move) for bound, place, move, speed in moved
             if speed <= slow],
            complex(qpos.item(0), qpos.item(1)),
        )  # fmt: skip
        qpos[0] -= shift.real
        qpos[1] -= shift.imag
        qpos[3] -= turn
        return touching
