"""Forces of the ground on each node in each step, read from MuJoCo's constraint forces."""

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.friction.grip import Grip
from analytic.friction.laws import LAWS
from analytic.scene.ground import depends_on_speed
from mjsim.friction.lean import Lean
from mjsim.friction.node_tendons import WRAPS, end_sites, mean_sites
from mjsim.model.bodies.parts import PREFIX, TENDONS, tendon_names
from mjsim.model.pads import node_of_geom, pads_by_node
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
        self._node_of_geom = node_of_geom(model, pads, other=-1)
        self._node_of_tendon = np.full(model.ntendon, -1)
        for node, name in enumerate(tendon_names(len(pads))):
            if PREFIX + name in {model.tendon(i).name for i in range(model.ntendon)}:
                self._node_of_tendon[model.tendon(PREFIX + name).id] = node
        self._both = model.tendon(PREFIX + TENDONS[2]).id
        self._mean_sites, self._wraps = mean_sites(model), model.tendon_num
        self._node_of_site = np.full(model.nsite, -1)
        ends = np.flatnonzero(self._node_of_tendon >= 0)
        self._node_of_site[end_sites(model, ends)] = self._node_of_tendon[ends]
        self._coulomb = scene.friction == "coulomb"
        self._viscous = depends_on_speed(scene.ground)
        grip = Grip(scene.strip, LAWS[scene.friction])
        self._lean = None if grip.is_round(scene.ground) else Lean(model)
        self._six = np.zeros(6)
        self._rows: list[tuple[NDArray[Any], ...]] = []
        self._pushes: list[tuple[Array, Array]] = []

    def record(self) -> None:
        """Note the forces of the step just done."""
        if self._coulomb:
            self._pushes.append(self._by_contact())
            return
        data, averaged = self._data, self._wraps.item(self._both) // WRAPS
        drag = np.empty(0)
        if self._viscous or self._lean:
            drag = -self._model.tendon_damping * data.ten_velocity
        if self._lean:
            drag += self._lean.forces()
        self._rows.append((
            data.efc_type.copy(), data.efc_id.copy(), data.efc_force.copy(),
            data.contact.geom2.copy(), self._mean_sites[:averaged].copy(), drag,
        ))  # fmt: skip

    def forces(self, count: int) -> GroundForces:
        """Forces of the first `count` steps."""
        if self._coulomb:
            normal, friction = (np.array(part[:count]) for part in zip(*self._pushes, strict=True))
            return GroundForces(normal, friction)
        return self._sorted(self._rows[:count])

    def _sorted(self, rows: list[tuple[NDArray[Any], ...]]) -> GroundForces:
        """Forces of some steps, all at once."""
        kinds, numbers, strengths, geoms, means, drags = zip(*rows, strict=True)
        step = np.repeat(np.arange(len(rows)), [len(part) for part in kinds])
        kind, ids, force = map(np.concatenate, (kinds, numbers, strengths))
        normal, friction = np.zeros((2, len(rows), self._nodes))

        contact = kind == _CONTACT
        begins = np.cumsum([0, *(len(part) for part in geoms)])  # of the contacts of each step
        geom = np.concatenate(geoms)[begins[step[contact]] + ids[contact]]
        node = self._node_of_geom[geom]
        pad = node >= 0
        np.add.at(normal, (step[contact][pad], node[pad]), force[contact][pad])

        tendon = kind == _TENDON
        step, ids, force = step[tendon], ids[tendon], force[tendon]
        nodes = self._node_of_tendon[ids]
        of_node = nodes >= 0
        friction[step[of_node], nodes[of_node]] += force[of_node]
        both = ids == self._both
        for one, push in zip(step[both].tolist(), force[both].tolist(), strict=True):
            friction[one, self._node_of_site[means[one]]] += push
        if self._viscous or self._lean:
            tendons = np.flatnonzero(self._node_of_tendon >= 0)
            friction[:, self._node_of_tendon[tendons]] += np.array(drags)[:, tendons]
        return GroundForces(normal, friction)

    def _by_contact(self) -> tuple[Array, Array]:
        """Normal force and friction along x on each node, of contacts with friction."""
        normal, friction = np.zeros((2, self._nodes))
        contacts = self._data.contact
        for i, (geom, frame) in enumerate(zip(contacts.geom2, contacts.frame, strict=True)):
            node = self._node_of_geom[geom]
            if node < 0:  # the ceiling's
                continue
            mujoco.mj_contactForce(self._model, self._data, i, self._six)
            normal[node] += self._six[0]
            friction[node] += self._six[1] * frame[3] + self._six[2] * frame[6]
        data = self._data
        dry = np.flatnonzero(data.efc_type == _TENDON)  # what feet hold by
        nodes = self._node_of_tendon[data.efc_id[dry]]
        np.add.at(friction, nodes[nodes >= 0], data.efc_force[dry[nodes >= 0]])
        if self._lean:
            forces, tendons = self._lean.forces(), np.flatnonzero(self._node_of_tendon >= 0)
            friction[self._node_of_tendon[tendons]] += forces[tendons]
        return normal, friction
