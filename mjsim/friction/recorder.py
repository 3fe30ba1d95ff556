"""Forces of the ground on each node in each step, read from MuJoCo's constraint forces."""

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.ground import depends_on_speed
from mjsim.model.pads import pads_by_node
from mjsim.model.parts import PREFIX, TENDONS, tendon_names
from mjsim.results.forces import GroundForces
from mjsim.scene import Scene

Array = NDArray[np.float64]

_CONTACT = int(mujoco.mjtConstraint.mjCNSTR_CONTACT_FRICTIONLESS)
_TENDON = int(mujoco.mjtConstraint.mjCNSTR_FRICTION_TENDON)


class ContactRecorder:
    """Copies the constraint forces after each step; `forces` sorts them once, at the end.

    Args:
        scene: whose law it is.
        model, data: as compiled.
    """

    def __init__(self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data = model, data
        pads = pads_by_node(model)
        self._nodes = len(pads)
        self._node_of_geom = np.full(model.ngeom, -1)
        self._node_of_geom[pads] = np.arange(len(pads))[:, None]
        self._node_of_tendon = np.full(model.ntendon, -1)
        for node, name in enumerate(tendon_names(len(pads))):
            if scene.between or name in TENDONS:
                self._node_of_tendon[model.tendon(PREFIX + name).id] = node
        self._both = both = model.tendon(PREFIX + TENDONS[2]).id
        begin = model.tendon_adr[both]
        self._divisors = model.wrap_prm[begin : begin + model.tendon_num[both] : 3]
        self._coulomb = scene.friction == "coulomb"
        self._viscous = depends_on_speed(scene.ground)
        self._six = np.zeros(6)
        self._rows: list[tuple[NDArray[Any], ...]] = []
        self._pushes: list[tuple[Array, Array]] = []

    def record(self) -> None:
        """Note the forces of the step just done."""
        if self._coulomb:
            self._pushes.append(self._by_contact())
            return
        data = self._data
        drag = np.empty(0)
        if self._viscous:
            drag = -self._model.tendon_damping * data.ten_velocity
        self._rows.append((
            data.efc_type.copy(), data.efc_id.copy(), data.efc_force.copy(),
            data.contact.geom2.copy(), self._divisors.copy(), drag,
        ))  # fmt: skip

    def forces(self, count: int) -> GroundForces:
        """Forces of the first `count` steps."""
        if self._coulomb:
            normal, friction = (np.array(part[:count]) for part in zip(*self._pushes, strict=True))
            return GroundForces(normal, friction)
        normal, friction = np.zeros((2, count, self._nodes))
        for rows, push, pull in zip(self._rows[:count], normal, friction, strict=True):
            self._sort(rows, push, pull)
        return GroundForces(normal, friction)

    def _sort(self, rows: tuple[NDArray[Any], ...], push: Array, pull: Array) -> None:
        types, ids, force, geoms, divisors, drag = rows
        contact = types == _CONTACT
        np.add.at(push, self._node_of_geom[geoms[ids[contact]]], force[contact])
        tendons, strength = ids[types == _TENDON], force[types == _TENDON]
        nodes = self._node_of_tendon[tendons]
        of_node = nodes >= 0
        pull[nodes[of_node]] += strength[of_node]
        share = np.full(self._nodes, 0.0)  # of each node in the mean position
        share[[0, -1] if len(divisors) == 2 else slice(None)] = 1.0 / divisors
        pull += strength[tendons == self._both].sum() * share
        if len(drag):
            tendons = np.flatnonzero(self._node_of_tendon >= 0)
            pull[self._node_of_tendon[tendons]] += drag[tendons]

    def _by_contact(self) -> tuple[Array, Array]:
        """Normal force and friction along x on each node, of contacts with friction."""
        normal, friction = np.zeros((2, self._nodes))
        contacts = self._data.contact
        for i, (geom, frame) in enumerate(zip(contacts.geom2, contacts.frame, strict=True)):
            mujoco.mj_contactForce(self._model, self._data, i, self._six)
            node = self._node_of_geom[geom]
            normal[node] += self._six[0]
            friction[node] += self._six[1] * frame[3] + self._six[2] * frame[6]
        return normal, friction
