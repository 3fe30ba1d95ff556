"""What a robot of limbs looks like on its ground: a skinned model that is posed, never stepped."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.limbs import outline, plan
from analytic.scene.robot import Robot
from mjsim.model.limb_skins import CAMERA, add_camera, add_skins
from mjsim.model.limbs import ROOT, hinge_names, tree_spec
from mjsim.model.parts import DARK, PALE
from mjsim.model.stage import stage
from mjsim.scene.limbs import TreeNumerics, TreeScene

Array = NDArray[np.float64]

OVERHEAD = "overhead"
_MARGIN = 0.25  # of the length that the robot may go before the camera follows
_SWOLLEN = 0.15  # of its height, that a limb at full pressure looks thicker by; chosen
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


def _add_overhead(spec: mujoco.MjSpec, scene: TreeScene) -> None:
    """A camera straight above the middle of the robot, ahead to the right of the picture."""
    length = outline(scene.robot)[0]
    camera = spec.worldbody.add_camera(name=OVERHEAD, fovy=_WIDE)
    flat = plan(scene.robot)
    middle = np.mean([flat[name][1] for name in scene.robot.outer], axis=0)
    camera.pos = (*middle, _HIGH * length)
