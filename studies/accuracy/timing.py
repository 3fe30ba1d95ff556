"""Seconds of one core that a computation takes, measured so that noise can be told from cost."""

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
    """A function that tells the time since now."""
    wall, cpu = clock.perf_counter(), clock.process_time()
    return lambda: Spent(clock.perf_counter() - wall, clock.process_time() - cpu)


def repeated(
    case: Callable[[], Result], simulated: float, taken: Callable[[Result], Spent] | None = None
) -> tuple[Result, Timing]:
    """Last result of a case that is computed up to REPEATS times, and the timing.

    Args:
        case: the computation.
        simulated: seconds that it simulates.
        taken: reads off a result how long it took, where that is not all of it.
    """
    times: list[Spent] = []
    while len(times) < REPEATS and sum(spent.wall for spent in times) <= _ENOUGH:
        elapsed = stopwatch()
        result = case()
        times.append(taken(result) if taken else elapsed())
    walls, cpus = zip(*times, strict=True)
    seconds = min(cpus), statistics.median(cpus), min(walls)
    return result, Timing(*(value / simulated for value in seconds))
