"""Measure the engines that are installed, and draw: `python -m benchmarks.engines`."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from benchmarks.engines.engines import ENGINES
from benchmarks.engines.report import draw, table
from benchmarks.engines.rows import MEASURED, append, read, row
from benchmarks.engines.specification import TASKS


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.engines",
        description="Walk soft robots on frictional ground by every engine that is installed, at "
        "settings that the table lacks, one process and one thread; print the cheapest within "
        "10, 5, 2 and 0.5 %% of the distance, and draw error over speed. See docs/benchmark.md.",
    )
    parser.add_argument("--engine", choices=[*ENGINES, "all", "none"], default="all",
                        help="none: only the table and the figure")  # fmt: skip
    parser.add_argument("--task", choices=[*TASKS, "all"], default="all")
    parser.add_argument("--rows", type=Path, default=MEASURED,
                        help="table that rows are read from and appended to")  # fmt: skip
    parser.add_argument("--figure", type=Path, help="beside the table if not given")
    options = parser.parse_args(argv)
    try:
        rows = read(options.rows)
    except ValueError as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return 2
    tasks = list(TASKS) if options.task == "all" else [options.task]
    names = {"all": list(ENGINES), "none": []}.get(options.engine, [options.engine])
    for name in names:
        measure(name, tasks, options.rows, {row.key for row in rows})
    rows = read(options.rows)
    for task in tasks:
        print(f"\n{table(rows, task)}")
    picture = options.figure or options.rows.with_suffix(".png")
    try:
        draw(rows, picture)
        print(f"\n{picture}")
    except ImportError:
        print("\nno figure: pip install matplotlib")
    return 0


def measure(name: str, tasks: Sequence[str], path: Path, measured_keys: set) -> None:
    """Append the rows of an engine that a table lacks, or say how to install it."""
    engine = ENGINES[name]
    try:
        walk = engine.load()
    except ImportError as error:
        print(f"{name}: left out ({error}): {engine.install}", flush=True)
        return
    for task in (TASKS[task] for task in tasks):
        for links, timestep, worlds in engine.ladder(task):
            if (task.name, name, links, timestep, worlds) in measured_keys:
                continue
            made = row(task, name, engine.package, links, timestep, worlds,
                       walk(task, links, timestep, worlds))  # fmt: skip
            append(made, path)
            print(f"{task.name}, {name}, {links} links, {1e3 * timestep:g} ms, {worlds} worlds: "
                  f"{made.distance:+.5f} ({100 * made.error:.2g} % off), "
                  f"{made.world_seconds:.4g} s in a CPU second", flush=True)  # fmt: skip


if __name__ == "__main__":
    sys.exit(main())
