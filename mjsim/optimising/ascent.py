"""Ascent of gaits along the gradient of their distance by the pressures at their stages.

From gaits that are known, both ways, and on the grid of pressures that valves can follow. The
gradient is that of friction at the two ends on the ground that counts, see analytic.gradient; what
is accepted is better by the whole objective. Where there is no gradient an ascent ends.
"""

from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.gait import GAITS, Gait
from mjsim.optimising.objective import Objective
from mjsim.optimising.space import GRID, Space, on_grid
from mjsim.optimising.valve_times import within_supply

Array = NDArray[np.float64]

ASCENTS = 4  # from the best of the gaits that are known; chosen
EVALUATIONS = 24  # of an ascent, at most; chosen
_FIRST = 0.3  # step of the pressure, over its peak, that changes most; chosen
_LONGER, _SHORTER = 1.5, 0.4  # steps after one that succeeds, and one that fails; chosen
_LEVEL = 1e-4  # of the distance over L by a pressure over its peak, that is no slope; chosen


class Ascent(NamedTuple):
    """Gaits of one ascent.

    Attributes:
        best: the last, which is the best.
        values: objectives of the gaits that were tried, (K,).
        evaluations: of the objective and of its gradient.
    """

    best: Gait
    values: list[float]
    evaluations: int


def known_gaits(objective: Objective, space: Space) -> list[Gait]:
    """Gaits to begin at: the scene's, the middle of the space, those with names; all both ways."""
    scene = objective.scene
    named = [replace(gait, ramp_time=space.period / gait.ramps)
             for gait in GAITS.values() if gait.segments == space.chambers]  # fmt: skip
    both = {(gait.stages, gait.ramp_times): gait
            for one_way in (scene.gait, space.gait(space.middle()), *named) if one_way.repeats
            for gait in (one_way, one_way.reversed())}  # fmt: skip
    return [within_supply(gait, scene.robot, scene.valves) for gait in both.values()]


def ascents(
    objective: Objective, gaits: Sequence[Gait], values: Sequence[float], evaluations: int,
    pool: ProcessPoolExecutor | None = None,
) -> Iterator[Ascent]:  # fmt: skip
    """Ascents from the best of some gaits.

    Args:
        objective: to be maximised, see Objective.has_gradient.
        gaits, values: known ones, see known_gaits, and their objectives.
        evaluations: number at most.
        pool: processes, if there are any.
    """
    run = pool.map if pool else map
    order = np.argsort(-np.array(values), kind="stable")
    each = min(EVALUATIONS, evaluations // ASCENTS)
    chosen = [i for i in order[:ASCENTS] if np.isfinite(values[i])] if each > 1 else []
    yield from run(_ascend, [objective] * len(chosen), [gaits[i] for i in chosen],
                   [values[i] for i in chosen], [each] * len(chosen))  # fmt: skip


def _ascend(objective: Objective, gait: Gait, value: float, evaluations: int) -> Ascent:
    """Ascent from a gait of a known value."""
    scene, values, spent, step = objective.scene, [value], 0, _FIRST
    slope, cost = objective.gradient(gait)
    spent += cost
    while step > 0.5 * GRID and spent < evaluations:
        stages = np.array(gait.stages)[:-1]
        at_limit = (stages <= 0) & (slope < 0) | (stages >= 1) & (slope > 0)
        uphill = np.where(at_limit, 0.0, slope)
        if not np.abs(uphill).max() > _LEVEL:
            break
        moved = on_grid(np.clip(stages + step * uphill / np.abs(uphill).max(), 0.0, 1.0))
        if (moved == stages).all():
            break
        rows = tuple(map(tuple, np.vstack([moved, moved[:1]]).tolist()))
        tried = within_supply(replace(gait, name="best", stages=rows), scene.strip, scene.valves)
        values.append(objective(tried))
        spent += 1
        if values[-1] <= value:
            step *= _SHORTER
            continue
        gait, value, step = tried, values[-1], _LONGER * step
        if spent < evaluations:
            slope, cost = objective.gradient(gait)
            spent += cost
    return Ascent(gait, values, spent)
