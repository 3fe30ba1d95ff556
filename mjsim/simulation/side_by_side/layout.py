"""Scenes that can be stepped in one batch, and their models as rows of one.

Scenes whose models have the same parts differ by numbers only: each is compiled without anything to
look at, and the numbers go into the rows of `mujoco.batch.Batch.expand`.
"""

from collections.abc import Hashable, Sequence

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from analytic.scene.ground import Patches, is_round, surfaces_of
from analytic.scene.surface import Surface
from mjsim.model.bodies.parts import PREFIX
from mjsim.model.builder import bare_spec, compiled
from mjsim.scene import Resolved, Scene
from mjsim.simulation.schedule import before_start
from mjsim.simulation.side_by_side.between import BATCH_LAWS

# what MuJoCo computes of robots of one layout that differ; a test compares all other fields
FIELDS = (
    "actuator_acc0", "actuator_biasprm", "actuator_ctrlrange", "actuator_dynprm",
    "actuator_gainprm", "body_inertia", "body_invweight0", "body_ipos", "body_mass", "body_pos",
    "body_subtreemass", "bvh_aabb",
    "dof_M0", "dof_damping", "dof_invweight0", "dof_length", "geom_pos", "jnt_stiffness",
    "opt.gravity", "site_pos", "tendon_frictionloss", "tendon_invweight0", "tendon_length0",
    "tendon_lengthspring",
)  # fmt: skip


def refusal(scene: Scene, numerics: Resolved | None = None) -> str | None:
    """Reason why a scene cannot be stepped in a batch, or None if it can.

    Args:
        scene: the walk.
        numerics: how it is discretised; along straight paths if None.
    """
    ground = scene.ground
    if scene.in_space:
        return "the robot must be a strip"
    laws = {law for law, _ in BATCH_LAWS}
    if scene.body != "chain" or scene.friction not in laws:
        return f"body must be chain and friction {' or '.join(sorted(laws))}"
    if numerics and numerics.contact_path != "straight":
        return "contact paths must be straight"
    if scene.ceiling is not None:
        return "there must be no ceiling"
    if scene.chamber == "sealed":
        return "chambers must not be sealed"
    if not isinstance(ground, Surface | Patches):
        return "ground must be uniform, or patches"
    if any(surface.adhesion for surface in surfaces_of(ground)):
        return "ground must be without adhesion"
    if not is_round(ground):
        return "ground must resist alike in all directions"
    if scene.strip.feet:
        return "the strip must have no feet"
    if scene.strip.payload:
        return "the strip must have no payload"
    if scene.strip.tether:
        return "the strip must have no tether"
    return None


def layout(scene: Scene, numerics: Resolved) -> Hashable:
    """Numbers that all scenes of a batch have in common."""
    follows = scene.actuation == "actuators" and bool(scene.valves.time_constant)
    return (
        scene.friction, scene.between, scene.actuation, scene.chamber, follows,
        len(surfaces_of(scene.ground)), len(scene.strip.segments),
        len(before_start(scene, numerics)),
    )  # fmt: skip


def bare_model(scene: Scene, numerics: Resolved) -> mujoco.MjModel:
    """The model with nothing to look at, and a sensor of the ground's force for each pad.

    Raises:
        ValueError: MuJoCo refuses the model.
    """
    spec = bare_spec(scene, numerics)
    force = 1 << int(mujoco.mjtConDataField.mjCONDATA_FORCE)
    for node in range(numerics.links + 2):
        spec.add_sensor(
            name=f"push_{node}", type=mujoco.mjtSensor.mjSENS_CONTACT,
            objtype=mujoco.mjtObj.mjOBJ_GEOM, objname=f"{PREFIX}pad_{node}", intprm=[force, 0, 1],
        )  # fmt: skip
    return compiled(spec, scene, numerics)


def models(scenes: Sequence[Scene], numerics: Resolved) -> list[mujoco.MjModel]:
    """One model per scene; scenes that differ in gait, pressure and ground only share it.

    Raises:
        ValueError: MuJoCo refuses a model.
    """
    compiled_models: dict[Hashable, mujoco.MjModel] = {}
    keys = []
    for scene in scenes:
        robot = {k: v for k, v in vars(scene.strip).items() if k != "peak_pressure"}
        key = (*robot.items(), scene.gravity, scene.incline)
        if scene.actuation == "actuators":
            key = (*key, scene.strip.peak_pressure, scene.valves)
        if key not in compiled_models:
            compiled_models[key] = bare_model(scene, numerics)
        keys.append(key)
    return [compiled_models[key] for key in keys]


def write(batch: Batch, rows: Sequence[int], given: Sequence[mujoco.MjModel]) -> None:
    """Give rows of a batch the numbers of their models; `forward` or `reset` is to follow."""
    for name in FIELDS:
        values = batch.expand(name)
        for row, model in zip(rows, given, strict=True):
            values[row] = field(model, name)


def field(model: mujoco.MjModel, name: str) -> NDArray[np.float64]:
    """A field of a model, or of its options."""
    owner, _, key = name.rpartition(".")
    return np.asarray(getattr(model.opt if owner else model, key))
