"""Places of the robot, from MuJoCo's coordinates."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.feet import proud
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
        place[:] = _on_line(model, data, pads, scene)
    return _above_rest(position.mean(axis=3), numerics)


def _on_line(model: mujoco.MjModel, data: mujoco.MjData, pads: Pads, scene: Scene) -> Array:
    """Places of the pads, those of feet that stand proud moved up to the neutral line."""
    places = data.geom_xpos[pads]
    if not (scene.in_space or not proud(scene.strip.feet)):
        up = data.geom_xmat[pads][..., [2, 5, 8]]
        places = places - model.geom_pos[pads][..., 2:] * up
    return np.asarray(places)


def nodes_of(
    model: mujoco.MjModel, data: mujoco.MjData, pads: Pads, scene: Scene, numerics: Resolved
) -> Array:
    """Vertices of the neutral lines in a state whose kinematics are done, (L, N + 2, 3) [m]."""
    return _above_rest(_on_line(model, data, pads, scene).mean(axis=2), numerics)


def _above_rest(position: Array, numerics: Resolved) -> Array:
    position[..., 2] -= numerics.pad_radius
    return position
