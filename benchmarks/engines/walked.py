"""Result of an engine's function, and its stopwatch."""

import time
from collections.abc import Callable
from typing import Any, NamedTuple


class Walked(NamedTuple):
    """One setting of an engine.

    Attributes:
        distances: displacement of each world over the task's length, (W,); NaN where it diverged.
        steps: of each world.
        cpu, wall: seconds of all worlds, without building and compiling.
    """

    distances: Any
    steps: int
    cpu: float
    wall: float


def stopwatch() -> Callable[[], tuple[float, float]]:
    """A function that tells CPU and wall seconds since now."""
    wall, cpu = time.perf_counter(), time.process_time()
    return lambda: (time.process_time() - cpu, time.perf_counter() - wall)
