"""The works of walking, measured: one cycle of the gait on a ground."""

import math

from analytic import RUNGS, predict
from mjsim.accuracy.grid import numerics_of
from mjsim.accuracy.rows import Row
from mjsim.accuracy.scenes import scene_of, walked
from mjsim.accuracy.setting import Setting
from mjsim.accuracy.timing import Spent, Timing, repeated
from mjsim.config import Scene
from mjsim.measures import measure
from mjsim.simulate import simulate


def run(work: str, ground: str, setting: Setting) -> Row:
    """Measure one setting on one ground."""
    found = (_rung if setting.method in RUNGS else _body)(work, ground, setting)
    return walked(work, ground, setting, *found)


def _body(work: str, ground: str, setting: Setting) -> tuple[float, Timing, str]:
    scene, numerics = scene_of(work, ground, setting.method), numerics_of(setting)
    walk, timing = repeated(
        lambda: simulate(scene, numerics),
        scene.duration,
        lambda walk: Spent(walk.wall_time, walk.cpu_time),
    )
    found = measure(walk)
    return found.displacement if found else math.nan, timing, str(walk.status)


def _rung(work: str, ground: str, setting: Setting) -> tuple[float, Timing, str]:
    scene = scene_of(work, ground)
    walk, timing = repeated(
        lambda: predict(scene.robot, scene.gait, scene.surface, setting.method,
                        links=setting.links, friction=scene.hold, gas=scene.gas),
        Scene().gait.period,  # however slow, a cycle of states costs the same
    )  # fmt: skip
    return walk.locomotion.per_cycle / scene.robot.length, timing, "ok"
