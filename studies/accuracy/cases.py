"""The cases of the accuracy study: their grids of settings, and the measurement of each."""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import asdict, replace
from typing import Any

from mjsim.results.provenance import machine
from studies.accuracy import cantilever_bodies, heavy_cantilever, walking
from studies.accuracy.benchmark_cases import GROUNDS
from studies.accuracy.setting import Setting
from studies.table import columns

CASES = (heavy_cantilever.CASE, *GROUNDS)


def grid(cases: Sequence[str], quick: bool) -> Iterator[tuple[Any, ...]]:
    """Arguments of `measured`, cheap ones first within a method."""
    for case in cases:
        walk = case in GROUNDS
        settings = walking.settings(case, quick) if walk else cantilever_bodies.settings(quick)
        scenes = GROUNDS[case] if walk else (heavy_cantilever.TIP,)
        for setting, scene in itertools.product(settings, scenes):
            values = {"case": case, "scene": scene, **asdict(setting)}
            yield tuple(values[name] for name in columns(measured))


def measured(
    case: str,
    scene: str,
    method: str,
    integrator: str,
    cone: str,
    impratio: float,
    links: int,
    timestep: float,
) -> dict[str, Any]:
    """The row of a setting on a scene of a case, measured on this machine."""
    setting = Setting(method, links, timestep, integrator, cone, impratio)
    if case == heavy_cantilever.CASE:
        row = cantilever_bodies.run(setting)
    else:
        row = walking.run(case, scene, setting)
    return asdict(replace(row, machine=machine()))
