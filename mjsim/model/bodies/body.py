"""Protocols of a body: a strip as MJCF, and its joints once compiled."""

from collections.abc import Sequence
from typing import Any, Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]


class Joints(Protocol):
    """Joints of a compiled body: how pressure acts on them, and how its ends stand."""

    def loads(self, valves: Array, before: Array, pressures: Array) -> Sequence[Any]:
        """Arguments of `apply` at each of T steps, computed for all of them at once.

        Args:
            valves: commanded, (T, S) [Pa].
            before: pressure in the chambers before the first step, (S,) [Pa].
            pressures: in the chambers at the end of each step, (T, S) [Pa].
        """
        ...

    def apply(self, load: Any) -> None:
        """Set springs, forces or controls for the next step."""
        ...

    def slopes(self) -> tuple[float, float]:
        """Slopes of the left and the right end, positive where the strip rises inwards [rad]."""
        ...

    def shift(self, distance: float) -> None:
        """Move the whole strip by -x [m]."""
        ...


class Body(Protocol):
    """A model of the strip.

    Attributes:
        name: how commands and files call it.
    """

    name: str

    def check(self, scene: Scene, numerics: Resolved) -> None:
        """Check that the body can do what a scene asks for.

        Raises:
            ValueError: it cannot; the message names the reason.
        """
        ...

    def spec(self, scene: Scene, numerics: Resolved) -> mujoco.MjSpec:
        """The strip alone, flat along +x, its left end at the origin of its neutral line.

        It has pads and sites as mjsim.model.bodies.parts makes them.
        """
        ...

    def bind(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Resolved
    ) -> Joints:
        """The joints of the compiled model, whose names begin with "robot_"."""
        ...
