"""Looks of a strip on its ground, of any body, by its trace in the x-z plane."""

from collections.abc import Callable
from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.ground import Patches
from analytic.scene.robot import Robot
from analytic.scene.surface import Ground
from mjsim.model.appearance.skin import add_skins
from mjsim.model.builder import scene_spec
from mjsim.model.ceiling import stretch
from mjsim.pictures.looks.look import RULED, Look
from mjsim.scene import Numerics, Resolved, Scene, resolved

Array = NDArray[np.float64]


class StripLook(Look):
    """Looks of a strip; see mjsim.pictures.camera.look."""

    def __init__(
        self, scene: Scene, numerics: Resolved, reach: float,
        more: Callable[[mujoco.MjSpec], None] | None = None,
    ) -> None:  # fmt: skip
        drawn_as = replace(
            scene, body="chain", friction="constant", actuation="rest-angles",
            chamber="linearized", ground=_visible(scene.ground),
        )  # fmt: skip
        numerics = resolved(drawn_as, Numerics(links=numerics.links))
        spec = scene_spec(drawn_as, numerics)
        add_skins(spec, scene.strip, numerics)
        if more:
            more(spec)
        super().__init__(spec, scene)
        self._fit(scene, reach)
        stretch(self.model, reach)

    def _bend(self, position: Array, coordinates: Array) -> None:
        (nodes,) = position
        slopes = slopes_of(nodes)
        self.data.qpos[:] = (nodes[0, 0], nodes[0, 2], slopes[0], *np.diff(slopes))

    def _fit(self, scene: Scene, reach: float) -> None:
        """Scale the stage to the robot, and stretch the ground to how far it goes."""
        model, scale = self.model, scale_of(scene)
        model.stat.extent *= scale
        model.cam_pos[:] *= scale
        self.cameras *= scale
        patched = isinstance(scene.ground, Patches)  # lengths along x are as they are
        ruler, start, table = (model.geom(name).id for name in ("ruler", "start", "table"))
        for geom in (*self.grounds, ruler, start, table):
            scaled = slice(1 if patched and geom in self.grounds else 0, None)
            model.geom_pos[geom, scaled] *= scale
            model.geom_size[geom, scaled] *= scale
        if not patched:
            along = model.geom_size[self.grounds, 0]
            model.geom_size[self.grounds, 0] = np.maximum(along, reach)
        if not RULED[0] <= scene.strip.length <= RULED[1]:
            model.geom_rgba[ruler, 3] = 0.0
        else:  # its ticks are centimetres, whatever the robot's length
            model.geom_pos[ruler, 0] /= scale
            model.geom_size[ruler, :2] /= scale


def scale_of(scene: Scene) -> float:
    """Scale of the stage of a strip, 1 for the default robot."""
    return scene.strip.length / Robot.length


def slopes_of(nodes: Array) -> Array:
    """Direction in the x-z plane of each link between vertices (N + 2, 3), (N + 1,) [rad]."""
    x, _, z = np.diff(nodes, axis=0).T
    return np.asarray(np.unwrap(np.arctan2(z, x)))


def _visible(ground: Ground) -> Ground:
    """A ground that looks the same and that constant bounds can act on."""
    if isinstance(ground, Patches):
        return ground
    surface = ground.at(0.0)
    side = surface.shear_strength or surface.friction
    tip = surface.tip_force or surface.tip_friction or 0.0
    return replace(surface, name=ground.name, tip_force=tip, shear_strength=side)
