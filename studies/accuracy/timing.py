"""Seconds of one core that a piece of case takes, measured so that noise can be told from cost."""

import statistics
import time as clock
from collections.abc import Callable
from typing import NamedTuple, TypeVar

Result = TypeVar("Result")

REPEATS = 7
_ENOUGH = 1.0  # s of measuring after which no more repeats are made


class Spent(NamedTuple):
    """Seconds by the clock, and of all cores together."""

    wall: float
    cpu: float


class Timing(NamedTuple):
    """Least and median CPU time of repeats, and their least wall time, per simulated second."""

    least: float
    median: float
    wall: float


def stopwatch() -> Callable[[], Spent]:
    """Starts now; call what it returns for the time since."""
    wall, cpu = clock.perf_counter(), clock.process_time()
    return lambda: Spent(clock.perf_counter() - wall, clock.process_time() - cpu)


def repeated(
    case: Callable[[], Result], simulated: float, taken: Callable[[Result], Spent] | None = None
) -> tuple[Result, Timing]:
    """Do case up to REPEATS times, and time it; the last result counts.

    Args:
        case: it.
        simulated: seconds that it simulates.
        taken: reads off a result how long it took, where that is not all of it.
    """
    times: list[Spent] = []
    while True:
        spent = stopwatch()
        result = case()
        times.append(taken(result) if taken else spent())
        if len(times) >= REPEATS or sum(time.wall for time in times) > _ENOUGH:
            walls, cpus = zip(*times, strict=True)
            least, middle, wall = min(cpus), statistics.median(cpus), min(walls)
            return result, Timing(least / simulated, middle / simulated, wall / simulated)
