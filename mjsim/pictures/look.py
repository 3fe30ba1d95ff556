"""What a robot looks like on its ground: a skinned model that is posed, and never stepped."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.model.parts import DARK, PALE

Array = NDArray[np.float64]


class Look:
    """A scene's looks.

    Args:
        spec: of the robot with its skins, one per chamber in a gait's order, on its ground.

    Attributes:
        model, data: MuJoCo's, of the picture alone.
    """

    def __init__(self, spec: mujoco.MjSpec) -> None:
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)

    def pose(self, position: Array, coordinates: Array, fractions: Array) -> None:
        """Bend the robot and colour its chambers.

        Args:
            position: vertices of its neutral lines, z over flat rest, (L, N + 2, 3) [m].
            coordinates: of MuJoCo as it was simulated, (nq,).
            fractions: of the peak pressure, (S,).
        """
        self._bend(position, coordinates)
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_camlight(self.model, self.data)
        pale, dark = np.array([*PALE, 1.0]), np.array([*DARK, 1.0])
        for chamber, fraction in enumerate(fractions):
            self.model.skin_rgba[chamber] = pale + min(abs(fraction), 1.0) * (dark - pale)

    def _bend(self, position: Array, coordinates: Array) -> None:
        self.data.qpos[:] = coordinates
