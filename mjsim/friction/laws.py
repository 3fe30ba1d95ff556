"""Which friction a scene has."""

import mujoco

from mjsim.friction.between_ends import BoundedContacts, ContactFrictionEverywhere
from mjsim.friction.traction import BoundedEnds, ContactFriction, Traction
from mjsim.scene import Resolved, Scene


def traction(
    scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
) -> Traction:
    """The law of a scene at work."""
    if scene.friction == "coulomb":
        by_load = ContactFrictionEverywhere if scene.between else ContactFriction
        return by_load(scene, numerics, model, data)
    bounded = BoundedContacts if scene.between else BoundedEnds
    return bounded(scene, numerics, model, data)
