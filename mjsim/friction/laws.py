"""Which friction a scene has."""

import mujoco

from mjsim.friction.everywhere import BoundedContacts
from mjsim.friction.traction import BoundedEnds, ContactFriction, Traction
from mjsim.scene import Numerics, Scene


def traction(
    scene: Scene, numerics: Numerics, model: mujoco.MjModel, data: mujoco.MjData
) -> Traction:
    """The law of a scene at work."""
    if scene.friction == "coulomb":
        return ContactFriction(scene, numerics, model, data)
    kind = BoundedContacts if scene.between else BoundedEnds
    return kind(scene, numerics, model, data)
