"""Skins of a robot of limbs, and a camera that sees it."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import link_lengths
from analytic.scene.limbs import outline, plan
from mjsim.model.limbs import limb_body
from mjsim.model.skin import PALE_SKIN, segment_skin
from mjsim.scene.limbs import TreeNumerics, TreeScene

Array = NDArray[np.float64]

CAMERA = "above"
_PLACE, _FOV = (0.17, -2.4, 1.75), 18.5  # of the camera, from the trunk's beginning [L, degrees]


def add_camera(spec: mujoco.MjSpec, scene: TreeScene) -> None:
    """A camera that sees the robot from its right and above."""
    camera = spec.worldbody.add_camera(name=CAMERA, fovy=_FOV)
    camera.pos = np.multiply(_PLACE, outline(scene.robot)[0])
    half = 0.5 * np.arctan2(-_PLACE[1], _PLACE[2])  # from straight down to the robot
    camera.quat = (np.cos(half), np.sin(half), 0.0, 0.0)


def add_skins(spec: mujoco.MjSpec, scene: TreeScene, numerics: TreeNumerics) -> None:
    """Give each limb of a robot that lies flat the skin of a pneu-net."""
    flat = plan(scene.robot)
    for limb in scene.robot.limbs:
        shape = segment_skin(limb.strip, numerics.elements, 0, numerics.pad_radius)
        origin, angle = np.append(flat[limb.name][0], 0.0), limb.angle
        c, s = np.cos(angle), np.sin(angle)
        turned = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        starts = np.append(0.0, np.cumsum(_lengths(scene, limb.name, numerics)))
        skin = spec.add_skin(name=f"skin_{limb.name}", rgba=PALE_SKIN)
        skin.vert = (shape.vertex @ turned.T + origin).ravel()
        skin.face = shape.face.ravel()
        skin.bodyname = [limb_body(limb.name, link) for link, _, _ in shape.bones]
        skin.bindpos = np.ravel(
            [turned @ (starts[link], 0.0, 0.0) + origin for link, _, _ in shape.bones]
        )
        half = (np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2))
        skin.bindquat = np.ravel([half] * len(shape.bones))
        skin.vertid = [moved.tolist() for _, moved, _ in shape.bones]
        skin.vertweight = [weight.tolist() for _, _, weight in shape.bones]


def _lengths(scene: TreeScene, limb: str, numerics: TreeNumerics) -> Array:
    return link_lengths(scene.robot.limbs[scene.robot.place(limb)].strip, numerics.elements)
