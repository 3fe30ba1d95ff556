"""Seconds of one core that a piece of work takes, measured so that noise can be told from cost."""

import statistics
import time as clock
from collections.abc import Callable
from typing import NamedTuple, TypeVar

Result = TypeVar("Result")

REPEATS = 7
_ENOUGH = 1.0  # s of measuring after which no more repeats are made


class Timing(NamedTuple):
    """Least and median time of repeats, per simulated second."""

    least: float
    median: float


def repeated(
    work: Callable[[], Result], simulated: float, taken: Callable[[Result], float] | None = None
) -> tuple[Result, Timing]:
    """Do work up to REPEATS times, on one thread, and time it; the last result counts.

    Args:
        work: it.
        simulated: seconds that it simulates.
        taken: reads off a result how long it took, where that is not all of it [s].
    """
    times: list[float] = []
    while True:
        started = clock.perf_counter()
        result = work()
        times.append(taken(result) if taken else clock.perf_counter() - started)
        if len(times) >= REPEATS or sum(times) > _ENOUGH:
            return result, Timing(min(times) / simulated, statistics.median(times) / simulated)
