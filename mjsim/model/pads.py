"""The contact pads of a compiled model, by the limb and the vertex that they stand for."""

import re

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.limbs import LimbedRobot
from mjsim.model.bodies.parts import PREFIX
from mjsim.scene import Scene

Pads = NDArray[np.int_]

_PAD = re.compile(rf"{PREFIX}(?:(?P<limb>.+)_)?pad_(?P<node>\d+)(?:_\w+)?")


def pads_of(model: mujoco.MjModel, scene: Scene) -> Pads:
    """Geoms of the pads of each limb's vertices, those side by side last, (L, N + 2, A)."""
    if not isinstance(scene.robot, LimbedRobot):
        return pads_by_node(model)[None]
    return np.array([pads_by_node(model, name) for name in scene.robot.names])


def pads_by_node(model: mujoco.MjModel, limb: str | None = None) -> Pads:
    """Geoms of the pads of a strip, or of one limb, one row per vertex, (N + 2, A)."""
    nodes: dict[int, list[int]] = {}
    for geom in range(model.ngeom):
        match = _PAD.fullmatch(model.geom(geom).name)
        if match and match["limb"] == limb:
            nodes.setdefault(int(match["node"]), []).append(geom)
    return np.array([nodes[node] for node in sorted(nodes)])


def node_of_geom(model: mujoco.MjModel, pads: Pads, other: int = 0) -> Pads:
    """Number of the row of pads that each geom is in, other of those that are no pads, (G,)."""
    nodes = np.full(model.ngeom, other)
    nodes[pads] = np.arange(len(pads)).reshape(-1, *[1] * (pads.ndim - 1))
    return nodes


def edges(pads: Pads) -> Pads:
    """Pads of a robot in space as analytic.solvers.limbs has nodes: right edges, then left ones."""
    return np.concatenate([pads[..., 0].ravel(), pads[..., 1].ravel()])
