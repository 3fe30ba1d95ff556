"""The seed's friction law as bounds on what holds the two ends (section 2.2).

An end is a tip if its segment is inflated, since to lie flat it would need a moment that an end has
not, or if its first link is steeper than `side_angle`, whatever that link's length. Else it lies on
its side, over a length that follows from the ground's forces, finer than the pads.

Each end is then held along x by a dry friction of its own bound, V0 V_t or
V0 tau lambda / L_segment, and the physics lets the weaker one slide. Where both bounds are equal
that would leave undecided who slides: the seed's answer, both alike, is a dry friction on the mean
position of the ends, of bound V0 and in place of both.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic import Surface
from analytic.chain import node_positions
from analytic.touching import flat_length
from mjsim.config import Numerics, Scene

Array = NDArray[np.float64]


class Ends(NamedTuple):
    """Contact and friction of the two ends at one instant.

    Attributes:
        contact_left, contact_right: length of side contact, 0 for a tip [m].
        bound_left, bound_right, bound_both: of the friction along x on each end and on their
            mean position [N].
        left_share: part of a change of separation that the left end will take up.
    """

    contact_left: float
    contact_right: float
    bound_left: float
    bound_right: float
    bound_both: float
    left_share: float


class PaperLaw:
    """Constant bounds at tips, by area on sides, sharing on ties."""

    def __init__(self, scene: Scene, numerics: Numerics) -> None:
        self._surface: Surface = scene.surface
        self._scale = scene.force_scale
        self._angle = numerics.side_angle
        self._segment = scene.robot.segment_length
        self._nodes = node_positions(scene.robot, numerics.links)
        self._from_right = self._nodes[-1] - self._nodes
        self._length = scene.robot.length
        self._weight = scene.robot.weight_per_length

    def ends(
        self,
        angle_left: float,
        angle_right: float,
        height: Array,
        force: Array,
        pressure: Array,
    ) -> Ends:
        """Bounds for the next step.

        Args:
            angle_left, angle_right: slope of the first and last link, positive where the strip
                rises from its end [rad].
            height: of the vertices above their resting place on the ground, shape (N + 2,) [m].
            force: of the ground on the vertices, shape (N + 2,) [N].
            pressure: of the segments, shape (S,) [Pa].
        """
        left = right = 0.0
        side_left = angle_left <= self._angle and pressure[0] == 0
        side_right = angle_right <= self._angle and pressure[-1] == 0
        if side_left or side_right:
            top = int(height.argmax())
            if height[top] > 0:
                if side_left:
                    left = self._contact(force[:top], self._nodes[:top])
                if side_right:
                    right = self._contact(force[top + 1 :], self._from_right[top + 1 :])
            else:
                left = 0.5 * self._length if side_left else 0.0
                right = 0.5 * self._length if side_right else 0.0
        hold_left, hold_right = self._resistance(left), self._resistance(right)
        if hold_left == hold_right:
            return Ends(left, right, 0.0, 0.0, self._scale, 0.5)
        share = 0.0 if hold_left > hold_right else 1.0
        return Ends(left, right, hold_left, hold_right, 0.0, share)

    def _contact(self, force: Array, distance: Array) -> float:
        """Length of side contact from the forces on an end's half; its first link at least."""
        length = flat_length(self._weight, force.sum(), force @ distance)
        return max(float(length), float(self._nodes[1]))

    def _resistance(self, contact: float) -> float:
        """analytic.sliding_resistance for one float, which a step cannot wait for numpy to do."""
        if contact > 0:
            return self._scale * self._surface.area * contact / self._segment
        return self._scale * self._surface.tip
