"""Rows of the benchmark, kept as CSV: one setting of an engine on a task."""

import csv
import math
import os
import platform
import subprocess
from dataclasses import asdict, dataclass, fields
from importlib import metadata
from pathlib import Path

from benchmarks.engines.specification import Task
from benchmarks.engines.walked import Walked

HERE = Path(__file__).resolve().parents[2]
MEASURED = HERE / "docs" / "benchmark.csv"
BOUNDS = (0.10, 0.05, 0.02, 0.005)  # of the error, that the table is made for


@dataclass(frozen=True)
class Row:
    """One measurement.

    Attributes:
        task, engine: their names.
        links: elements of each limb.
        timestep: [s].
        worlds: how many were walked.
        distance: displacement over the task's length, of the world that is worst.
        error: of that distance, relative to the task's answer; NaN where a world diverged.
        steps: of each world.
        simulated: seconds of each world.
        cpu, wall: seconds for all worlds, without building and compiling.
        versions, machine, commit: of what and where.
    """

    task: str
    engine: str
    links: int
    timestep: float
    worlds: int
    distance: float
    error: float
    steps: int
    simulated: float
    cpu: float
    wall: float
    versions: str = ""
    machine: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[str, str, int, float, int]:
        """Key that tells a setting from others."""
        return self.task, self.engine, self.links, self.timestep, self.worlds

    @property
    def world_steps(self) -> float:
        """Worlds times steps in a CPU second."""
        return self.worlds * self.steps / self.cpu

    @property
    def world_seconds(self) -> float:
        """Worlds times simulated seconds in a CPU second."""
        return self.worlds * self.simulated / self.cpu


def row(task: Task, engine: str, package: str, links: int, timestep: float, worlds: int,
        walked: Walked) -> Row:  # fmt: skip
    """The row of what an engine gave back."""
    off = [abs(distance / task.answer - 1) for distance in walked.distances]
    worst = max(range(worlds), key=lambda i: math.inf if math.isnan(off[i]) else off[i])
    return Row(task.name, engine, links, timestep, worlds, float(walked.distances[worst]),
               float(off[worst]), walked.steps, task.duration, walked.cpu, walked.wall,
               versions(package), machine(), commit())  # fmt: skip


def versions(package: str) -> str:
    """Versions of Python, numpy and a package."""
    parts = [f"{name}={metadata.version(name)}" for name in (package, "numpy")]
    return " ".join([f"python={platform.python_version()}", *parts])


def machine() -> str:
    """Kind of this machine, in a few words."""
    return f"{platform.machine()} {platform.system()} {os.cpu_count()} cores"


def commit() -> str:
    """Short name of the commit; empty outside a repository."""
    try:
        words = ["git", "-C", str(HERE), "rev-parse", "--short", "HEAD"]
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def read(path: Path = MEASURED) -> list[Row]:
    """Rows of a file; none if it is not there.

    Raises:
        ValueError: its columns are not those of a Row.
    """
    if not path.is_file():
        return []
    names = [field.name for field in fields(Row)]
    with path.open(newline="") as file:
        lines = csv.DictReader(file)
        if lines.fieldnames != names:
            raise ValueError(f"{path} is no table of this benchmark: its columns are "
                             f"{lines.fieldnames}, not {names}")  # fmt: skip
        return [Row(**{field.name: field.type(line[field.name]) for field in fields(Row)})
                for line in lines]  # fmt: skip


def append(measured: Row, path: Path) -> None:
    """Write a row to the end of a file, below the names of the columns if it is the first."""
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = not path.is_file()
    with path.open("a", newline="") as file:
        lines = csv.DictWriter(file, [field.name for field in fields(Row)])
        if fresh:
            lines.writeheader()
        lines.writerow({name: f"{value:.6g}" if isinstance(value, float) else value
                        for name, value in asdict(measured).items()})  # fmt: skip


def best(rows: list[Row], task: str, engine: str, worlds: int, bound: float) -> Row | None:
    """The row of most simulated seconds in a CPU second whose error is within a bound, if any."""
    among = [r for r in rows if (r.task, r.engine, r.worlds) == (task, engine, worlds)]
    within = [r for r in among if r.error <= bound]  # a NaN is not
    return max(within, key=lambda r: r.world_seconds, default=None)
