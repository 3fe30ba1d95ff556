"""The engines of the benchmark, and the settings that each is measured at."""

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module

from benchmarks.engines.specification import QUADRUPED, STRIP, Task
from benchmarks.engines.walked import Walked

MANY = 256  # worlds of a batch


@dataclass(frozen=True)
class Engine:
    """An engine that takes part.

    Attributes:
        name: in rows, tables and figures.
        module, function: of benchmarks.engines; function(task, links, timestep, worlds) -> Walked.
        package, install: whose version is told, and how to get it.
        settings: links and time steps [s] by the name of a task; tasks that are not there are not
            walked.
        worlds: how many at a time.
    """

    name: str
    module: str
    function: str
    package: str
    install: str
    settings: dict[str, tuple[tuple[int, ...], tuple[float, ...]]]
    worlds: tuple[int, ...] = (1,)

    def ladder(self, task: Task) -> Iterator[tuple[int, float, int]]:
        """Links, time steps and worlds of a task; of MANY worlds the longest step alone."""
        links, timesteps = self.settings.get(task.name, ((), ()))
        for worlds, n, timestep in itertools.product(self.worlds, links, timesteps):
            if worlds < MANY or timestep == timesteps[0]:
                yield n, timestep, worlds

    def load(self) -> Callable[[Task, int, float, int], Walked]:
        """Its function.

        Raises:
            ImportError: it is not installed.
        """
        return getattr(import_module(f"benchmarks.engines.{self.module}"), self.function)


_MUJOCO = {
    STRIP.name: ((6, 12, 24), (0.02, 0.01, 0.005, 0.002)),
    QUADRUPED.name: ((2, 4, 6), (0.02, 0.01, 0.005, 0.002)),
}
ENGINES = {engine.name: engine for engine in (
    Engine("MuJoCo", "mujoco_engine", "alone", "mujoco", "pip install mujoco", _MUJOCO),
    Engine("MuJoCo batch", "mujoco_engine", "batch", "mujoco", "pip install 'mujoco>=3.17'",
           _MUJOCO, (1, 16, MANY)),
    Engine("undulator", "undulator_engine", "alone", "undulator", "pip install .", _MUJOCO),
    Engine("undulator batch", "undulator_engine", "batch", "undulator", "pip install .",
           {STRIP.name: ((6, 12, 24), (0.02, 0.01))}, (16, 64)),
    Engine("Drake", "drake_engine", "walk", "drake", "pip install drake",
           {STRIP.name: ((6, 12, 24), (0.01, 0.005, 0.002, 0.001)),
            QUADRUPED.name: ((2, 4, 6), (0.02, 0.01, 0.005, 0.002))}),
    Engine("PyElastica", "elastica_engine", "walk", "pyelastica", "pip install pyelastica",
           {STRIP.name: ((12, 18, 24), (7e-5, 5e-5))}),
)}  # fmt: skip
