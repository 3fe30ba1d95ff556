"""Distances of many scenes on all cores or a cluster, into one file: `undulator sweep`."""

import json
import math
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import tyro

from analytic.checks import whole
from mjsim.files import plugins
from mjsim.files.command_line.cli import (
    BAD_INPUT,
    FAILED,
    Plugins,
    bar,
    fail,
    parse,
    say,
    strict_json,
    warn,
)
from mjsim.files.files import check_folder
from mjsim.files.text_table import counts
from mjsim.scene import Numerics

if TYPE_CHECKING:
    from mjsim.sweeps.executors import Workers
    from mjsim.sweeps.plan import Plan
    from mjsim.sweeps.rows import Job, Row
    from mjsim.sweeps.store import Store

PROGRAM = "undulator sweep"
EXAMPLES = ("--example > plan.toml", "plan.toml --out results.sqlite --export results.csv")
_ON = "the same command goes on from there"


@dataclass(frozen=True)
class Options:
    """Predict the distance of many scenes: a grid, a Latin hypercube or a list over any fields.

    Writes one SQLite file with one row per scene, which docs/sweeps.md describes; the same command
    goes on with a sweep that was stopped. Exit code 0: every scene has a row, and one a result; 2:
    bad input, every scene is refused; 3: the cluster is gone, or no scene has a result; 130:
    interrupted.
    """

    plan: Annotated[Path | None, tyro.conf.Positional] = None
    """the plan, a TOML file"""
    out: Path = Path("sweep.sqlite")
    """file of results"""
    workers: int | None = None
    """processes; one per core if not given"""
    scheduler: str | None = None
    """a Dask scheduler in place of them, as tcp://host:8786, started by `dask scheduler`, with
    `dask worker tcp://host:8786` on each machine"""
    plugin: Plugins = ()
    export: Path | None = None
    """write the rows to a .csv, .nc or .parquet file too"""
    json: bool = False
    """print one JSON object instead of the table"""
    example: bool = False
    """print a plan to begin with, and leave"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, EXAMPLES)
    from mjsim.sweeps.executors import LostError
    from mjsim.sweeps.export import check_ending, export
    from mjsim.sweeps.plan import EXAMPLE, read_plan
    from mjsim.sweeps.store import Store

    if options.example:
        say(EXAMPLE)
        return 0
    try:
        if options.plan is None:
            raise ValueError("plan must be a TOML file; --example prints one")
        if options.workers is not None:
            whole("workers", options.workers, 1)
        plugins.load(options.plugin)
        plan = read_plan(options.plan)
        for path in (options.out, options.export):
            if path is not None:
                check_folder(path.parent)
        if options.export:
            check_ending(options.export)
        workers = _workers(options)
        try:
            with Store(options.out, plan) as store:
                record = _swept(plan, store, workers)
                code, why = _end(record, store)
        finally:
            workers.close()
        if options.export:
            export(options.out, options.export)
    except (ValueError, OSError, ModuleNotFoundError) as error:
        fail(PROGRAM, str(error))
    except LostError as error:
        warn(PROGRAM, f"{error}; {_ON}")
        return FAILED
    files = [str(path) for path in (options.out, options.export) if path]
    say(strict_json({**record, "files": files}) if options.json else _text(record, files))
    if why:
        warn(PROGRAM, f"error: {why}")
    return code


def _swept(plan: "Plan", store: "Store", workers: "Workers") -> dict[str, Any]:
    """Sweep; errors after which the same command goes on say so."""
    try:
        return sweep(plan, store, workers)
    except KeyboardInterrupt as error:
        raise KeyboardInterrupt(_ON) from error
    except OSError as error:
        raise OSError(f"{error}; {_ON}") from error


def _end(record: dict[str, Any], store: "Store") -> tuple[int, str]:
    """Exit code, and why it is not 0: no scene has a result."""
    from mjsim.sweeps.rows import CRASHED, REFUSED

    if record["status"].keys() - {REFUSED, CRASHED}:
        return 0, ""
    ((message,),) = store.select("select message from scenes order by id limit 1")
    why = f"no scene has a result; give another out once this is mended: {message}"
    return FAILED if CRASHED in record["status"] else BAD_INPUT, why


def _workers(options: Options) -> "Workers":
    from mjsim.sweeps.executors import Cluster, Processes

    if options.scheduler is not None:
        return Cluster(options.scheduler)
    return Processes(options.workers)


def sweep(plan: "Plan", store: "Store", workers: "Workers") -> dict[str, Any]:
    """Predict the scenes of a plan that have no result yet.

    Returns:
        Numbers of scenes, of those done by this call and of each status; seconds; confirmations.

    Raises:
        ValueError: no numerics suffice for the base scene.
        LostError: the cluster is gone.
    """
    from mjsim.sweeps.drive import drive, jobs
    from mjsim.sweeps.numerics import picked
    from mjsim.sweeps.rows import Job

    began, count = time.perf_counter(), 0
    finer: Numerics | None = None
    numerics: Numerics | None = None
    if plan.model == "mujoco" and plan.tolerance is not None:
        text = store.note("numerics")
        if text is None:
            text = json.dumps([asdict(choice) for choice in picked(plan)])
            store.note("numerics", text)
        numerics, finer = (Numerics(**part) for part in json.loads(text))
    template = Job(plan.base, plan.model, (), numerics, plan.tolerance or 0.02, plan.states,
                   plan.bent)  # fmt: skip
    (before,) = store.select("select count(*) from scenes")[0]
    with bar(f"sweep of {len(plan):,}", len(plan) - before) as advance:

        def keep(rows: "list[Row]", job: "Job") -> None:
            nonlocal count
            store.add(rows, dict(job.points))
            count += len(rows)
            advance(len(rows))

        drive(jobs(plan, store, template, workers.count), workers, keep)
    if finer is not None:
        _confirm(plan, store, workers, template, finer)
    return _record(plan, store, count, time.perf_counter() - began)


def _confirm(
    plan: "Plan", store: "Store", workers: "Workers", template: "Job", finer: Numerics
) -> None:
    """Walk some scenes again by finer numerics, evenly spread over the plan."""
    from dataclasses import replace

    from mjsim.sweeps.drive import drive

    count = min(plan.confirm, len(plan))
    numbers = {round((i + 0.5) * len(plan) / count - 0.5) for i in range(count)}
    confirmed = {n for (n,) in store.select("select id from confirmations")}
    todo = [
        replace(template, points=[(n, plan.point(n))], numerics=finer)
        for n in sorted(numbers - confirmed)
    ]
    drive(todo, workers, lambda rows, job: store.confirm(rows))


def _record(plan: "Plan", store: "Store", count: int, seconds: float) -> dict[str, Any]:
    from analytic.solvers.models import SOLVERS
    from mjsim.results.prediction import WEAK

    statuses, directions = (
        dict(store.select(f"select {column}, count(*) from scenes where {column} is not null "
                          f"group by {column} order by 2 desc"))
        for column in ("status", "direction")
    )  # fmt: skip
    pairs = store.select(
        "select s.displacement_over_L, c.displacement_over_L, s.status = c.status from scenes s "
        "join confirmations c using (id)"
    )
    weak = plan.model in SOLVERS and not plan.bent
    record = {
        "model": f"{plan.model}, {WEAK}" if weak else plan.model,
        "scenes": len(plan),
        "done_now": count,
        "wall_time_s": seconds,
        "status": statuses,
        "direction": directions,
    }
    text = store.note("numerics")
    if text is not None and plan.tolerance is not None:
        from mjsim.simulation.checked import allowed

        numerics = json.loads(text)[0]
        apart = [abs(a - b) for a, b, _ in pairs if a is not None and b is not None]
        close = sum(
            abs(a - b) <= allowed(b, plan.tolerance)
            if a is not None and b is not None else bool(alike)
            for a, b, alike in pairs
        )  # fmt: skip
        record |= {"links": numerics["links"], "timestep_s": numerics["timestep"],
                   "confirmed": len(pairs), "within_tolerance": close,
                   "largest_change_over_L": max(apart, default=math.nan)}  # fmt: skip
    return record


def _text(record: dict[str, Any], files: list[str]) -> str:
    rate = record["wall_time_s"] / max(record["done_now"], 1)
    lines = [
        f"{record['scenes']:,} scenes by {record['model']}, {record['done_now']:,} of them now in "
        f"{record['wall_time_s']:.1f} s, {1e3 * rate:.3g} ms each",
        f"status     {counts(record['status'])}",
    ]
    if record["direction"]:
        lines.append(f"direction  {counts(record['direction'])}")
    if "links" in record:
        lines.append(
            f"numerics   {record['links']} links, {record['timestep_s']:g} s, picked on the base "
            f"scene; of {record['confirmed']} scenes walked again, finer, "
            f"{record['within_tolerance']} are within the tolerance, the largest change is "
            f"{record['largest_change_over_L']:.2g} L"
        )
    return "\n".join([*lines, *files])
