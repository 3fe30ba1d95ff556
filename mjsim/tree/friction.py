"""Friction of a robot of limbs: each contact is held at its place by a bound in the plane.

Contacts and their bounds are those of analytic.tree.contacts, found from the forces of the step
before. A place is held by two dry frictions: one of the whole bound along the force that held it in
the step before, and a weaker one across, which turns that direction. Where the place slides they
let it go along the first only, so that after a step friction opposes the slip, whatever its
direction, and never exceeds the disc of its bound by more than the square of a small angle. What
the bounds leave open is left to viscosity at all places alike, as in analytic.plane; it is small
beside them.
"""

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.ground import surfaces_of
from analytic.tree.contacts import Contact, Contacts
from analytic.tree.kinematics import Tree
from analytic.tree.statics import Rest
from mjsim.bodies.parts import PREFIX
from mjsim.tree.body import joints_to, limb_body, places_of
from mjsim.tree.scene import TreeNumerics, TreeScene

Array = NDArray[np.float64]

_ACROSS = 0.5  # of the bound: turns the direction by so much in a step; chosen
_FRICTION = int(mujoco.mjtConstraint.mjCNSTR_FRICTION_TENDON)


class Rows:
    """Rows of dry friction that hold one place.

    Attributes:
        bounds, drags: of the two rows, (2,), views of the model.
        coefficients: of the joints that move the place, (2, J), a view of the model.
        dofs: of these joints, (J,).
        way: direction of the first row, (2,).
        ids: of the tendons.
    """

    def __init__(self, model: mujoco.MjModel, name: str, joints: int) -> None:
        count, first = 2, model.tendon(f"{name}_0").id
        here = slice(first, first + count)
        self.ids = range(first, first + count)
        self.bounds, self.drags = model.tendon_frictionloss[here], model.tendon_damping[here]
        begin = model.tendon_adr[first]
        self.coefficients = model.wrap_prm[begin : begin + count * joints].reshape(count, joints)
        self.dofs = model.jnt_dofadr[model.wrap_objid[begin : begin + joints]]
        self.way = np.array([1.0, 0.0])
        self.release()

    def release(self) -> None:
        """Hold nothing."""
        self.bounds[:] = 0.0
        self.drags[:] = 0.0


@dataclass
class Held:
    """A place that the ground holds in the coming step.

    Attributes:
        rows: that hold it.
        jacobian: of its motion in plan, (2, nv).
        place: in plan, (2,) [m].
        body, own: that it is fast to, and where in its frame, (3,) [m].
        bound: of its friction [N].
    """

    rows: Rows
    jacobian: Array
    place: Array
    body: int
    own: Array
    bound: float


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
        self._ground = scene.ground
        self._wet = any(surface.viscosity for surface in surfaces_of(scene.ground))
        self._tree = Tree(scene.robot, numerics.elements)
        self._finder = Contacts(self._tree, scene.friction)
        self.contacts: list[Contact] = []
        self._held: list[Held] = []
        robot = scene.robot
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
        self._pads, self._node_of_geom = _pads_of(model, robot.names, numerics.elements + 2)
        mass = robot.weight / scene.gravity
        self._viscosity = mass / numerics.tie_time  # of all places together [N s/m]
        self._jacobian = np.zeros((3, model.nv))

    def before_step(self, pressures: Array) -> None:
        """Read the contacts, and set what resists in the next step.

        Places of the state now, forces of the step before.

        Args:
            pressures: of the limbs, (L,) [Pa].
        """
        model, data = self._model, self._data
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        self.contacts = self._finder.find(self._rest(), pressures)
        pulled = self._pulls()
        for held in self._held:
            held.rows.release()
        self._held = [self._hold(*where) for where in self._places()]
        speeds = [held.jacobian @ data.qvel for held in self._held]
        self._turn(speeds, pulled)
        share = self._viscosity / max(len(self._held), 1)
        data.qfrc_applied[:] = 0.0
        for held, speed in zip(self._held, speeds, strict=True):
            rows = held.rows
            c, s = rows.way
            rows.coefficients[:] = np.array([[c, s], [-s, c]]) @ held.jacobian[:, rows.dofs]
            rows.bounds[:] = held.bound, _ACROSS * held.bound
            data.qfrc_applied -= share * (speed @ held.jacobian)

    def _rest(self) -> Rest:
        data = self._data
        force = np.zeros(len(self._pads))
        contact = data.contact
        row = contact.efc_address
        acts = row >= 0
        np.add.at(force, self._node_of_geom[contact.geom2[acts]], data.efc_force[row[acts]])
        nodes = data.geom_xpos[self._pads] - (0.0, 0.0, self._numerics.pad_radius)
        return Rest(data.qpos, nodes, force, True)

    def _pulls(self) -> dict[Rows, Array]:
        """Forces of friction in the step before [N]."""
        data = self._data
        mine = data.efc_type == _FRICTION
        pulled: dict[Rows, Array] = {}
        for tendon, force in zip(data.efc_id[mine].tolist(), data.efc_force[mine].tolist(),
                                 strict=True):  # fmt: skip
            rows, row = self._by_tendon[tendon]
            c, s = rows.way
            along = np.array([-s, c]) if row else rows.way
            pulled[rows] = pulled.get(rows, 0.0) + force * along
        return pulled

    def _places(self) -> list[tuple[Contact, float, Rows]]:
        """Contacts, the arclength of each of their places, and the rows that hold it."""
        found = []
        for contact in self.contacts:
            rows = self._rows[contact.limb]
            length = self._tree.robot.limbs[contact.limb].strip.length
            first = 0
            if len(rows) > 2:  # it carries others: its beginning, its end, or between
                first = 2 if sum(contact.at) > length * len(contact.at) / 2 else 0
                if len(contact.at) == 1 and contact.at[0] not in (0.0, length):
                    first = 4
            for number, at in enumerate(contact.at):
                found.append((contact, at, rows[first + number]))
        return found

    def _hold(self, contact: Contact, at: float, rows: Rows) -> Held:
        data, starts = self._data, self._tree.starts[contact.limb]
        link = min(int(np.searchsorted(starts, at, side="right")) - 1, self._numerics.elements)
        body = self._links[contact.limb][link]
        own = np.array([at - starts[link], 0.0, 0.0])
        place = data.xpos[body] + data.xmat[body].reshape(3, 3) @ own
        mujoco.mj_jac(self._model, data, self._jacobian, None, place, body)
        bound, drag = self._finder.resistance(contact, self._ground.at(float(place[0])))
        if self._wet:
            rows.drags[:] = drag
        return Held(rows, self._jacobian[:2].copy(), place[:2], body, own, bound)

    def _turn(self, speeds: list[Array], pulled: dict[Rows, Array]) -> None:
        """Lay the first row of each place where friction pulls."""
        for held, speed in zip(self._held, speeds, strict=True):
            way = pulled.get(held.rows, speed)
            size = float(np.hypot(*way))
            if size > 0:
                held.rows.way = way / size

    def after_step(self) -> None:
        """Take off what the step moved that friction holds, by the order of the integrator alone.

        Places are functions of angles that turn at constant rates in a step, and the step's
        friction stopped them at its end. What is held moved beyond that by the square of the step:
        of it the motion of the whole that explains most is taken off.
        """
        if not self._held:
            return
        model, data, dt = self._model, self._data, self._numerics.timestep
        mujoco.mj_kinematics(model, data)
        gone, weights, places, slips = [], [], [], []
        for held in self._held:
            place = data.xpos[held.body] + data.xmat[held.body].reshape(3, 3) @ held.own
            velocity = held.jacobian @ data.qvel
            gone.append(place[:2] - held.place - dt * velocity)
            slips.append(float(np.hypot(*velocity)))
            weights.append(held.bound + 1e-9)
            places.append(place[:2])
        slow = min(slips)
        w = np.array(weights) * (np.array(slips) <= 3 * slow + 1e-9)
        arms = np.array(places) - data.qpos[:2]
        lever = np.zeros((len(w), 2, 3))
        lever[:, 0, 0] = lever[:, 1, 1] = 1.0
        lever[:, 0, 2], lever[:, 1, 2] = -arms[:, 1], arms[:, 0]
        root = np.sqrt(w)[:, None, None]
        found = np.linalg.lstsq(
            (root * lever).reshape(-1, 3), (root[..., 0] * np.array(gone)).ravel(), rcond=1e-6
        )[0]
        data.qpos[0] -= found[0]
        data.qpos[1] -= found[1]
        data.qpos[3] -= found[2]


def _pads_of(
    model: mujoco.MjModel, names: tuple[str, ...], nodes: int
) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
    """Pads in the order of analytic.tree's nodes, and the node of each geom."""
    pads = [
        model.geom(f"{PREFIX}{name}_pad_{node}_{side}").id
        for side in ("right", "left") for name in names for node in range(nodes)
    ]  # fmt: skip
    node_of = np.zeros(model.ngeom, dtype=int)
    node_of[pads] = np.arange(len(pads))
    return np.array(pads), node_of
