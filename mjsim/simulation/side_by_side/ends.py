"""Friction at the two ends, for many scenes at once.

As `mjsim.friction.traction` does it, with arrays over the scenes: `BoundedEndsBatch` as
`BoundedEnds`, `ContactFrictionBatch` as `ContactFriction`.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from analytic.friction.flat_load import flat_length
from analytic.friction.laws import slip_fraction
from analytic.scene.chain import node_positions
from mjsim.model.bodies.parts import FAR, PREFIX, TENDONS, contact_softness, tie_force
from mjsim.model.pads import pads_by_node
from mjsim.scene import Resolved, Scene
from mjsim.simulation.side_by_side.ground import GroundRows

Array = NDArray[np.float64]
Indices = NDArray[np.int_]
Flags = NDArray[np.bool_]


class StripParameters(NamedTuple):
    """Numbers of the strips that friction follows from, one row per scene.

    Attributes:
        width, half, weight: width, half the length, weight per length [m, m, N/m].
        tie: bound of the friction on the mean position of two ends that resist alike [N].
        arclength: of the nodes, (B, N + 2) [m].
        level: whether the ground is level.
    """

    width: Array
    half: Array
    weight: Array
    tie: Array
    arclength: Array
    level: Flags


def parameters(scenes: Sequence[Scene], numerics: Resolved) -> StripParameters:
    """Parameters of the strips of scenes."""
    robots = [s.strip for s in scenes]
    return StripParameters(
        width=np.array([r.width for r in robots]),
        half=np.array([0.5 * r.length for r in robots]),
        weight=np.array([r.weight_per_length for r in robots]),
        tie=np.array([tie_force(s, numerics) for s in scenes]),
        arclength=np.array([node_positions(r, numerics.links) for r in robots]),
        level=np.array([s.slope == 0 for s in scenes]),
    )


class EndsBatch(ABC):
    """Friction at the ends of the strips of a batch.

    Args:
        scenes, numerics: what is simulated.
        batch: by which.
        model: of its layout.

    Attributes:
        contact: lengths of side contact of the left and the right end, (B, 2) [m].
        left_slip: part of the next change of separation that the left end takes up, (B,); NaN where
            more than the two ends share the motion.
        drift: speed of what friction should have anchored in the last step, NaN where left_slip
            tells what that is, (B,) [m/s].
    """

    def __init__(
        self, scenes: Sequence[Scene], numerics: Resolved, batch: Batch, model: mujoco.MjModel
    ) -> None:
        pads = pads_by_node(model)[:, 0]
        self._left_pad, self._right_pad = int(pads[0]), int(pads[-1])
        assert np.array_equal(pads, np.arange(self._left_pad, self._right_pad + 1))
        self._parameters, self._ground = parameters(scenes, numerics), GroundRows(scenes)
        self._radius, self._numerics = numerics.pad_radius, numerics
        self._place, self._force = batch.bind("geom_xpos"), batch.bind("sensordata")
        self._rate, self._at = batch.bind("ten_velocity"), batch.bind("ten_length")
        self._tendons = np.array([model.tendon(PREFIX + name).id for name in TENDONS])
        count = len(scenes)
        self.contact: Array = np.zeros((count, 2))
        self.left_slip, self._slip = np.full(count, 0.5), np.zeros(count)
        self.drift: Array = np.full(count, np.nan)
        self._before: Array = np.zeros(count)

    def replace(self, rows: Indices, scenes: Sequence[Scene]) -> None:
        """Put other scenes in some rows."""
        for old, new in zip(self._parameters, parameters(scenes, self._numerics), strict=True):
            old[rows] = new
        self._ground.replace(rows, GroundRows(scenes))

    def start(self, rows: Indices) -> None:
        """Begin anew, once the strips lie on the ground."""
        self.contact[rows], self.left_slip[rows], self._slip[rows] = 0.0, 0.5, 0.0
        self._before[rows] = self._at[rows, self._tendons[1]]

    @abstractmethod
    def before_step(self, rows: Indices, slopes: Array, may_be_flat: Flags) -> None:
        """Read the contacts and set what resists in the next step.

        Args:
            rows: scenes that are stepped, (R,).
            slopes: of their ends, positive where the strip rises inwards, (R, 2) [rad].
            may_be_flat: whether the ends may lie on their side, by their pressure, (R, 2).
        """

    def after_step(self, rows: Indices, dt: float) -> Array:
        """See StripFriction.after_step of mjsim.friction.traction, (R,) [m]."""
        right, slip = self._tendons[1], self._slip[rows]
        at = self._at[rows, right]
        excess = slip * (dt * self._rate[rows, right] - (at - self._before[rows]))
        self._before[rows], self._slip[rows] = at - excess, self.left_slip[rows]
        return np.asarray(excess)

    def _look(self, rows: Indices, slopes: Array, may_be_flat: Flags) -> Flags:
        """Tell which ends lie on their side, (R, 2); note over what lengths."""
        sides = may_be_flat & (slopes <= self._numerics.side_angle)
        self.contact[rows] = np.where(sides, self._lengths(rows), 0.0) if sides.any() else 0.0
        return np.asarray(sides)

    def by_node(self, rows: Indices) -> tuple[Array, Array]:
        """Normal force on each node and its height, (R, N + 2) each [N, m]."""
        height = self._place[rows, self._left_pad : self._right_pad + 1, 2]
        return self._force[rows, ::3], height - self._radius

    def _left_is_faster(self, rows: Indices) -> Array:
        """1 where the left end moves faster than the right one, else 0, (R,)."""
        speed = np.abs(self._rate[rows][:, self._tendons[:2]])
        return np.asarray(1.0 * (speed[:, 0] > speed[:, 1]))

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


class BoundedEndsBatch(EndsBatch):
    """Bounds of the friction at the two ends, and softer ground under steep ends."""

    def __init__(
        self, scenes: Sequence[Scene], numerics: Resolved, batch: Batch, model: mujoco.MjModel
    ) -> None:
        super().__init__(scenes, numerics, batch, model)
        self._bounds, self._drags = (
            batch.expand("tendon_frictionloss"), batch.expand("tendon_damping")
        )  # fmt: skip
        self._softness = batch.expand("geom_solref")
        self._stiff = contact_softness(scenes[0], numerics)[0][0]
        self._soft = numerics.steep_contact_time * numerics.timestep

    def start(self, rows: Indices) -> None:
        """See EndsBatch.start."""
        super().start(rows)
        self._softness[rows[:, None], [self._left_pad, self._right_pad], 0] = self._stiff
        self._drags[rows[:, None], self._tendons] = 0.0

    def before_step(self, rows: Indices, slopes: Array, may_be_flat: Flags) -> None:
        """See EndsBatch.before_step."""
        strips, ground, tendons = self._parameters, self._ground, self._tendons
        self._look(rows, slopes, may_be_flat)
        contact = self.contact[rows]
        self._soften_if_steep(rows, slopes)
        begin = self._at[rows][:, tendons[:2]] - FAR
        begin[:, 1] -= contact[:, 1]
        bounds, drags = self._resistances(rows, begin, contact, self._rate[rows][:, tendons[:2]])
        self._drags[rows[:, None], tendons[:2]] = drags
        level = strips.level[rows]
        tied, decided = level & ~drags.any(axis=1), level & ~ground.by_speed[rows]
        left, right = bounds.T
        slip = slip_fraction(left, right)
        if not decided.all():
            slip = np.where(decided, slip, self._left_is_faster(rows))
        self._bounds[rows, tendons[0]], self._bounds[rows, tendons[1]] = left, right
        self._bounds[rows, tendons[2]] = np.where((left == right) & tied, strips.tie[rows], 0.0)
        self.left_slip[rows] = slip

    def _soften_if_steep(self, rows: Indices, slopes: Array) -> None:
        steep = slopes > self._numerics.steep_angle
        for pad, soft in zip((self._left_pad, self._right_pad), steep.T, strict=True):
            self._softness[rows, pad, 0] = np.where(soft, self._soft, self._stiff)

    def _resistances(
        self, rows: Indices, begin: Array, length: Array, speed: Array
    ) -> tuple[Array, Array]:
        """Bounds and viscous resistances of contacts, (R, K) each [N, N s/m].

        Args:
            rows: scenes that are stepped, (R,).
            begin, length: of the contacts, of tips no length, (R, K) [m].
            speed: at which they slide, (R, K) [m/s].
        """
        ground, width = self._ground, self._parameters.width[rows][:, None]
        shear, tip = (
            ground.over(name, rows, begin, length) for name in ("shear_strength", "tip_force")
        )
        bounds = np.where(length > 0, shear * (width * length), tip)
        if not ground.by_speed[rows].any():
            return bounds, np.zeros_like(bounds)
        drags = ground.over("viscosity", rows, begin, length) * width * length
        return bounds * ground.at_speed(rows, begin + 0.5 * length, speed), drags


class ContactFrictionBatch(EndsBatch):
    """Coulomb friction of the pads, by MuJoCo's own contacts."""

    def __init__(
        self, scenes: Sequence[Scene], numerics: Resolved, batch: Batch, model: mujoco.MjModel
    ) -> None:
        super().__init__(scenes, numerics, batch, model)
        self._friction = batch.expand("geom_friction")

    def before_step(self, rows: Indices, slopes: Array, may_be_flat: Flags) -> None:
        """See EndsBatch.before_step."""
        sides, pads = self._look(rows, slopes, may_be_flat), slice(self._left_pad,
                                                                   self._right_pad + 1)  # fmt: skip
        x = self._place[rows, pads, 0]
        friction = self._ground.at("friction", rows, x)
        tip = self._ground.at("tip_friction", rows, x[:, [0, -1]])
        friction[:, [0, -1]] = np.where(sides, friction[:, [0, -1]], tip)
        self._friction[rows, pads, 0] = friction
        self.left_slip[rows] = self._left_is_faster(rows)
