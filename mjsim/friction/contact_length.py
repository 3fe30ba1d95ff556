"""Lengths of side contact and loads of the ends, from the forces of MuJoCo's contacts.

The length follows from the ground's forces, finer than the pads; see
analytic.friction.contact_length. Plain floats: numpy is slow on a few numbers.
"""

from collections.abc import Iterable

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.friction.flat_load import FlatLoad, LoadFrom
from analytic.scene.chain import node_positions
from mjsim.model.pads import node_of_geom, pads_by_node
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]


class ContactForces:
    """Reads the contacts of the step just done.

    Args:
        scene, numerics: what is simulated.
        model, data: as compiled.
    """

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        self._model, self._data, self._radius = model, data, numerics.pad_radius
        robot = scene.strip
        self._length = robot.length
        self._load = FlatLoad(robot, scene.ground.at(0.0).press(robot.width))
        arclength = node_positions(scene.strip, numerics.links)
        self._least = float(arclength[1])  # the first link lies flat as a whole
        pads = pads_by_node(model)
        begin, end = int(pads.min()), int(pads.max()) + 1
        self._heights = data.geom_xpos[begin:end, 2]  # of the pads, and of geoms between them
        self._rows = (pads[:, 0] - begin).tolist()
        self._only_pads = self._rows == list(range(end - begin))
        self._arclength: list[float] = arclength.tolist()
        place = np.full(model.ngeom, np.nan)
        place[pads] = arclength[:, None]
        self._place: list[float] = place.tolist()  # arclength of a pad, by its geom
        self._node: list[int] = node_of_geom(model, pads, other=-1).tolist()
        self._pads_alone = scene.ceiling is None
        pyramidal = model.opt.cone == mujoco.mjtCone.mjCONE_PYRAMIDAL
        self._pyramidal = bool(pyramidal) and model.geom_condim[pads[0, 0]] > 1
        self._six = np.zeros(6)

    def lengths(self, left: bool, right: bool) -> tuple[float, float]:
        """Lengths of side contact of the ends that may have one, 0 of the others [m]."""
        ends = self._sums()
        if ends is None:
            half = 0.5 * self._length
            return half * left, half * right
        (force_left, moment_left), (force_right, moment_right) = ends
        return (
            self._length_of(self._load.from_begin, force_left, moment_left) if left else 0.0,
            self._length_of(self._load.from_end, force_right, moment_right) if right else 0.0,
        )

    def loads(self) -> tuple[float, float]:
        """Normal force on the left and the right part of the strip [N]; halves lying flat."""
        ends = self._sums()
        if ends is None:
            half = 0.5 * self._length
            return self._load.from_begin.of(half), self._load.from_end.of(half)
        return ends[0][0], ends[1][0]

    def by_node(self) -> tuple[list[float], list[float]]:
        """Normal force on each node and its height, (N + 2,) each [N, m]."""
        force = [0.0] * len(self._rows)
        for geom, push in self._touching():
            force[self._node[geom]] += push
        return force, (self._pad_heights() - self._radius).tolist()

    def _length_of(self, load: LoadFrom, force: float, moment: float) -> float:
        return max(load.length(force, moment), self._least)

    def _sums(self) -> tuple[tuple[float, float], tuple[float, float]] | None:
        """Force and moment about its end of either part; None if no pad is in the air."""
        heights: list[float] = self._pad_heights().tolist()
        top = max(heights)
        if top <= self._radius:
            return None
        middle, end, place = self._arclength[heights.index(top)], self._length, self._place
        left = right = moment_left = moment_right = 0.0
        # the ground is a plane, and MuJoCo names the plane of a pair first
        for geom, push in self._touching():
            s = place[geom]
            if s < middle:
                left += push
                moment_left += push * s
            else:
                right += push
                moment_right += push * (end - s)
        return (left, moment_left), (right, moment_right)

    def _pad_heights(self) -> Array:
        """Heights of the centres of one pad per node, (N + 2,) [m]."""
        return self._heights if self._only_pads else self._heights[self._rows]

    def _touching(self) -> Iterable[tuple[int, float]]:
        """Pads that touch the ground, and the normal force on each [N]."""
        pairs = zip(self._data.contact.geom2.tolist(), self._pushes(), strict=True)
        if self._pads_alone:
            return pairs
        return [(geom, push) for geom, push in pairs if self._node[geom] >= 0]

    def _pushes(self) -> list[float]:
        """Normal force of each contact [N]."""
        rows = self._data.contact.efc_address.tolist()
        if self._pyramidal:
            return [self._normal(i) for i in range(len(rows))]
        forces = self._data.efc_force.tolist()
        forces.append(0.0)  # of contacts in an adhesive gap, whose row is -1
        return [forces[row] for row in rows]

    def _normal(self, contact: int) -> float:
        mujoco.mj_contactForce(self._model, self._data, contact, self._six)
        return self._six.item(0)
