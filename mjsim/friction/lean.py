"""Excess of the resistance to motion back over that to motion ahead, in MuJoCo.

MuJoCo's dry friction resists alike both ways. A contact that resists by V_a ahead and by V_b back
is one that resists by their mean, and a constant force towards +x of half their difference: it
breaks away ahead at V_a and back at V_b. A tendon's spring exerts it, so long that it pulls alike
wherever the robot is.
"""

import math
from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.model.bodies.parts import FAR

Array = NDArray[np.float64]

_STRETCH = 1e4  # m; a walk of 0.1 m changes the force by 1e-5 of it


class Lean:
    """Springs of the tendons of contacts.

    Args:
        model: as compiled.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._stiffness, self._rest = model.tendon_stiffness, model.tendon_lengthspring

    def set(self, tendon: int, force: float) -> None:
        """Let a tendon push its end by a force towards +x [N]."""
        self._stiffness[tendon] = abs(force) / _STRETCH
        self._rest[tendon] = FAR + math.copysign(_STRETCH, force)

    def of(self, tendon: int) -> float:
        """Force that was set [N]."""
        return math.copysign(self._stiffness.item(tendon) * _STRETCH, self._rest.item(tendon, 0))

    def forces(self) -> Array:
        """Forces of all tendons, towards +x, (T,) [N]."""
        return np.copysign(self._stiffness * _STRETCH, self._rest[:, 0])

    def both_ways(
        self, tendons: Sequence[int], bounds: Sequence[float]
    ) -> tuple[list[float], list[float]]:
        """Bounds ahead and back from their means [N]."""
        leans = [self.of(tendon) for tendon in tendons]
        pairs = list(zip(bounds, leans, strict=True))
        return [bound - lean for bound, lean in pairs], [bound + lean for bound, lean in pairs]
