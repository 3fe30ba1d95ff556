"""Push of the ceiling on a robot after each step."""

import mujoco
import numpy as np

from mjsim.model.ceiling import ceiling_of


class CeilingPush:
    """Reads the contacts of the step just done.

    Args:
        model, data: as compiled.

    Attributes:
        columns: names of the numbers that `numbers` gives, none where there is no ceiling.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data, self._ceiling = model, data, ceiling_of(model)
        self._six = np.zeros(6)
        self.columns: tuple[str, ...] = ("ceiling_force",) if self._ceiling >= 0 else ()

    def numbers(self) -> tuple[float, ...]:
        """Force of the whole ceiling on the robot, downwards [N]."""
        if not self.columns:
            return ()
        contact = self._data.contact
        push = 0.0
        for number in np.flatnonzero(contact.geom1 == self._ceiling).tolist():
            mujoco.mj_contactForce(self._model, self._data, number, self._six)
            push += self._six.item(0)
        return (push,)
