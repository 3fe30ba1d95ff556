"""What the MJCF of every body overlap: templates, friction of pads, names, rounding."""

import math
from typing import Any

from dm_control import mjcf

from mjsim.io.assets import MODELS
from mjsim.scene import Numerics, Scene

PALE, DARK = (0.86, 0.82, 0.72), (0.16, 0.17, 0.20)  # passive and inflated, as in Figure 4
FAR = 100.0  # m; a line to a point this far is horizontal to 1 part in 1e6
TENDONS = ("left", "right", "both")
DIGITS = 9

Pair = tuple[float, float]
Triple = tuple[float, float, float]


def template(name: str, scene: Scene, numerics: Numerics) -> mjcf.RootElement:
    """A file of models/ with the options of a scene."""
    root = mjcf.from_path(str(MODELS / name))
    root.option.timestep, root.option.integrator = numerics.timestep, numerics.integrator
    along, down = math.sin(scene.slope), math.cos(scene.slope)
    root.option.gravity = (0.0 - scene.gravity * along, 0, -scene.gravity * down)
    if scene.friction == "coulomb":
        root.option.cone, root.option.impratio = numerics.cone, numerics.impratio
    pads: Any = root.default.geom
    if pads.solref is not None:  # the template of the strip has its pads there
        pads.condim, pads.solref, pads.solimp = contact(scene, numerics)
    return root


def contact(scene: Scene, numerics: Numerics) -> tuple[int, Pair, Triple]:
    """Dimension, solref and solimp of the pads' contacts.

    Frictionless ones are as stiff as the discrete integrator bears. With friction MuJoCo's convex
    contact lifts a pad that slides by v off the ground by about mu v times its damping over its
    stiffness; a pad that is lifted off loses its load for a step and falls. So those are given
    little damping, and grow firm over a depth greater than that.
    """
    time = numerics.contact_time * numerics.timestep
    if scene.friction == "coulomb":
        return 3, (-0.125 / time**2, -0.5 / time), (0.9, 0.999, numerics.contact_depth)
    return 1, (time, 1.0), (0.999, 0.999, 0.001)


def tendon_bound(scene: Scene) -> float:
    """Dry friction that a tendon is compiled with [N]: without any it would get no row at all.

    Under the Coulomb law the tendons only measure.
    """
    return 1e-12 if scene.friction == "constant" else 0.0


def pad_friction(scene: Scene, at_end: bool) -> tuple[float, float, float]:
    """Coefficients of friction of a pad for the Coulomb law: sliding, and none of the others."""
    surface = scene.surface
    return rounded(scene.friction_scale * (surface.tip if at_end else surface.area)), 0.0, 0.0


def rounded(value: float) -> float:
    """The number in as many digits as the files have."""
    return float(f"{value:.{DIGITS}g}")
