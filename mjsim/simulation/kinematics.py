"""Places of the robot, from MuJoCo's coordinates."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.model.pads import Pads, pads_of
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]


def positions(model: mujoco.MjModel, scene: Scene, numerics: Resolved, coordinates: Array) -> Array:
    """Vertices of the neutral lines at each state, z over flat rest, (T, L, N + 2, 3) [m]."""
    data, pads = mujoco.MjData(model), pads_of(model, scene)
    position = np.empty((len(coordinates), *pads.shape, 3))
    for state, place in zip(coordinates, position, strict=True):
        data.qpos[:] = state
        mujoco.mj_kinematics(model, data)
        place[:] = data.geom_xpos[pads]
    return _above_rest(position.mean(axis=3), numerics)


def nodes_of(data: mujoco.MjData, pads: Pads, numerics: Resolved) -> Array:
    """Vertices of the neutral lines in a state whose kinematics are done, (L, N + 2, 3) [m]."""
    return _above_rest(data.geom_xpos[pads].mean(axis=2), numerics)


def _above_rest(position: Array, numerics: Resolved) -> Array:
    position[..., 2] -= numerics.pad_radius
    return position
