"""Looks of a robot of limbs on its ground, from its side and from above."""

from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.limbs import LimbedRobot, plan
from analytic.scene.robot import Robot
from mjsim.model.appearance.limb_skins import add_camera, add_skins
from mjsim.model.appearance.stage import stage
from mjsim.model.bodies.limbs import limbed, tree_spec
from mjsim.model.ceiling import stretch
from mjsim.pictures.looks.look import RULED, Look
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

OVERHEAD = "overhead"
_THICKER = 0.15  # of its height, that a limb at full pressure looks thicker by; chosen
_HIGH, _WIDE = 3.0, 16.0  # of the camera straight above: height and field [L, degrees]


class LimbLook(Look):
    """Looks of a robot of limbs; see mjsim.pictures.camera.look."""

    def __init__(
        self, scene: Scene, numerics: Resolved, reach: float,
        more: Callable[[mujoco.MjSpec], None] | None = None,
    ) -> None:  # fmt: skip
        spec = tree_spec(scene, numerics, stage(scene.ground))
        robot = limbed(scene)
        spec.delete(spec.geom("start"))
        _lay_ruler(spec, robot)
        add_skins(spec, scene, numerics)
        add_camera(spec, scene)
        _add_overhead(spec, scene)
        if more:
            more(spec)
        super().__init__(spec, scene)
        self.model.stat.extent *= robot.length / Robot.length
        sizes = self.model.geom_size
        sizes[self.grounds, :2] = np.maximum(sizes[self.grounds, :2], reach)
        stretch(self.model, reach)
        strips = [limb.strip for limb in robot.limbs for _ in limb.strip.segments]
        self._thickness = [strip.flat_height for strip in strips]

    def pose(self, position: Array, coordinates: Array, fractions: Array) -> None:
        """Pose as Look.pose does; chambers look thicker as they fill."""
        self.model.skin_inflate[:] = _THICKER * fractions * self._thickness
        super().pose(position, coordinates, fractions)


def _lay_ruler(spec: mujoco.MjSpec, robot: LimbedRobot) -> None:
    """Lay the ruler beside a robot that it suits, its zero where that begins, or take it away."""
    ruler = spec.geom("ruler")
    if not RULED[0] <= robot.length <= RULED[1]:
        spec.delete(ruler)
        return
    flat = plan(robot)
    ends = np.array([flat[limb.name] for limb in robot.limbs])
    half = max(limb.strip.width for limb in robot.limbs) / 2
    aside = ends[..., 1].min() - half - ruler.size[1]
    ruler.pos = (ruler.pos[0] + ends[..., 0].min(), aside, ruler.pos[2])


def _add_overhead(spec: mujoco.MjSpec, scene: Scene) -> None:
    """A camera straight above the middle of the robot, ahead to the right of the picture."""
    robot = limbed(scene)
    camera = spec.worldbody.add_camera(name=OVERHEAD, fovy=_WIDE)
    flat = plan(robot)
    middle = np.mean([flat[name][1] for name in robot.outer], axis=0)
    camera.pos = (*middle, _HIGH * robot.length)
