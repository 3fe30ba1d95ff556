"""The work of walking: one cycle of the default gait on felt and on gelatin."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache, partial

from analytic import REFERENCE, RUNGS, SURFACES, predict, solve_elastica
from mjsim.accuracy.rows import Row
from mjsim.accuracy.timing import Timing, repeated
from mjsim.config import Numerics, Scene, default_numerics
from mjsim.measures import measure
from mjsim.simulate import simulate

WORK = "walk"
GROUNDS = ("felt", "gelatin")
_FIRM, _STEEP = 0.005, 0.02  # s, contact times of the default; the other integrators need ...
_FIRM_STEPS, _STEEP_STEPS = 2.0, 4.0  # ... at least so many steps; measured


@dataclass(frozen=True)
class Setting:
    """A method at one setting: a body with its numerics, or a quasi-static rung."""

    method: str
    links: int = 0
    timestep: float = 0.0
    integrator: str = ""

    def key(self, ground: str) -> tuple[str, str, str, str, int, float]:
        """That of its row on a ground."""
        return WORK, ground, self.method, self.integrator, self.links, self.timestep


def settings(quick: bool = False) -> Iterator[Setting]:
    """Every setting that is measured, cheap ones first within a method."""
    for rung in RUNGS:
        for count in (0,) if rung != REFERENCE else (12, 24, 60):
            yield Setting(rung, count)
    grid = [
        ("planar", "discrete", (6, 12, 18, 24, 48), (0.05, 0.02, 0.01, 0.005, 0.002, 0.001)),
        ("cable", "discrete", (6, 12, 24), (0.02, 0.01, 0.005)),
        ("rod", "discrete", (6, 12, 24), (0.02, 0.01, 0.005, 0.002)),
    ]
    grid += [("planar", name, (12, 24), (0.005, 0.002, 0.001, 0.0005))
             for name in ("Euler", "implicitfast", "implicit", "RK4")]  # fmt: skip
    if quick:
        grid = [("planar", "discrete", (6, 12), (0.02, 0.01)), ("cable", "discrete", (6,), (0.02,)),
                ("rod", "discrete", (6,), (0.01,)), ("planar", "Euler", (6,), (0.01,))]  # fmt: skip
    for method, integrator, links, timesteps in grid:
        for n in links:
            for timestep in timesteps:
                yield Setting(method, n, timestep, integrator)


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


def numerics_of(setting: Setting) -> Numerics:
    """The numerics of a body at a setting."""
    usual = default_numerics(setting.method)
    if setting.integrator != usual.integrator:
        usual = replace(
            usual,
            contact_time=max(_FIRM_STEPS, _FIRM / setting.timestep),
            steep_contact_time=max(_STEEP_STEPS, _STEEP / setting.timestep),
        )
    return replace(usual, links=setting.links, timestep=setting.timestep,
                   integrator=setting.integrator)  # fmt: skip


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
