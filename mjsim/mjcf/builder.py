"""The robot on its ground as MJCF: one way for every body, with mujoco.MjSpec."""

import mujoco

from mjsim import registry
from mjsim.bodies.parts import PREFIX, set_options
from mjsim.ground.stage import stage
from mjsim.scene import Numerics, Scene

TOUCH = 1e-6  # how deep the strip starts in the ground, over L: a contact at 0 is not seen; chosen


def scene_spec(scene: Scene, numerics: Numerics) -> mujoco.MjSpec:
    """The strip on its ground, with lights, cameras and ruler.

    Raises:
        ValueError: the body cannot do what the scene asks for.
    """
    body = registry.find(scene.body)
    body.check(scene, numerics)
    spec = stage(scene.ground)
    spec.modelname = scene.ground.name
    set_options(spec, scene, numerics)
    assert numerics.pad_radius is not None
    height = numerics.pad_radius - TOUCH * scene.robot.length
    start = spec.worldbody.add_frame(pos=(0.0, 0.0, height))
    spec.attach(body.spec(scene, numerics), prefix=PREFIX, frame=start)
    return spec


def compile_model(scene: Scene, numerics: Numerics) -> mujoco.MjModel:
    """The compiled model of a scene, which does not start anew by itself after a divergence.

    Args:
        scene: what is simulated.
        numerics: how, with a number for everything: see Numerics.resolved.

    Raises:
        ValueError: the body cannot do what the scene asks for, or mujoco refuses the model.
    """
    return scene_spec(scene, numerics).compile()
