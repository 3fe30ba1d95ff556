"""The engines of the benchmark, and the settings that each is measured at."""

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module

from benchmarks.engines.specification import QUADRUPED, STRIP, Task
from benchmarks.engines.walked import Walked

MANY = 256  # worlds of a batch
Grid = tuple[tuple[int, ...], tuple[float, ...], tuple[int, ...]]


@dataclass(frozen=True)
class Engine:
    """An engine that takes part.

    Attributes:
        name: in rows, tables and figures.
        module, function: of benchmarks.engines; function(task, links, timestep, worlds) -> Walked.
        package, install: whose version is told, and how to get it.
        settings: links, time steps from the longest [s] and numbers of worlds by the name of a
            task; tasks that are not there are not walked.
    """

    name: str
    module: str
    function: str
    package: str
    install: str
    settings: dict[str, Grid]

    def ladder(self, task: Task) -> Iterator[tuple[int, float, int]]:
        """Links, time steps and worlds of a task.

        Of more worlds than one the two longest steps alone, of MANY the longest, as they take long.
        """
        links, timesteps, numbers = self.settings.get(task.name, ((), (), ()))
        for worlds, n in itertools.product(numbers, links):
            count = len(timesteps) if worlds == 1 else 2 if worlds < MANY else 1
            for timestep in timesteps[:count]:
                yield n, timestep, worlds

    def load(self) -> Callable[[Task, int, float, int], Walked]:
        """Its function.

        Raises:
            ImportError: it is not installed.
        """
        return getattr(import_module(f"benchmarks.engines.{self.module}"), self.function)


_STRIP, _QUADRUPED = (6, 12, 24), (2, 4, 6)  # links of a limb
_STEPS = (0.02, 0.01, 0.005, 0.002)  # s


def _grids(strip: tuple[int, ...] = (1,), quadruped: tuple[int, ...] = (1,)) -> dict[str, Grid]:
    """Settings of engines that take long steps, by numbers of worlds."""
    return {STRIP.name: (_STRIP, _STEPS, strip), QUADRUPED.name: (_QUADRUPED, _STEPS, quadruped)}


ENGINES = {engine.name: engine for engine in (
    Engine("MuJoCo", "mujoco_engine", "alone", "mujoco", "pip install mujoco", _grids()),
    Engine("MuJoCo batch", "mujoco_engine", "batch", "mujoco", "pip install 'mujoco>=3.17'",
           _grids((1, 16, MANY), (1, 16))),
    Engine("undulator", "undulator_engine", "alone", "undulator", "pip install .", _grids()),
    Engine("undulator batch", "undulator_engine", "batch", "undulator", "pip install .",
           {STRIP.name: (_STRIP, _STEPS, (16,))}),
    Engine("Drake", "drake_engine", "walk", "drake", "pip install drake",
           {STRIP.name: (_STRIP, (0.01, 0.005, 0.002, 0.001), (1,)),
            QUADRUPED.name: (_QUADRUPED, (0.01, 0.005, 0.002, 0.001, 5e-4), (1,))}),
    Engine("PyElastica", "elastica_engine", "walk", "pyelastica", "pip install pyelastica",
           {STRIP.name: ((12, 18, 24), (7e-5, 5e-5), (1,))}),
)}  # fmt: skip
