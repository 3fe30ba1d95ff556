"""What a robot of limbs looks like on its ground: a skinned model that is posed, never stepped."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import link_lengths
from analytic.scene.robot import Robot
from analytic.solvers.limbs.limbs import outline, plan
from mjsim.bodies.parts import DARK, PALE
from mjsim.ground.stage import stage
from mjsim.tree.body import ROOT, hinge_names, limb_body, tree_spec
from mjsim.tree.scene import TreeNumerics, TreeScene
from mjsim.video.skin import PALE_SKIN, segment_skin

Array = NDArray[np.float64]

CAMERA, OVERHEAD = "above", "overhead"
_MARGIN = 0.25  # of the length that the robot may go before the camera follows
_SWOLLEN = 0.15  # of its height, that a limb at full pressure looks thicker by; chosen
_PLACE, _FOV = (0.17, -2.4, 1.75), 18.5  # of the camera, from the trunk's beginning [L, degrees]
_HIGH, _WIDE = 3.0, 16.0  # of the one straight above [L, degrees]


class Look:
    """A scene's looks.

    Args:
        scene, numerics: what was simulated.
        reach: how far from the origin it goes [m].

    Attributes:
        model, data: MuJoCo's, of the picture alone.
    """

    def __init__(self, scene: TreeScene, numerics: TreeNumerics, reach: float) -> None:
        spec = tree_spec(scene, numerics, stage(scene.ground))
        length, _ = outline(scene.robot)
        for name in ("ruler", "start"):
            spec.delete(spec.geom(name))
        add_skins(spec, scene, numerics)
        add_camera(spec, scene)
        _add_overhead(spec, scene)
        self.model = spec.compile()
        scale = length / Robot.length
        self.model.stat.extent *= scale
        for i in range(self.model.ngeom):
            if self.model.geom(i).name.startswith("surface"):
                self.model.geom_size[i, :2] = np.maximum(self.model.geom_size[i, :2], reach)
        strips = [limb.strip for limb in scene.robot.limbs]
        self._thickness = [strip.thickness + strip.chamber_height for strip in strips]
        self._length = length
        self._cameras = [self.model.camera(name).id for name in (CAMERA, OVERHEAD)]
        self._from = self.model.cam_pos[self._cameras, :2].copy()
        self.data = mujoco.MjData(self.model)
        joints = [self.model.joint(n) for n in hinge_names(scene.robot, numerics.elements)]
        self._order = np.array([*range(len(ROOT)), *(int(j.qposadr[0]) for j in joints)])

    def pose(self, coordinates: Array, fractions: Array) -> None:
        """Bend the robot, colour its chambers, and follow it with the camera.

        Args:
            coordinates: of analytic.solvers.limbs.kinematics, (Q,).
            fractions: of the peak pressure, (L,).
        """
        self.data.qpos[self._order] = coordinates
        gone = coordinates[:2]
        self.model.cam_pos[self._cameras, :2] = self._from + np.sign(gone) * np.maximum(
            np.abs(gone) - _MARGIN * self._length, 0.0
        )
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_camlight(self.model, self.data)
        pale, dark = np.array([*PALE, 1.0]), np.array([*DARK, 1.0])
        for limb, fraction in enumerate(fractions):
            self.model.skin_inflate[limb] = _SWOLLEN * fraction * self._thickness[limb]
            self.model.skin_rgba[limb] = pale + min(abs(fraction), 1.0) * (dark - pale)


def add_camera(spec: mujoco.MjSpec, scene: TreeScene) -> None:
    """A camera that sees the robot from its right and above."""
    camera = spec.worldbody.add_camera(name=CAMERA, fovy=_FOV)
    camera.pos = np.multiply(_PLACE, outline(scene.robot)[0])
    half = 0.5 * np.arctan2(-_PLACE[1], _PLACE[2])  # from straight down to the robot
    camera.quat = (np.cos(half), np.sin(half), 0.0, 0.0)


def _add_overhead(spec: mujoco.MjSpec, scene: TreeScene) -> None:
    """A camera straight above the middle of the robot, ahead to the right of the picture."""
    length = outline(scene.robot)[0]
    camera = spec.worldbody.add_camera(name=OVERHEAD, fovy=_WIDE)
    flat = plan(scene.robot)
    middle = np.mean([flat[name][1] for name in scene.robot.outer], axis=0)
    camera.pos = (*middle, _HIGH * length)


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
