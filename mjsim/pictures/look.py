"""What a robot looks like on its ground: a skinned model that is posed, and never stepped.

Any body is drawn by its trace in the x-z plane.
"""

from collections.abc import Callable
from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.ground import Patches
from analytic.scene.robot import Robot
from analytic.scene.surface import Ground
from mjsim.model.builder import scene_spec
from mjsim.model.parts import DARK, PALE
from mjsim.model.skin import add_skins
from mjsim.scene import Numerics, Scene

Array = NDArray[np.float64]

_RULED = (0.08, 0.20)  # lengths of robots that the ruler suits [m]


class Look:
    """A scene's looks.

    Args:
        scene: whose robot and ground it is.
        links: of the chain that was simulated.
        reach: how far from x = 0 it goes [m].
        more: adds to the model before it is compiled.

    Attributes:
        model, data: MuJoCo's, of the picture alone.
        scale: of the stage, 1 for the default robot.
    """

    def __init__(
        self,
        scene: Scene,
        links: int,
        reach: float,
        more: Callable[[mujoco.MjSpec], None] | None = None,
    ) -> None:
        drawn_as = replace(
            scene, body="planar", friction="constant", actuation="rest-angles",
            chamber="linearized", ground=_visible(scene.ground),
        )  # fmt: skip
        numerics = Numerics(links=links).resolved("planar", "constant")
        spec = scene_spec(drawn_as, numerics)
        add_skins(spec, scene.robot, numerics)
        if more:
            more(spec)
        self.model = spec.compile()
        self.scale = scene.robot.length / Robot.length
        self._fit(scene, reach)
        self.data = mujoco.MjData(self.model)

    def pose(self, nodes: Array, fractions: Array) -> None:
        """Bend the strip and colour its chambers.

        Args:
            nodes: vertices of its neutral line, z over flat rest, (N + 2, 3) [m].
            fractions: of the peak pressure, (S,).
        """
        slopes = slopes_of(nodes)
        self.data.qpos[:] = (nodes[0, 0], nodes[0, 2], slopes[0], *np.diff(slopes))
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_camlight(self.model, self.data)
        pale, dark = np.array([*PALE, 1.0]), np.array([*DARK, 1.0])
        for segment, fraction in enumerate(fractions):
            self.model.skin_rgba[segment] = pale + min(abs(fraction), 1.0) * (dark - pale)

    def _fit(self, scene: Scene, reach: float) -> None:
        """Scale the stage to the robot, and stretch the ground to how far it goes."""
        model, scale = self.model, self.scale
        model.stat.extent *= scale
        model.cam_pos[:] *= scale
        patched = isinstance(scene.ground, Patches)  # lengths along x are as they are
        grounds = [name for name in (model.geom(i).name for i in range(model.ngeom))
                   if name.startswith("surface")]  # fmt: skip
        for name in (*grounds, "ruler", "start", "table"):
            geom, x = model.geom(name).id, slice(1 if patched and name in grounds else 0, None)
            model.geom_pos[geom, x] *= scale
            model.geom_size[geom, x] *= scale
            if name in grounds and not patched:
                model.geom_size[geom, 0] = max(model.geom_size[geom, 0], reach)
        if not _RULED[0] <= scene.robot.length <= _RULED[1]:
            model.geom_rgba[model.geom("ruler").id, 3] = 0.0
        else:  # its ticks are centimetres, whatever the robot's length
            ruler = model.geom("ruler").id
            model.geom_pos[ruler, 0] /= scale
            model.geom_size[ruler, :2] /= scale


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
