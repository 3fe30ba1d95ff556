"""Looks of a scene, by the kind of its robot."""

from collections.abc import Callable

import mujoco

from mjsim.pictures.limb_look import LimbLook
from mjsim.pictures.look import Look
from mjsim.pictures.strip_look import StripLook
from mjsim.scene import Numerics, Scene, resolved


def look(
    scene: Scene, numerics: Numerics, reach: float,
    more: Callable[[mujoco.MjSpec], None] | None = None,
) -> Look:  # fmt: skip
    """Looks of a scene.

    Args:
        scene, numerics: what was simulated, and with how many links.
        reach: how far from x = 0 it goes [m].
        more: adds to the model before it is compiled.
    """
    kind = LimbLook if scene.in_space else StripLook
    return kind(scene, resolved(scene, numerics), reach, more)
