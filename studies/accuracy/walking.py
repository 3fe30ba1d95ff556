"""The cases of walking, measured: one cycle of the gait on a ground."""

import math
from dataclasses import replace

from analytic import SOLVERS, Elastica, predict
from mjsim.results.measures import measure
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate
from studies.accuracy.benchmark_cases import friction_of, scene_of, walked
from studies.accuracy.rows import Row
from studies.accuracy.setting import Setting
from studies.accuracy.timing import Spent, Timing, repeated


def run(case: str, ground: str, setting: Setting) -> Row:
    """Measure one setting on one ground."""
    measured = (_solver if setting.method in SOLVERS else _body)(case, ground, setting)
    return walked(case, ground, setting, *measured)


def _body(case: str, ground: str, setting: Setting) -> tuple[float, Timing, str]:
    scene, numerics = scene_of(case, ground, setting.method), setting.numerics()
    walk, timing = repeated(
        lambda: simulate(scene, numerics),
        scene.duration,
        lambda walk: Spent(walk.wall_time, walk.cpu_time),
    )
    numbers = measure(walk)
    return numbers.displacement if numbers else math.nan, timing, str(walk.status)


def _solver(case: str, ground: str, setting: Setting) -> tuple[float, Timing, str]:
    scene, solver = scene_of(case, ground), SOLVERS[setting.method]()
    friction = friction_of(case)
    if isinstance(solver, Elastica):
        solver = Elastica(setting.links, scene.chamber)
    else:  # no friction bends them
        friction = replace(friction, tension=0.0)
    walk, timing = repeated(
        lambda: predict(scene.strip, scene.gait, scene.ground, solver,
                        friction=friction),
        Scene().gait.period,  # however slow, a cycle of states costs the same
    )  # fmt: skip
    return walk.locomotion.per_cycle / scene.strip.length, timing, "ok"
