"""Names of the files of runs."""

import hashlib
import json
from dataclasses import asdict

from analytic.scene.gait import GAITS
from analytic.scene.limbs import ORDER, quadruped
from analytic.scene.quadruped_gaits import QUADRUPED_GAITS, for_robot
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from mjsim.scene import Numerics, Scene, resolved


def file_name(scene: Scene, numerics: Numerics) -> str:
    """File name of a run, alike for the same scene and numerics alone.

    The surface, after "limbs" for a robot of them; what of gait, body and friction is not the
    default; and, where anything else is not, a digest of everything.
    """
    gait = for_robot(Scene.gait, scene.robot)
    words = ["limbs"] * scene.in_space + [scene.ground.name]
    words += [w for w, d in ((scene.gait.name, gait.name), (scene.body, Scene.body),
                             (scene.friction, Scene.friction)) if w != d]  # fmt: skip
    named = [
        for_robot(named_gait, scene.robot)
        for named_gait in (*GAITS.values(), *QUADRUPED_GAITS.values())
    ]
    usual = Scene(
        robot=quadruped() if scene.in_space else Robot(),
        gait=scene.gait if scene.gait in [*named, *(gait.reversed() for gait in named)] else gait,
        ground=SURFACES.get(scene.ground.name, Scene.ground),
        body=scene.body,
        friction=scene.friction,
    ) if scene.robot.chambers in (ORDER, Robot().chambers) else None  # fmt: skip
    if usual is None or (scene, numerics) != (usual, resolved(usual)):
        described = json.dumps([repr(scene), asdict(numerics)], sort_keys=True)
        words.append(hashlib.sha256(described.encode()).hexdigest()[:8])
    return "-".join(words)
