"""Friction around each step of a simulation, by one protocol for every robot."""

from collections.abc import Sequence
from typing import Any, Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import end_flat_pressures
from mjsim.friction.between_ends import (
    BoundedContacts,
    ContactFrictionEverywhere,
    TetheredEnds,
    tether_tendons,
)
from mjsim.friction.ceiling import CeilingPush
from mjsim.friction.in_plane import LimbFooting
from mjsim.friction.traction import BoundedEnds, ContactFriction
from mjsim.model.bodies.body import Joints
from mjsim.model.pads import pads_by_node
from mjsim.results.status import END_HOPS
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

_COLUMNS = ("contact_left", "contact_right", "left_slip_fraction", "drift")


class Footing(Protocol):
    """A friction law at work on a compiled scene.

    Attributes:
        columns: names of the numbers that `after_step` gives.
    """

    columns: tuple[str, ...]

    def prepare(self, pressures: Array) -> Sequence[Any]:
        """Arguments of `before_step` at each step, from pressures in the chambers, (T, S) [Pa]."""
        ...

    def before_step(self, prepared: Any) -> None:
        """Read the contacts, and set what resists in the next step."""
        ...

    def after_step(self) -> tuple[float, ...]:
        """Take off how far the step moved anchors by its order alone; one number per column."""
        ...

    def stands(self) -> bool:
        """Tell whether the robot is as it can be on a walk."""
        ...

    def places(self) -> Array:
        """Places whose speed tells whether the robot is at rest [m]."""
        ...


class StripFooting:
    """Friction of a strip by its scene; see Footing.

    Args:
        scene, numerics: what is simulated.
        model, data: as compiled.
        joints: of the body.

    Attributes:
        columns: see Footing.
    """

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData,
        joints: Joints,
    ) -> None:  # fmt: skip
        by_load, bounded = (
            (ContactFrictionEverywhere, BoundedContacts) if scene.between
            else (ContactFriction, TetheredEnds if tether_tendons(scene, model) else BoundedEnds)
        )  # fmt: skip
        law = by_load if scene.friction == "coulomb" else bounded
        self._law = law(scene, numerics, model, data)
        self._ceiling = CeilingPush(model, data)
        self.columns = (*_COLUMNS, *self._ceiling.columns)
        self._slopes, self._shift, self._dt = joints.slopes, joints.shift, numerics.timestep
        self._before, self._after = self._law.before_step, self._law.after_step
        self._flat = end_flat_pressures(scene.strip, scene.ground.at(0.0))
        self._x = data.site_xpos[:, 0]
        pads = pads_by_node(model)
        self._feet = int(pads[0, 0]), int(pads[-1, 0])
        self._data, self._nodes, self._height = data, pads[:, 0], data.geom_xpos[:, 2]
        self._low, self._high = feet_may_be(scene, numerics)
        self._thrown = thrown(scene, numerics)

    def prepare(self, pressures: Array) -> Sequence[Any]:
        """Tell whether each end may lie on its side at each step, and what switches feet then."""
        flat = np.abs(pressures[:, [0, -1]]) <= self._flat
        if not self._law.grip.switched:
            return list(flat.tolist())
        return list(zip(*flat.T.tolist(), pressures.tolist(), strict=True))

    def before_step(self, prepared: Any) -> None:
        """See Footing.before_step."""
        if self._law.grip.switched:
            *prepared, self._law.pressures = prepared
        self._before(self._slopes(), *prepared)

    def after_step(self) -> tuple[float, ...]:
        """See Footing.after_step."""
        excess = self._after(self._dt)
        if excess:
            self._shift(excess)
        law = self._law
        pushed = self._ceiling.numbers()
        return law.contact_left, law.contact_right, law.left_slip, law.drift, *pushed

    def stands(self) -> bool:
        """Tell whether both ends are still feet, and the strip is not thrown."""
        low, high, (left, right), height = self._low, self._high, self._feet, self._height
        if not (low < height.item(left) < high and low < height.item(right) < high):
            return False
        return self._data.ncon > 0 or bool(height[self._nodes].min() < self._thrown)

    def places(self) -> Array:
        """Places of the ends, or of all nodes that may resist, along x [m]."""
        return np.array(self._x)


def feet_may_be(scene: Scene, numerics: Resolved) -> tuple[float, float]:
    """Heights between which the pad of a strip's end is while it is still a foot [m]."""
    reach = END_HOPS * numerics.hop * scene.robot.length
    return numerics.pad_radius - reach, numerics.pad_radius + reach


def thrown(scene: Scene, numerics: Resolved) -> float:
    """Height of the lowest pad from which on all of a strip has left the ground [m]."""
    return numerics.pad_radius + numerics.hop * scene.robot.length


def footing(
    scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData, joints: Any
) -> Footing:
    """The law of a scene at work."""
    if scene.in_space:
        return LimbFooting(scene, numerics, model, data)
    return StripFooting(scene, numerics, model, data, joints)
