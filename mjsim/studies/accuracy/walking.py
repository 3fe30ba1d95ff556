"""The cases of walking, measured: one cycle of the gait on a ground."""

import math

from analytic import SOLVERS, predict
from mjsim.scene import Scene
from mjsim.simulation.measures import measure
from mjsim.simulation.simulation import simulate
from mjsim.studies.accuracy.benchmark_cases import scene_of, walked
from mjsim.studies.accuracy.grid import numerics_of
from mjsim.studies.accuracy.rows import Row
from mjsim.studies.accuracy.setting import Setting
from mjsim.studies.accuracy.timing import Spent, Timing, repeated


def run(case: str, ground: str, setting: Setting) -> Row:
    """Measure one setting on one ground."""
    found = (_rung if setting.method in SOLVERS else _body)(case, ground, setting)
    return walked(case, ground, setting, *found)


def _body(case: str, ground: str, setting: Setting) -> tuple[float, Timing, str]:
    scene, numerics = scene_of(case, ground, setting.method), numerics_of(setting)
    walk, timing = repeated(
        lambda: simulate(scene, numerics),
        scene.duration,
        lambda walk: Spent(walk.wall_time, walk.cpu_time),
    )
    found = measure(walk)
    return found.displacement if found else math.nan, timing, str(walk.status)


def _rung(case: str, ground: str, setting: Setting) -> tuple[float, Timing, str]:
    scene = scene_of(case, ground)
    walk, timing = repeated(
        lambda: predict(scene.robot, scene.gait, scene.surface, setting.method,
                        links=setting.links, friction=scene.hold, chamber=scene.chamber),
        Scene().gait.period,  # however slow, a cycle of states costs the same
    )  # fmt: skip
    return walk.locomotion.per_cycle / scene.robot.length, timing, "ok"
