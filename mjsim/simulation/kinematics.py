"""Where the strip is, from MuJoCo's coordinates."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.friction.contact_length import pads_by_node
from mjsim.results.status import FALLEN
from mjsim.scene import Numerics, Scene

Array = NDArray[np.float64]


def ends_may_be(scene: Scene, numerics: Numerics) -> tuple[float, float]:
    """Heights between which the pad of an end is while it is still a foot [m]."""
    assert numerics.pad_radius is not None
    reach = FALLEN * scene.robot.length
    return numerics.pad_radius - reach, numerics.pad_radius + reach


def positions(model: mujoco.MjModel, numerics: Numerics, coordinates: Array) -> Array:
    """Vertices of the neutral line at each state, z over flat rest, (T, N + 2, 3) [m]."""
    data, pads = mujoco.MjData(model), pads_by_node(model)
    position = np.empty((len(coordinates), *pads.shape, 3))
    for state, place in zip(coordinates, position, strict=True):
        data.qpos[:] = state
        mujoco.mj_kinematics(model, data)
        place[:] = data.geom_xpos[pads]
    return _above_rest(position.mean(axis=2), numerics)


def nodes_of(data: mujoco.MjData, pads: NDArray[np.int_], numerics: Numerics) -> Array:
    """The same of one state whose kinematics are done, (N + 2, 3) [m]."""
    return _above_rest(data.geom_xpos[pads].mean(axis=1), numerics)


def _above_rest(position: Array, numerics: Numerics) -> Array:
    assert numerics.pad_radius is not None
    position[..., 2] -= numerics.pad_radius
    return position
