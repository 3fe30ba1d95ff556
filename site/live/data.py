"""Data of the live page, from mjsim itself: models, grounds, gaits, and the theory's answers.

    python site/live/data.py build/live-data.json              # all gaits, two minutes
    python site/live/data.py build/live-data.json wave         # those that are named

What the page shows and what its script computes with is written here, so that each number has one
source. For its test there is, of each scene, how far mjsim walks too. Models are written as MJCF,
which rounds to six digits; the arrays that it rounds are written besides, and written over.
"""

import json
import math
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from analytic.friction.contact_length import end_flat_pressures, flat_pressures
from analytic.friction.flat_load import FlatLoad
from analytic.scene import pneunet
from analytic.scene.chain import element_lengths, node_positions, segment_overlap
from analytic.scene.gait import GAITS, Gait
from analytic.scene.limbs import LimbedRobot, chambers_by_limb, limbs_of
from analytic.scene.quadruped_gaits import QUADRUPED_GAITS
from analytic.scene.robot import Robot
from analytic.solvers.limbs.contact_search import parts_of
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.resting_limb import resting_limbs
from mjsim import SURFACES, Scene, measure, reference, simulate
from mjsim.files.assets import MODELS
from mjsim.friction.footing import feet_may_be, thrown
from mjsim.model.bodies.limbs import ROWS, hinge_prefix, joints_to, link_prefix, point_names
from mjsim.model.bodies.parts import PREFIX, TENDONS, contact_softness, tie_force
from mjsim.model.builder import bare_spec, compiled
from mjsim.model.pads import edges, pads_of
from mjsim.model.standalone.limbs import allow_rounding
from mjsim.results.prediction import HALF, error_bars
from mjsim.results.status import AT_REST, THROWN
from mjsim.scene import Resolved, resolved

LAWS = ("constant", "coulomb")
HINGE_PREFIX = f"{PREFIX}hinge_"  # of a strip
_LOOKS = ("cam_", "light_", "mat_", "tex_", "name", "geom_rgba", "site_size")  # no physics


def main() -> None:
    """Write the file."""
    path, names = Path(sys.argv[1]), sys.argv[2:]
    robots = {}
    for robot in ("strip", "quadruped"):
        gaits = [gait for gait in gaits_of(robot) if not names or gait.name in names]
        robots[robot] = {**of_robot(robot), "gaits": [of_gait(gait) for gait in gaits]}
    keys = [
        (robot, gait["name"], law, ground)
        for robot, written in robots.items() for gait in written["gaits"]
        for law in LAWS for ground in SURFACES
    ]  # fmt: skip
    with ProcessPoolExecutor() as pool:
        answers = dict(zip(map("/".join, keys), pool.map(answer, keys), strict=True))
    grounds = [
        {"name": ground.name, "tipForce": ground.tip_force, "shear": ground.shear_strength,
         "friction": ground.friction, "tipFriction": ground.tip_friction}
        for ground in SURFACES.values()
    ]  # fmt: skip
    # all but the rod, which has no controls
    models = sorted(path.name for path in MODELS.glob("*.xml") if path.stem != "rod")
    data = {"grounds": grounds, "robots": robots, "answers": answers, "models": models}
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(data, separators=(",", ":"), allow_nan=False), encoding="utf-8")


def gaits_of(robot: str) -> list[Gait]:
    """Named gaits of a robot, those of the strip reversed too."""
    named = list(GAITS.values())
    if robot == "quadruped":
        return [*(Scene(robot, gait=gait).gait for gait in named), *QUADRUPED_GAITS.values()]
    return [*named, *(gait.reversed() for gait in named)]


def of_gait(gait: Gait) -> dict[str, Any]:
    """Stages, in parts of the peak, and times of the ramps between them [s]."""
    return {"name": gait.name, "stages": gait.stages, "ramps": gait.ramp_times}


def answer(key: tuple[str, str, str, str]) -> dict[str, Any]:
    """Displacement over L and turn [rad] in a cycle, by the theory and as mjsim walks.

    Args:
        key: names of the robot, gait, law and ground.
    """
    robot, gait, law, ground = key
    chosen = next(each for each in gaits_of(robot) if each.name == gait)
    scene = Scene(robot, gait=chosen, ground=ground, friction=law)  # type: ignore[arg-type]
    fine, coarse = reference(scene), reference(scene, finer=HALF)
    error, turn_error = error_bars(scene, fine, coarse)
    ahead = float(fine.displacement[0])
    walked = measure(simulate(scene))
    return {
        "theory": {"ahead": ahead if math.isfinite(ahead) else None, "error": error,
                   "turn": fine.turn, "turnError": turn_error, "flags": fine.flags},
        "walk": walked and {"ahead": walked.displacement, "aside": walked.aside,
                            "turn": walked.turn},
    }  # fmt: skip


def of_robot(name: str) -> dict[str, Any]:
    """A robot: its models by friction law, and what the page's script needs of it."""
    scene = Scene(name)
    numerics = resolved(scene, None)
    robot = scene.robot
    flat = flat_pressures(robot, scene.ground.at(0.0))
    limbs = [
        {"name": limb.name, "length": limb.strip.length, "width": limb.strip.width,
         "height": limb.strip.flat_height, "angle": limb.angle,
         "arclength": node_positions(limb.strip, numerics.links).tolist(),
         "borders": limb.strip.borders, "chambers": [part.start, part.stop],
         "springs": _springs(limb.strip, numerics.links)}
        for limb, part in zip(limbs_of(robot), chambers_by_limb(robot), strict=True)
    ]  # fmt: skip
    common = {
        "length": robot.length, "peak": robot.peak_pressure, "flat": flat.tolist(), "limbs": limbs,
        "chambers": _chambers(robot),
        "timestep": numerics.timestep, "settle": scene.settle_time, "atRest": AT_REST,
    }  # fmt: skip
    of_kind = _of_limbs if scene.in_space else _of_strip
    laws = LAWS[:1] if scene.in_space else LAWS  # rows of points resist by either
    return common | {"models": {law: of_kind(Scene(name, friction=law)) for law in laws}}  # type: ignore[arg-type]


def _chambers(robot: Robot | LimbedRobot) -> list[str]:
    if isinstance(robot, LimbedRobot):
        return list(robot.chambers)
    return ["left", "middle", "right"]


def _springs(strip: Robot, links: int) -> dict[str, Any]:
    """Numbers of which joint_springs makes the springs of a limb's hinges."""
    overlap = segment_overlap(strip.borders, links) * element_lengths(strip, links)[:, None]
    return {
        "overlap": overlap.tolist(),
        "rigidity": pneunet.base_rigidity(strip),
        "stiffening": pneunet.rigidity_per_pressure(strip),
        "bending": pneunet.curvature_per_pressure(strip),
    }


def _model(scene: Scene, numerics: Resolved) -> tuple[mujoco.MjModel, dict[str, Any]]:
    """A model as mjsim walks it; and as MJCF, with the arrays that this rounds."""
    model = compiled(bare_spec(scene, numerics), scene, numerics)
    spec = bare_spec(scene, numerics)
    allow_rounding(spec)
    spec.option.tolerance, spec.option.disableflags = model.opt.tolerance, model.opt.disableflags
    spec.compile()
    text = spec.to_xml()
    read = mujoco.MjModel.from_xml_string(text)
    rounded = {}
    for name in dir(model):
        exact = getattr(model, name)
        is_physics = isinstance(exact, np.ndarray) and not name.startswith(_LOOKS)
        if is_physics and exact.dtype == float and not np.array_equal(exact, getattr(read, name)):
            rounded[name] = exact.ravel().tolist()
    return model, {"mjcf": " ".join(text.split()), "exact": rounded}


def _hinges(model: mujoco.MjModel, prefix: str, numerics: Resolved) -> dict[str, list[int]]:
    """Places of a limb's hinges among the joints, and of their angles among the coordinates."""
    joints = [model.joint(f"{prefix}{i}") for i in range(1, numerics.links + 1)]
    return {"hinges": [joint.id for joint in joints],
            "angles": [int(joint.qposadr[0]) for joint in joints]}  # fmt: skip


def _of_strip(scene: Scene) -> dict[str, Any]:
    """A strip under a law, see StripFriction."""
    numerics = resolved(scene, None)
    model, written = _model(scene, numerics)
    return written | {
        "pads": pads_of(model, scene)[0, :, 0].tolist(), **_hinges(model, HINGE_PREFIX, numerics),
        "tendons": [model.tendon(PREFIX + name).id for name in TENDONS],
        "flatEnds": end_flat_pressures(scene.strip, scene.ground.at(0.0)).tolist(),
        "weight": FlatLoad(scene.strip).weights[0][1], "width": scene.strip.width,
        "padRadius": numerics.pad_radius, "sideAngle": numerics.side_angle,
        "steepAngle": numerics.steep_angle, "stiff": contact_softness(scene, numerics)[0][0],
        "soft": numerics.steep_contact_time * numerics.timestep, "tie": tie_force(scene, numerics),
        "feet": feet_may_be(scene, numerics), "thrown": thrown(scene, numerics),
    }  # fmt: skip


def _of_limbs(scene: Scene) -> dict[str, Any]:
    """A robot of limbs, see LimbFooting."""
    numerics = resolved(scene, None)
    model, written = _model(scene, numerics)
    robot = scene.robot
    assert isinstance(robot, LimbedRobot)
    tree = Tree(robot, numerics.links, numerics.twists)
    resting = resting_limbs(tree)
    points = [
        {"limb": i, "part": part, "tendons": [model.tendon(f"{name}_0").id
                                              for name in point_names(limb.name, part)],
         "joints": len(joints_to(robot, numerics.links, i, numerics.twists))}
        for i, limb in enumerate(robot.limbs) for part in parts_of(limb, robot)
    ]  # fmt: skip
    hinges = [_hinges(model, hinge_prefix(name), numerics) for name in robot.names]
    return written | {
        "pads": edges(pads_of(model, scene)).tolist(), "padRadius": numerics.pad_radius,
        "twists": numerics.twists, **{key: [each for limb in hinges for each in limb[key]]
                                      for key in ("hinges", "angles")},
        "links": [[model.body(f"{link_prefix(name)}{i}").id for i in range(numerics.links + 1)]
                  for name in robot.names],
        "starts": [starts.tolist() for starts in tree.starts],
        "points": points, "rows": ROWS, "weight": robot.weight,
        "viscosity": robot.weight / scene.gravity / numerics.tie_time,
        "thrown": THROWN * robot.length,
        "resting": [
            {"fromEnd": limb.from_end, "carrier": limb.carrier, "at": limb.at, "share": limb.share,
             "free": limb.free, "near": limb.near, "ripple": limb.ripple, "aside": limb.aside,
             "weight": limb.load.weights[0][1], "segments": limb.segments,
             "arclength": limb.arclength}
            for limb in resting
        ],
    }  # fmt: skip


if __name__ == "__main__":
    main()
