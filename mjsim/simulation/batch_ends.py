"""Bounds of the friction at the two ends, for many scenes at once.

As `mjsim.friction.traction.BoundedEnds` does it, with arrays over the scenes.
"""

from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from analytic.friction.flat_load import flat_length
from analytic.friction.laws import slip_fraction
from analytic.scene.chain import node_positions
from mjsim.model.pads import pads_by_node
from mjsim.model.parts import PREFIX, TENDONS, contact_softness, tie_force
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]
Indices = NDArray[np.int_]


class StripParameters(NamedTuple):
    """Numbers that the bounds follow from, one row per scene.

    Attributes:
        width, half, weight: of the strip: width, half its length, weight per length [m, m, N/m].
        shear, tip: strengths of the ground [Pa, N].
        tie: bound of the friction on the mean position of two ends that resist alike [N].
        arclength: of the nodes, (B, N + 2) [m].
        level: whether the ground is level.
    """

    width: Array
    half: Array
    weight: Array
    shear: Array
    tip: Array
    tie: Array
    arclength: Array
    level: NDArray[np.bool_]


def parameters(scenes: Sequence[Scene], numerics: Resolved) -> StripParameters:
    """Parameters of scenes on uniform ground."""
    robots, surfaces = [s.strip for s in scenes], [s.ground.at(0.0) for s in scenes]
    return StripParameters(
        width=np.array([r.width for r in robots]),
        half=np.array([0.5 * r.length for r in robots]),
        weight=np.array([r.weight_per_length for r in robots]),
        shear=np.array([s.shear_strength for s in surfaces]),
        tip=np.array([s.tip_force for s in surfaces]),
        tie=np.array([tie_force(s, numerics) for s in scenes]),
        arclength=np.array([node_positions(r, numerics.links) for r in robots]),
        level=np.array([s.slope == 0 for s in scenes]),
    )


class BoundedEndsBatch:
    """Friction at the ends of the strips of a batch.

    Args:
        scenes, numerics: what is simulated.
        batch: by which.
        model: of its layout.

    Attributes:
        contact: lengths of side contact of the left and the right end, (B, 2) [m].
        left_slip: part of the next change of separation that the left end takes up, (B,).
    """

    def __init__(
        self, scenes: Sequence[Scene], numerics: Resolved, batch: Batch, model: mujoco.MjModel
    ) -> None:
        pads = pads_by_node(model)[:, 0]
        self._left_pad, self._right_pad = int(pads[0]), int(pads[-1])
        assert np.array_equal(pads, np.arange(self._left_pad, self._right_pad + 1))
        self._parameters = parameters(scenes, numerics)
        self._radius, self._numerics = numerics.pad_radius, numerics
        self._place, self._force = batch.bind("geom_xpos"), batch.bind("sensordata")
        self._rate, self._at = batch.bind("ten_velocity"), batch.bind("ten_length")
        self._bounds = batch.expand("tendon_frictionloss")
        self._softness = batch.expand("geom_solref")
        self._tendons = np.array([model.tendon(PREFIX + name).id for name in TENDONS])
        self._stiff = contact_softness(scenes[0], numerics)[0][0]
        self._soft = numerics.steep_contact_time * numerics.timestep
        count = len(scenes)
        self.contact: Array = np.zeros((count, 2))
        self.left_slip, self._slip = np.full(count, 0.5), np.zeros(count)
        self._before: Array = np.zeros(count)

    def replace(self, rows: Indices, scenes: Sequence[Scene]) -> None:
        """Put other scenes in some rows."""
        for old, new in zip(self._parameters, parameters(scenes, self._numerics), strict=True):
            old[rows] = new

    def start(self, rows: Indices) -> None:
        """Begin anew, once the strips lie on the ground."""
        self.contact[rows], self.left_slip[rows], self._slip[rows] = 0.0, 0.5, 0.0
        self._before[rows] = self._at[rows, self._tendons[1]]
        self._softness[rows[:, None], [self._left_pad, self._right_pad], 0] = self._stiff

    def before_step(self, rows: Indices, slopes: Array, may_be_flat: NDArray[np.bool_]) -> None:
        """Read the contacts and set what resists in the next step.

        Args:
            rows: scenes that are stepped, (R,).
            slopes: of their ends, positive where the strip rises inwards, (R, 2) [rad].
            may_be_flat: whether the ends may lie on their side, by their pressure, (R, 2).
        """
        ground, tendons = self._parameters, self._tendons
        sides = may_be_flat & (slopes <= self._numerics.side_angle)
        contact = (
            np.where(sides, self._lengths(rows), 0.0) if sides.any() else np.zeros_like(slopes)
        )
        steep = slopes > self._numerics.steep_angle
        for pad, soft in zip((self._left_pad, self._right_pad), steep.T, strict=True):
            self._softness[rows, pad, 0] = np.where(soft, self._soft, self._stiff)
        shear, tip, width = ground.shear[rows], ground.tip[rows], ground.width[rows]
        on_side = contact > 0
        bounds = np.where(on_side, shear[:, None] * (width[:, None] * contact), tip[:, None])
        left, right = bounds.T
        level = ground.level[rows]
        slip = slip_fraction(left, right)
        if not level.all():
            speed = np.abs(self._rate[rows][:, tendons[:2]])
            slip = np.where(level, slip, 1.0 * (speed[:, 0] > speed[:, 1]))
        self._bounds[rows, tendons[0]], self._bounds[rows, tendons[1]] = left, right
        self._bounds[rows, tendons[2]] = np.where((left == right) & level, ground.tie[rows], 0.0)
        self.contact[rows], self.left_slip[rows] = contact, slip

    def after_step(self, rows: Indices, dt: float) -> Array:
        """See StripFriction.after_step of mjsim.friction.traction, (R,) [m]."""
        right, slip = self._tendons[1], self._slip[rows]
        at = self._at[rows, right]
        excess = slip * (dt * self._rate[rows, right] - (at - self._before[rows]))
        self._before[rows], self._slip[rows] = at - excess, self.left_slip[rows]
        return np.asarray(excess)

    def _lengths(self, rows: Indices) -> Array:
        """Lengths of side contact of both ends if they are on their side, (R, 2) [m]."""
        heights = self._place[rows, self._left_pad : self._right_pad + 1, 2]
        force, place = self._force[rows, ::3], self._parameters.arclength[rows]
        top = heights.argmax(axis=1)
        inner = place < place[np.arange(len(rows)), top][:, None]
        end, weight = 2 * self._parameters.half[rows], self._parameters.weight[rows]
        lengths = []
        for part, reach in ((inner, place), (~inner, end[:, None] - place)):
            push = np.where(part, force, 0.0)
            total, moment = push.sum(axis=1), (push * reach).sum(axis=1)
            lengths.append(np.maximum(flat_length(weight, total, moment), place[:, 1]))
        flat = heights.max(axis=1) <= self._radius
        half = self._parameters.half[rows]
        return np.stack([np.where(flat, half, length) for length in lengths], axis=1)
