"""Skins of a robot of limbs, and a camera that sees it."""

import mujoco
import numpy as np

from analytic.scene.chain import node_positions
from analytic.scene.limbs import chambers_by_limb, plan
from mjsim.model.limbs import limb_body, limbed
from mjsim.model.skin import PALE_SKIN, segment_skin
from mjsim.scene import Resolved, Scene

CAMERA = "above"
_PLACE, _FOV = (0.17, -2.4, 1.75), 18.5  # of the camera, from the trunk's beginning [L, degrees]


def add_camera(spec: mujoco.MjSpec, scene: Scene) -> None:
    """A camera that sees the robot from its right and above."""
    camera = spec.worldbody.add_camera(name=CAMERA, fovy=_FOV)
    camera.pos = np.multiply(_PLACE, scene.robot.length)
    half = 0.5 * np.arctan2(-_PLACE[1], _PLACE[2])  # from straight down to the robot
    camera.quat = (np.cos(half), np.sin(half), 0.0, 0.0)


def add_skins(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> None:
    """Give each chamber of a robot that lies flat the skin of a pneu-net, in a gait's order."""
    robot = limbed(scene)
    flat = plan(robot)
    for limb, part in zip(robot.limbs, chambers_by_limb(robot), strict=True):
        origin, angle = np.append(flat[limb.name][0], 0.0), limb.angle
        c, s = np.cos(angle), np.sin(angle)
        turned = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        starts = node_positions(limb.strip, numerics.links)
        half = (np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2))
        for segment, chamber in enumerate(robot.chambers[part]):
            shape = segment_skin(limb.strip, numerics.links, segment, numerics.pad_radius)
            skin = spec.add_skin(name=f"skin_{chamber}", rgba=PALE_SKIN)
            skin.vert = (shape.vertex @ turned.T + origin).ravel()
            skin.face = shape.face.ravel()
            skin.bodyname = [limb_body(limb.name, link) for link, _, _ in shape.bones]
            skin.bindpos = np.ravel(
                [turned @ (starts[link], 0.0, 0.0) + origin for link, _, _ in shape.bones]
            )
            skin.bindquat = np.ravel([half] * len(shape.bones))
            skin.vertid = [moved.tolist() for _, moved, _ in shape.bones]
            skin.vertweight = [weight.tolist() for _, _, weight in shape.bones]
