"""The best gait for a ground: `undulator optimise`."""

import itertools
import math
import os
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from analytic.checks import whole
from analytic.scene.gait import Gait
from analytic.scene.surface import SURFACES, Surface
from mjsim.files.command_line.cli import FAILED, bar, fail, parse, say, strict_json
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.extras import MissingExtraError
from mjsim.files.files import check_folder
from mjsim.files.files import whole as whole_file
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.files.text_table import Column, text_table
from mjsim.scene import Numerics, Scene

if TYPE_CHECKING:
    from analytic.scene.limbs import AnyRobot
    from mjsim.optimising.confirm import Confirmation
    from mjsim.optimising.objective import Objective
    from mjsim.optimising.search import Generation

    Corners = tuple[tuple[AnyRobot, tuple[Surface, ...]], ...]

PROGRAM = "undulator optimise"
EXAMPLES = (
    "--surface felt,gelatin,polyethylene",
    "--surface gelatin --backward --aim air",
    "--robot quadruped --surface felt --evaluations 200",
)


@dataclass(frozen=True)
class Options(SceneOptions):
    """Search for the gait that goes farthest, fastest, or for the least air, on given ground.

    Of several grounds the worst counts, and of friction at the ends alone or at all contacts the
    worse, unless --contacts says which. Prints how finer models walk it, and with pressure and
    friction 10 % off; docs/output.md explains the columns. Ramps are no faster than the flow limit
    of the valves, if one is given. Writes best.toml, a gait for --gait, best_valves.csv, when each
    valve fills or vents, and best.png. Exit code 0: done; 2: bad input; 3: nothing goes that way.
    """

    aim: Literal["displacement", "speed", "air", "work"] = "displacement"
    """displacement per cycle; speed, of periods from a fifth of the scene's to the scene's, in
    MuJoCo; the least air, in litres at atmospheric pressure, or the least work of compressing it,
    for each metre"""
    backward: bool = False
    """search for the best gait towards -x"""
    model: Literal["elastica", "lifted", "obstacle", "modes", "mujoco"] | None = None
    """of the search; elastica if not given, for speed and for robots of limbs mujoco"""
    uncertain: str = ""
    """fields that are not known, and within what they lie, as surface.tip_force=20%: the gait that
    is best where all of them, at most three, are off so that it goes least"""
    evaluations: int = 800
    """gaits to try, about: the last generation is tried whole"""
    seed: int = 0
    """of the random numbers"""
    workers: int | None = None
    """processes; one per core if not given"""
    out: Path = Path("optimised")
    """folder for best.toml and best.png, made if need be"""
    json: bool = False
    """print one JSON object instead of the table"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, EXAMPLES)
    try:
        whole("evaluations", options.evaluations, 1)
        whole("seed", options.seed, 0)
        workers = os.cpu_count() or 1 if options.workers is None else options.workers
        whole("workers", workers, 1)
        tables = tables_of(options)
        built = [build(table) for table in tables]
        objective = _objective(options, [scene for scene, _ in built], built[0][1], tables)
        check_folder(options.out)
        began = time.perf_counter()
        history: list[Generation] = []
        try:
            best, start = _search(options, objective, workers, history)
        except KeyboardInterrupt as error:
            if not history:
                raise
            path, *_ = _write(options, objective, history)
            raise KeyboardInterrupt(
                f"the best of {history[-1].evaluations} gaits is in {path}"
            ) from error
        seconds = time.perf_counter() - began
    except (ValueError, OSError, MissingExtraError) as error:
        fail(PROGRAM, str(error))
    files: list[str] = []
    end = ""
    try:
        for path in _write(options, objective, history):
            files.append(path)
    except OSError as error:
        end = str(error)  # after the numbers, which are not lost
    record = _record(options, objective, history[-1], best, start) | {
        "wall_time_s": seconds, "files": files}  # fmt: skip
    say(strict_json(record) if options.json else _text(record))
    if end:
        sys.stdout.flush()
        fail(PROGRAM, end)
    return 0 if _goes(record) else FAILED


def _objective(
    options: Options, scenes: Sequence[Scene], numerics: Numerics, tables: Sequence[Tables]
) -> "Objective":
    from mjsim.optimising.objective import Objective

    grounds = []
    for scene in scenes:
        ground = scene.ground
        if not isinstance(ground, Surface) or ground.adhesion or ground.viscosity:
            raise ValueError(
                f"ground {ground.name!r}: the search is for uniform ground that neither sticks nor "
                "resists by speed"
            )
        grounds.append(ground)
    if scenes[0].friction != "constant":
        raise ValueError(f"friction must be constant, got {scenes[0].friction}")
    model = _model(options, scenes[0].in_space)
    return Objective(
        scenes[0], tuple(grounds), options.aim, options.backward, model, numerics=numerics,
        others=_corners(options.uncertain, tables) if options.uncertain else (),
    )  # fmt: skip


def _corners(text: str, tables: Sequence[Tables]) -> "Corners":
    """Robots and their surfaces at the corners of what is not known."""
    from mjsim.fitting.parameters import with_values
    from mjsim.uncertainty.fields import Within, corners, read_spreads

    by_robot: dict[AnyRobot, list[Surface]] = {}
    for table in tables:
        spreads = read_spreads(table, text)
        if not all(isinstance(spread, Within) and spread.of_robot_and_ground for spread in spreads):
            raise ValueError(
                f"uncertain must be fields of robot and surface in a search, got {text!r}"
            )
        for values in corners(spreads):
            scene, _ = build(with_values(table, values))
            assert isinstance(scene.ground, Surface)
            by_robot.setdefault(scene.robot, []).append(scene.ground)
    return tuple((robot, tuple(surfaces)) for robot, surfaces in by_robot.items())


def _model(options: Options, in_space: bool) -> str:
    walked = options.aim == "speed" or in_space
    if walked and options.model not in (None, "mujoco"):
        case = "a robot of limbs" if in_space else "aim speed"
        raise ValueError(f"model of {case} must be mujoco, got {options.model}")
    return options.model or ("mujoco" if walked else "elastica")


def _search(
    options: Options, objective: "Objective", workers: int, history: "list[Generation]"
) -> "tuple[list[Confirmation], list[Confirmation]]":
    """Confirmations of the best gait and of the scene's own; generations are added to a list."""
    from mjsim.files.plugins import processes
    from mjsim.optimising.confirm import confirm
    from mjsim.optimising.search import search
    from mjsim.optimising.space import Space

    scene = objective.scene
    space = Space(len(scene.robot.chambers), scene.gait.period, options.aim == "speed")
    with processes("mjsim.optimising.confirm", workers) as pool:
        with bar("search", options.evaluations) as advance:
            for generation in search(objective, space, options.evaluations, options.seed, pool):
                advance(generation.evaluations - (history[-1].evaluations if history else 0))
                history.append(generation)
        surfaces = [*objective.surfaces,
                    *(s for s in SURFACES.values() if s not in objective.surfaces)]  # fmt: skip
        jobs = list(itertools.product(
            [objective], [history[-1].best, scene.gait], surfaces, objective.contacts
        ))  # fmt: skip
        confirmed = list(pool.map(confirm, *zip(*jobs, strict=True)))
    return confirmed[: len(jobs) // 2], confirmed[len(jobs) // 2 :]


def _write(options: Options, objective: "Objective", history: "list[Generation]") -> Iterator[str]:
    """Paths of the gait's file and its picture, each once it is written."""
    from mjsim.files.scene_tables.written import as_toml
    from mjsim.optimising.picture import draw
    from mjsim.optimising.valve_times import write

    gait = history[-1].best
    table = {"name": "best", "stages": [list(stage) for stage in gait.stages],
             "ramp_time": [round(time, 9) for time in gait.ramp_times]}  # fmt: skip
    surfaces = ", ".join(surface.name for surface in objective.surfaces)
    words = [f"The best of {history[-1].evaluations} gaits for {options.aim} on {surfaces}."]
    path = options.out / "best.toml"
    with whole_file(path) as part:
        text = as_toml({"gait": table}, words)
        part.write_text(text.replace("[gait]\n", ""), "utf-8")
    yield str(path)
    times = options.out / "best_valves.csv"
    with whole_file(times) as part:
        write(gait, objective.scene.robot, part)
    yield str(times)
    draw(gait, objective.scene.gait, history, options.out / "best.png", objective.aim,
         objective.scene.robot.chambers)  # fmt: skip
    yield str(options.out / "best.png")


def _record(
    options: Options, objective: "Objective", generation: "Generation",
    best: "list[Confirmation]", start: "list[Confirmation]",
) -> dict[str, Any]:  # fmt: skip
    from analytic.scene.air import air_per_cycle

    gait: Gait = generation.best
    air = air_per_cycle(objective.scene.robot, gait)
    return {
        "aim": options.aim, "backward": options.backward, "model": objective.model,
        "bent": objective.bent,
        "evaluations": generation.evaluations, "objective": generation.value,
        "searched_on": [surface.name for surface in objective.surfaces],
        "uncertain": options.uncertain,
        "stages": gait.stages, "ramp_times_s": gait.ramp_times, "period_s": gait.period,
        "air_litres_per_cycle": 1e3 * air.volume, "work_J_per_cycle": air.work,
        "surfaces": [row._asdict() for row in best],
        "start": [row._asdict() for row in start],
    }  # fmt: skip


def _goes(record: dict[str, Any]) -> bool:
    """Tell whether the best gait goes the way that was asked for, where it goes least."""
    least = 0.0 if record["aim"] in ("displacement", "speed") else -math.inf
    return bool(record["objective"] > least)


def _text(record: dict[str, Any]) -> str:
    from mjsim.results.prediction import WEAK

    unit = {"displacement": "L per cycle", "speed": "m/s", "air": "-l/m", "work": "-J/m"}
    where = ", ".join(record["searched_on"])
    if record["uncertain"]:
        where += f" in the worst case of {record['uncertain']}"
    weak = record["model"] != "mujoco" and not record["bent"]
    model = record["model"] + f", {WEAK}," * weak
    head = (
        f"{record['evaluations']} gaits by {model} in {record['wall_time_s']:.0f} s; "
        f"{'best' if _goes(record) else 'none goes that way, the best'} on {where}: "
        f"{record['objective']:+.4g} {unit[record['aim']]}, "
        f"{record['period_s']:g} s and {record['air_litres_per_cycle']:.3g} l of air per cycle"
    )
    rows = [
        {**row, "start": start["mujoco"]}
        for row, start in zip(record["surfaces"], record["start"], strict=True)
    ]
    columns = (
        Column("surface", "surface"), Column("friction at", "contacts"),
        Column("searched", "searched", "+.4f"), Column("reference", "reference", "+.4f"),
        Column("MuJoCo", "mujoco", "+.4f"),
        Column("10 % off: from", "lowest", "+.4f"), Column("to", "highest", "+.4f"),
        Column("start", "start", "+.4f"), Column("status", "status"),
    )  # fmt: skip
    lines = [head, text_table(columns, rows)]
    return "\n".join([*lines, *record["files"]])
