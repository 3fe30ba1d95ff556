"""Scene as dm_control's Physics, with named measurements."""

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import flat_pressures
from mjsim.env.dm_binding import mujoco as dm_mujoco
from mjsim.env.dm_binding import wrapper
from mjsim.friction.contact_length import ContactForces
from mjsim.model.builder import compile_model
from mjsim.model.pads import pads_by_node
from mjsim.model.standalone.strips import walking_scene
from mjsim.scene import Numerics, Resolved, Scene, resolved

Array = NDArray[np.float64]


class Physics(dm_mujoco.Physics):  # type: ignore[misc]
    """Scene stepped by dm_control: friction by load and actuated chambers.

    Make one with `Physics.of(scene)`; its controls are the pressures of the segments [Pa].
    """

    _pads: NDArray[np.int_]
    _numerics: Resolved
    _scene: Scene
    _start: float

    @classmethod
    def of(cls, scene: Scene, numerics: Numerics | None = None) -> "Physics":
        """Make the physics of a scene, of body chain.

        Raises:
            ValueError: the body cannot do what the scene asks for.
        """
        if scene.in_space:
            raise ValueError(
                "Physics.of is for strips; of a robot of limbs dm_control loads what undulator "
                "export writes"
            )
        scene = walking_scene(scene)
        choice = resolved(scene, numerics)
        physics: Physics = cls.from_model(wrapper.MjModel(compile_model(scene, choice)))
        physics._scene, physics._numerics = scene, choice
        physics._pads = pads_by_node(physics.model.ptr)
        physics._start = float(physics.ends()[0, 0])
        return physics

    def ends(self) -> Array:
        """Places of the left and the right end on the neutral line, (2, 3) [m]."""
        return np.asarray(self.data.geom_xpos[self._pads[[0, -1]]].mean(axis=1))

    def displacement(self) -> float:
        """Displacement of the left end since the scene was made [m]."""
        return float(self.ends()[0, 0]) - self._start

    def contact_lengths(self) -> tuple[float, float]:
        """Lengths of side contact of both ends, 0 of an inflated one [m]."""
        model, data = self.model.ptr, self.data.ptr
        mujoco.mj_forward(model, data)  # dm_control leaves the forces of the step before
        forces = ContactForces(self._scene, self._numerics, model, data)
        flat = np.abs(self.pressures()) <= flat_pressures(self._scene.robot)
        return forces.lengths(bool(flat[0]), bool(flat[-1]))

    def pressures(self) -> Array:
        """Pressures that the segments are commanded, left first, (S,) [Pa]."""
        return np.array(self.data.ctrl)

    def height(self) -> float:
        """Greatest height of the neutral line over flat rest [m]."""
        return float(self.data.geom_xpos[self._pads, 2].max() - self._numerics.pad_radius)

    def observation(self) -> dict[str, Any]:
        """Measurements by name."""
        return {
            "ends": self.ends(),
            "contact_lengths": np.array(self.contact_lengths()),
            "pressures": self.pressures(),
            "displacement": self.displacement(),
            "height": self.height(),
        }
