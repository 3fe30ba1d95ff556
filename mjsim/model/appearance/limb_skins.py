"""Skins of a robot of limbs, and a camera that sees it."""

import mujoco
import numpy as np

from analytic.scene.limbs import chambers_by_limb, plan
from mjsim.model.appearance.skin import PER_CELL, add_strip_skins
from mjsim.model.bodies.limbs import limbed, link_prefix
from mjsim.scene import Resolved, Scene

CAMERA = "above"
_PLACE, _FOV = (0.17, -2.4, 1.75), 18.5  # of the camera, from what it looks at [L, degrees]
_BESIDE = 0.1  # L, how far to the right of the trunk it looks, where the ruler lies; chosen


def add_camera(spec: mujoco.MjSpec, scene: Scene) -> None:
    """A camera that sees the robot from its right and above."""
    camera = spec.worldbody.add_camera(name=CAMERA, fovy=_FOV)
    camera.pos = np.subtract(_PLACE, (0.0, _BESIDE, 0.0)) * scene.robot.length
    half = 0.5 * np.arctan2(-_PLACE[1], _PLACE[2])  # from straight down to the robot
    camera.quat = (np.cos(half), np.sin(half), 0.0, 0.0)


def add_skins(
    spec: mujoco.MjSpec, scene: Scene, numerics: Resolved, per_cell: int = PER_CELL
) -> None:
    """Give each chamber of a robot that lies flat the skin of a pneu-net, in a gait's order.

    Args:
        spec: the robot on its ground.
        scene, numerics: of the robot.
        per_cell: stations along a cell of a chamber.
    """
    robot = limbed(scene)
    flat = plan(robot)
    for limb, part in zip(robot.limbs, chambers_by_limb(robot), strict=True):
        names = [f"skin_{chamber}" for chamber in robot.chambers[part]]
        origin = (*flat[limb.name][0], 0.0)
        bodies = link_prefix(limb.name)
        add_strip_skins(spec, limb.strip, numerics, names, bodies, origin, limb.angle,
                        per_cell)  # fmt: skip
