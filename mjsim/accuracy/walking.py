"""The work of walking: one cycle of the default gait on felt and on gelatin."""

import math
from functools import cache, partial

from analytic import RUNGS, SURFACES, predict, solve_elastica
from mjsim.accuracy.grid import WORK, Setting, numerics_of
from mjsim.accuracy.rows import Row
from mjsim.accuracy.timing import Timing, repeated
from mjsim.config import Scene
from mjsim.measures import measure
from mjsim.simulate import simulate


@cache
def exact(ground: str) -> float:
    """Displacement per cycle over L of the reference, finer than it is used elsewhere."""
    scene = Scene(surface=SURFACES[ground])
    walk = predict(scene.robot, scene.gait, scene.surface, n_per_leg=100,
                   solver=lambda robot, p: solve_elastica(robot, p, links=120))  # fmt: skip
    return walk.locomotion.per_cycle / scene.robot.length


def run(setting: Setting, ground: str) -> Row:
    """Measure one setting on one ground."""
    value, timing, status = (_rung if setting.method in RUNGS else _body)(setting, ground)
    reference = exact(ground)
    error = abs(value / reference - 1) if status == "ok" else math.nan
    return Row(
        WORK, ground, setting.method, setting.integrator, setting.links, setting.timestep,
        value, reference, error, timing.least, timing.median, status,
    )  # fmt: skip


def _body(setting: Setting, ground: str) -> tuple[float, Timing, str]:
    scene, numerics = Scene(surface=SURFACES[ground], body=setting.method), numerics_of(setting)
    walk, timing = repeated(
        lambda: simulate(scene, numerics), scene.duration, lambda walk: walk.wall_time
    )
    found = measure(walk)
    return found.displacement if found else math.nan, timing, str(walk.status)


def _rung(setting: Setting, ground: str) -> tuple[float, Timing, str]:
    scene = Scene(surface=SURFACES[ground])
    solver = None
    if setting.links:
        solver = partial(solve_elastica, links=setting.links)
    walk, timing = repeated(
        lambda: predict(scene.robot, scene.gait, scene.surface, setting.method, solver=solver),
        scene.gait.period,
    )
    return walk.locomotion.per_cycle / scene.robot.length, timing, "ok"
