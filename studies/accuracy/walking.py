"""The cases of walking, measured: one cycle of the gait on a ground."""

import math
from collections.abc import Iterator
from typing import Any

from analytic import REFERENCE, SOLVERS
from mjsim.results.measures import measure
from mjsim.results.prediction import HALF, displacement, links, prediction
from mjsim.scene import CONES, INTEGRATORS, Numerics, Scene
from mjsim.simulation.simulation import simulate
from studies.accuracy.benchmark_cases import COULOMB, WALK, scene_of, walked
from studies.accuracy.rows import Row
from studies.accuracy.setting import Setting, grid
from studies.accuracy.timing import Spent, Timing, repeated

WEAK, WITH_BAR = f"{REFERENCE}, weak friction", f"{REFERENCE}, with error bar"
_REFERENCES = {WEAK: (1.0,), REFERENCE: (1.0,), WITH_BAR: (1.0, HALF)}  # finenesses that each takes
_ELLIPTIC, _PYRAMIDAL = CONES
_USUAL = "discrete", _ELLIPTIC, Numerics.impratio
_BODIES: dict[str, list[Any]] = {  # see grid
    WALK: [
        ("chain", (6, 12, 18, 24, 48), (0.05, 0.02, 0.01, 0.005, 0.002, 0.001)),
        ("chain", (96,), (0.05, 0.02, 0.01, 0.005)),
        ("cable", (6, 12, 18, 24), (0.02, 0.01, 0.005)),
        ("cable", (48,), (0.02, 0.01)),
        ("rod", (6, 12, 18, 24, 48), (0.02, 0.01, 0.005, 0.002)),
        *(("chain", (12,), (0.005, 0.002, 0.001, 0.0005), name) for name in INTEGRATORS[1:]),
    ],
    COULOMB: [
        ("chain", (6, 12, 18, 24, 48), (0.02, 0.01, 0.005, 0.002, 0.001), *_USUAL),
        *(("chain", (12, 24), (0.02, 0.01, 0.005, 0.002), "discrete", _ELLIPTIC, impratio)
          for impratio in (1.0, 10.0, 1000.0)),
        *(("chain", (12,), (0.01, 0.005, 0.002, 0.001), "discrete", _PYRAMIDAL, impratio)
          for impratio in (1.0, Numerics.impratio)),
        *((body, (6, 12, 24), (0.01, 0.005, 0.002), *_USUAL) for body in ("cable", "rod")),
        *(("chain", (12,), (0.002, 0.001, 0.0005), name, *_USUAL[1:])
          for name in INTEGRATORS[1:]),
    ],
}  # fmt: skip
_LINKS = (12, 24, 60, 120)  # of the elastica; 60 are usual
_QUICK: dict[str, list[Any]] = {
    WALK: [("chain", (6, 12), (0.02, 0.01)), ("cable", (6,), (0.02,)), ("rod", (6,), (0.01,)),
           ("chain", (6,), (0.01,), "Euler")],
    COULOMB: [("chain", (6, 12), (0.02, 0.01), *_USUAL)],
}  # fmt: skip


def settings(case: str, quick: bool = False) -> Iterator[Setting]:
    """Every setting that is measured on a case, cheap ones first within a method."""
    links_of_elastica = _LINKS[:2] if quick else _LINKS
    if case == WALK:
        yield from (Setting(solver) for solver in SOLVERS if solver != REFERENCE)
        yield from (Setting(WEAK, n) for n in links_of_elastica)
    for method in (REFERENCE, WITH_BAR):
        yield from (Setting(method, n) for n in links_of_elastica)
    for block in (_QUICK if quick else _BODIES)[case]:
        yield from grid(*block)


def run(case: str, ground: str, setting: Setting) -> Row:
    """Measure one setting on one ground."""
    measured = (_solver if setting.timestep == 0 else _body)(case, ground, setting)
    return walked(case, ground, setting, *measured)


def _body(case: str, ground: str, setting: Setting) -> tuple[float, Timing, str]:
    scene, numerics = scene_of(case, ground, setting.method), setting.numerics()
    walk, timing = repeated(lambda: simulate(scene, numerics), scene.duration,
                            lambda walk: Spent(walk.wall_time, walk.cpu_time))  # fmt: skip
    numbers = measure(walk)
    return numbers.displacement if numbers else math.nan, timing, str(walk.status)


def _solver(case: str, ground: str, setting: Setting) -> tuple[float, Timing, str]:
    scene = scene_of(case, ground)
    name = REFERENCE if setting.method in _REFERENCES else setting.method
    finer, bent = setting.links / links(scene) if setting.links else 1.0, setting.method != WEAK
    walks, timing = repeated(
        lambda: [prediction(scene, name, finer * part, bent=bent)
                 for part in _REFERENCES.get(setting.method, (1.0,))],
        Scene().gait.period,  # however slow, a cycle of states costs the same
    )  # fmt: skip
    return displacement(scene, walks[0]), timing, "ok"
