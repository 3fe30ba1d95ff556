"""How long each end lies on its side, from the forces of MuJoCo's contacts.

An end is a tip if its segment is inflated, since to lie flat it would need a moment that an end has
not, or if its first link is steeper than `side_angle`, whatever that link's length. Else it lies on
its side, over a length that follows from the ground's forces, finer than the pads.
"""

import math
import re

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.chain import node_positions
from mjsim.scene import Numerics, Scene

Array = NDArray[np.float64]


class Sides:
    """Reads the contacts of the step just done. Plain floats: numpy is slow on a few numbers.

    Args:
        scene, numerics: what is simulated.
        model, data: as compiled. The pads follow each other in order of their nodes, and each that
            is lower than its radius has one contact.
    """

    def __init__(
        self, scene: Scene, numerics: Numerics, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        self._data = data
        self._length, self._weight = scene.robot.length, scene.robot.weight_per_length
        nodes = node_positions(scene.robot, numerics.links)
        first, *others = pads_of(model, 0)
        abreast = 1 + len(others)
        self._first_link = float(nodes[1])
        self._nodes: list[float] = np.repeat(nodes, abreast).tolist()
        self._radius = numerics.pad_radius
        self._heights = data.geom_xpos[first : first + len(self._nodes), 2]
        # of a contact: a pyramid's edges add up to the normal force, else its row is the first
        self._pyramids = scene.friction == "coulomb" and numerics.cone == "pyramidal"
        self._rows = 4 if self._pyramids else 3 if scene.friction == "coulomb" else 1

    def lengths(self, left: bool, right: bool) -> tuple[float, float]:
        """Lengths of side contact of the ends that may have one, 0 of the others [m]."""
        data, heights = self._data, self._heights.tolist()
        top = max(heights)
        if top <= self._radius:
            half = 0.5 * self._length
            return half * left, half * right
        rows = data.efc_force[data.ne + data.nf :]
        if self._pyramids:
            force = rows.reshape(-1, self._rows).sum(axis=1).tolist()
        else:
            force = rows[:: self._rows].tolist()
        one = self._length_of(heights, force, top) if left else 0.0
        if not right:
            return one, 0.0
        heights.reverse()
        force.reverse()
        return one, self._length_of(heights, force, top)

    def _length_of(self, heights: list[float], force: list[float], top: float) -> float:
        """analytic.contact.flat_length of an end from pads and contacts counted from it.

        Its first link at least.
        """
        radius, nodes = self._radius, self._nodes
        total = moment = 0.0
        contact = 0
        for pad, height in enumerate(heights):
            if height < radius:
                if contact == len(force):
                    break  # the step burst half-way: pads moved that have no contacts yet
                push = force[contact]
                contact += 1
                total += push
                moment += push * nodes[pad]
            elif height == top:
                break
        root = total * total - 2.0 * self._weight * moment
        length = (total - math.sqrt(root if root > 0.0 else 0.0)) / self._weight
        return length if length > self._first_link else self._first_link


def pads_of(model: mujoco.MjModel, node: int) -> list[int]:
    """Geoms of the contact pads of one node, side by side, in order."""
    body = model.geom_bodyid[model.geom(f"robot/pad_{node}").id]
    name = re.compile(rf"robot/pad_{node}(_\d+)?")
    begin, count = int(model.body_geomadr[body]), int(model.body_geomnum[body])
    return [i for i in range(begin, begin + count) if name.fullmatch(model.geom(i).name)]
