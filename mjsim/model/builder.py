"""The robot on its ground as MJCF: one way for every body, with mujoco.MjSpec."""

import mujoco
import numpy as np

from analytic.scene.feet import drops
from mjsim.files.assets import BARE
from mjsim.model.appearance.stage import stage
from mjsim.model.bodies.limbs import tree_spec
from mjsim.model.bodies.parts import PREFIX, set_options, start_height
from mjsim.model.ceiling import add_ceiling
from mjsim.scene import Resolved, Scene, registry

_CREEP = 0.1  # of friction that sticks; at 0.03 of it walks of the cable change by 4 %; measured
# of the solver, for limbs: by MuJoCo's own 1e-8 walks on tips err by up to 0.006 L, as points of a
_TOLERANCE = 1e-12  # tip share what holds it; costs 0.1 % of the time; measured


def scene_spec(scene: Scene, numerics: Resolved) -> mujoco.MjSpec:
    """The robot on its ground, with lights, cameras and ruler.

    Raises:
        ValueError: the body cannot do what the scene asks for.
    """
    spec = stage(scene.ground)
    spec.modelname = scene.ground.name
    return on_ground(spec, scene, numerics)


def bare_spec(scene: Scene, numerics: Resolved) -> mujoco.MjSpec:
    """The robot on a plane with nothing to look at."""
    return on_ground(mujoco.MjSpec.from_file(str(BARE)), scene, numerics)


def on_ground(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> mujoco.MjSpec:
    """The robot on a ground that is given as MJCF.

    Raises:
        ValueError: the body cannot do what the scene asks for.
    """
    if scene.in_space:
        return tree_spec(scene, numerics, spec)
    body = registry.find(scene.body)
    body.check(scene, numerics)
    set_options(spec, scene, numerics)
    height = start_height(scene.strip.length, numerics) + max(drops(scene.strip.feet))
    strip = body.spec(scene, numerics)
    for item in (*strip.worldbody.bodies, *strip.worldbody.sites):
        # not by a frame, which dm_control does not read
        item.pos = np.add(item.pos, (0.0, 0.0, height))
    spec.attach(strip, prefix=PREFIX, frame=spec.worldbody.add_frame())
    add_ceiling(spec, scene, numerics)
    return spec


def compile_model(scene: Scene, numerics: Resolved) -> mujoco.MjModel:
    """The compiled model of a scene, which does not start anew by itself after a divergence.

    Args:
        scene: what is simulated.
        numerics: how, with a number for everything: see Numerics.resolved.

    Raises:
        ValueError: the body cannot do what the scene asks for, or mujoco refuses the model.
    """
    # nothing to look at is needed to step a robot in space
    spec = bare_spec(scene, numerics) if scene.in_space else scene_spec(scene, numerics)
    return compiled(spec, scene, numerics)


def compiled(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> mujoco.MjModel:
    """Compile a spec.

    Raises:
        ValueError: mujoco refuses it.
    """
    try:
        model = spec.compile()
    except ValueError as error:
        if "mjMINVAL" not in str(error):
            raise
        raise ValueError(
            f"length {scene.robot.length:g} m is too small for {numerics.links} links: MuJoCo "
            "takes no link whose inertia is below 1e-15 kg m^2; take fewer links"
        ) from error
    if numerics.integrator == "discrete":
        # friction that sticks creeps by its force times this estimate of the inverse mass, times
        # 1 - d of its impedance d, of which MuJoCo takes 0.9999 at most
        model.tendon_invweight0[:] *= _CREEP
    if scene.in_space:
        model.opt.tolerance = _TOLERANCE
        # what hangs together is one island, which MuJoCo need not look for
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_ISLAND)
    return model
