"""How long each end lies on its side, from the forces of MuJoCo's contacts.

An end is a tip if its segment is inflated, since to lie flat it would need a moment that an end has
not, or if its first link is steeper than `side_angle`, whatever that link's length. Else it lies on
its side, over a length that follows from the ground's forces, finer than the pads.
"""

import math

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.chain import node_positions
from mjsim.config import Numerics, Scene

Array = NDArray[np.float64]


class Sides:
    """Reads the contacts of the step just done. Plain floats: numpy is slow on a few numbers.

    Args:
        scene, numerics: what is simulated.
        data: its state; the strip's first pad is the geom `first_pad`, the others follow in order,
            and each that is lower than its radius has one contact, frictionless.
    """

    def __init__(
        self, scene: Scene, numerics: Numerics, data: mujoco.MjData, first_pad: int
    ) -> None:
        self._data = data
        self._length, self._weight = scene.robot.length, scene.robot.weight_per_length
        self._nodes: list[float] = node_positions(scene.robot, numerics.links).tolist()
        self._radius = numerics.pad_radius
        self._heights = data.geom_xpos[first_pad : first_pad + len(self._nodes), 2]

    def lengths(self, left: bool, right: bool) -> tuple[float, float]:
        """Lengths of side contact of the ends that may have one, 0 of the others [m]."""
        data, heights = self._data, self._heights.tolist()
        top = max(heights)
        if top <= self._radius:
            half = 0.5 * self._length
            return half * left, half * right
        force = data.efc_force[data.nf :].tolist()
        one = self._length_of(heights, force, top) if left else 0.0
        if not right:
            return one, 0.0
        heights.reverse()
        force.reverse()
        return one, self._length_of(heights, force, top)

    def _length_of(self, heights: list[float], force: list[float], top: float) -> float:
        """analytic.touching.flat_length of an end from pads and contacts counted from it.

        Its first link at least.
        """
        radius, nodes = self._radius, self._nodes
        total = moment = 0.0
        contact = 0
        for pad, height in enumerate(heights):
            if height < radius:
                push = force[contact]
                contact += 1
                total += push
                moment += push * nodes[pad]
            elif height == top:
                break
        root = total * total - 2.0 * self._weight * moment
        length = (total - math.sqrt(root if root > 0.0 else 0.0)) / self._weight
        return length if length > nodes[1] else nodes[1]
