"""Fit fields of a scene to what was measured: `undulator fit`."""

import contextlib
import math
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
import tyro

from mjsim.files.command_line.cli import FAILED, fail, parse, say, strict_json
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.files import check_folder, whole
from mjsim.files.scene_tables.tables import Tables

if TYPE_CHECKING:
    from mjsim.fitting.estimate import Estimate
    from mjsim.fitting.report import Doubts
    from mjsim.fitting.walks import Predictor

PROGRAM = "undulator fit"
EXAMPLES = (
    "track.csv --scene my.toml --free robot.modulus,surface.tip_force,surface.shear_strength",
    "markers.csv --pixel 0.25mm --frame-rate 30 --scene my.toml --free robot.modulus",
    "runs.csv --robot quadruped --free surface.tip_force,robot.modulus --model quasi-static",
    "bench.csv --free robot.actuator --zero angle",
)
_ACTUATOR = "robot.actuator"
_OF_THE_SCENE = ("robot.", "valves.", "surface.")  # parameters that fit.toml has as keys


@dataclass(frozen=True)
class Options(SceneOptions):
    """Fit fields of a scene to measurements by least squares, with 95 % intervals.

    Data are CSV files, which docs/fitting.md describes. Prints each parameter, and what the data do
    not determine; writes the fitted scene, fit.toml, what --uncertain of other commands reads,
    fit.json, and fit.png. Exit code 0: done; 2: bad input;
    3: a parameter is not determined or ended at a bound, or the model misses the data so much that
    no interval is sure.
    """

    data: Annotated[tuple[Path, ...], tyro.conf.Positional] = ()
    """files of measurements"""
    free: str = ""
    """fields to fit, with commas between: of robot, valves, surface (the scene's ground) or of a
    surface by its name, as felt.shear_strength; or robot.actuator alone, the curve and hysteresis
    of an actuator from a bench's files of pressure and angle or curvature"""
    by_chamber: bool = False
    """with robot.actuator: each file is of an actuator of its own, in the order of the segments"""
    start: str = ""
    """where they begin, if not at the scene's values: robot.modulus=2MPa,..."""
    bounds: str = ""
    """between which they lie, if not within a factor of 100: robot.modulus=1MPa..3MPa,..."""
    prior: str = ""
    """what is known beside the data, and counts as one more measurement:
    robot.modulus=2MPa+-0.2MPa,..."""
    zero: Literal["angle", "pressure"] | None = None
    """what a bench's files of pressure and angle may read at rest, one unknown per file: angle, the
    protractor's; pressure, the sensor's, or the one at which the segment begins to bend"""
    pixel: str = ""
    """size of a pixel on the robot, of columns in px: 0.25mm"""
    frame_rate: float | None = None
    """pictures per second, of a column frame in place of time"""
    model: Literal["mujoco", "quasi-static"] = "mujoco"
    """what walks: MuJoCo, coarse at first and at the end with the scene's own links and time step;
    or the elastica that friction bends, without inertia and with ideal valves"""
    out: Path = Path("fitted")
    """folder for fit.toml, fit.json and fit.png, made if need be"""
    json: bool = False
    """print one JSON object instead of the table"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, EXAMPLES)
    from mjsim.fitting.report import doubts_of, ignored, record_of, remarks, table, zeros

    try:
        if not options.data:
            raise ValueError("data must be one CSV file at least, got none")
        base, *more = tables_of(options)
        if more:
            raise ValueError("surface must be one: runs on others say so in a column")
        check_folder(options.out)
        if options.free.strip() == _ACTUATOR:
            return _of_actuators(options, base)
        if options.by_chamber:
            raise ValueError(f"by_chamber is for free {_ACTUATOR} alone, got free {options.free!r}")
        fit, record = _fit(options, base)
        doubts = doubts_of(fit, base)
        tables, refusal = _scene(fit, base)
        notes = [*doubts.notes, *remarks(fit, doubts), *refusal, *ignored(fit)]
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    paths: list[Path] = []
    end: OSError | None = None
    whole_record = record_of(fit, doubts, notes) | record
    try:
        for path in _write(options.out, fit, tables, doubts, notes, whole_record):
            paths.append(path)
    except OSError as error:
        end = error  # after the numbers, which are not lost
    if options.json:
        files = {"files": [str(path) for path in paths]}
        say(strict_json(whole_record | files))
    else:
        say("\n".join([table(fit, doubts), *zeros(fit), _summary(fit, record), *notes]))
        print(*paths)
    if end is not None:
        sys.stdout.flush()
        fail(PROGRAM, str(end))
    return FAILED if doubts.notes else 0


def _of_actuators(options: Options, base: Tables) -> int:
    """Fit actuators alone, whose segments need not walk; returns the exit code.

    Raises:
        ValueError, OSError: what was given is not what it should be, or cannot be written.
    """
    from mjsim.fitting.actuator import (
        estimate_actuators,
        record,
        summary,
        table,
        with_actuators,
    )
    from mjsim.fitting.actuator_picture import draw

    for name in ("start", "bounds", "prior", "pixel", "frame_rate"):
        if getattr(options, name):
            raise ValueError(f"{name} is for fields that are numbers, not for {_ACTUATOR}, got "
                             f"{getattr(options, name)!r}")  # fmt: skip
    fitted = estimate_actuators(base, options.data, options.zero or "", options.by_chamber)
    tables, notes = with_actuators(base, fitted)
    tables, refusal = _whole(tables)
    lines, notes = table(fitted), [*summary(fitted), *notes, *refusal]
    files = [options.out / "fit.toml", options.out / "fit.png"]
    _write_toml(files[0], tables, ["Fitted; 95 % intervals:", *lines.splitlines(), *notes])
    draw(fitted, files[1])
    if options.json:
        paths = [str(path) for path in files]
        say(strict_json(record(fitted, notes) | {"files": paths}))
    else:
        say("\n".join([lines, *notes]))
        print(*files)
    return 0


def _fit(options: Options, base: Tables) -> "tuple[Estimate, dict[str, Any]]":
    from mjsim.files.units import in_unit
    from mjsim.fitting.camera import Camera
    from mjsim.fitting.estimate import estimate
    from mjsim.fitting.markers import check_places
    from mjsim.fitting.observations import read_observations
    from mjsim.fitting.parameters import parameters
    from mjsim.fitting.walks import WALKS, Predictor, coarse, processes

    began = time.perf_counter()
    free = parameters(base, options.free, options.start, options.bounds, options.prior)
    pixel = in_unit("pixel", options.pixel, "m") if options.pixel else None
    camera = Camera(pixel, options.frame_rate)
    series = read_observations(options.data, options.zero or "", camera)
    walk, second = WALKS[options.model], next(k for k in WALKS if k != options.model)
    start = {parameter.name: parameter.start for parameter in free}
    check_places(series, base, start)
    runs = {run for line in series if line.quantity != "angle" for run in line.runs}
    with processes(len(runs), len(free)) or contextlib.nullcontext() as pool:
        fine = Predictor(base, series, walk, pool=pool)
        rough = fine
        if options.model == "mujoco" and fine.changes(coarse, start):
            rough = Predictor(base, series, walk, coarse, pool=pool)
        fit = estimate(rough, free, refined=fine if rough is not fine else None)
        apart = _apart(fit, Predictor(base, series, WALKS[second], pool=pool))
    walks = fine.walks + (rough.walks if rough is not fine else 0)
    seconds = time.perf_counter() - began
    return fit, {"model": options.model, "confirmed_by": second, "apart_over_noise": apart,
                 "walks": walks, "wall_time_s": seconds}  # fmt: skip


def _apart(fit: "Estimate", second: "Predictor") -> float | None:
    """Difference of a second model from the fitted one at the fit, over the noise: rms."""
    try:
        predictions = second(fit.values, fit.pressure_zeros)
    except ValueError:  # a ground or a body that it does not know
        return None
    squares = []
    for series, model, prediction in zip(fit.series, fit.model, predictions, strict=True):
        squares.append(((prediction + fit.level(series) - model) / fit.noise[series.noise]) ** 2)
    apart = float(np.sqrt(np.mean(np.concatenate(squares))))
    return apart if math.isfinite(apart) else None


def _scene(fit: "Estimate", base: Tables) -> tuple[Tables, list[str]]:
    """Tables of the fitted scene, and a note if it cannot walk as it is."""
    from mjsim.fitting.parameters import with_values

    return _whole(with_values(base, fit.values))


def _whole(tables: Tables) -> tuple[Tables, list[str]]:
    """Tables with every default, and a note if they are of no scene that walks."""
    from mjsim.files.scene_tables.tables import build
    from mjsim.files.scene_tables.written import as_tables

    try:
        return as_tables(*build(tables)), []
    except ValueError as error:
        return tables, [f"the fitted scene does not walk as it is: {error}"]


def _write(
    folder: Path, fit: "Estimate", tables: Tables, doubts: "Doubts", notes: list[str],
    record: dict[str, Any],
) -> Iterator[Path]:  # fmt: skip
    """Paths of the scene's file, the record and the picture, each once it is written."""
    from mjsim.fitting.picture import draw
    from mjsim.fitting.report import table, zeros

    rows = table(fit, doubts).splitlines()
    comments = ["Fitted; 95 % intervals:", *rows, *zeros(fit), *notes]
    others = sorted(name for name in fit.values if not name.startswith(_OF_THE_SCENE))
    if others:
        comments.append("of surfaces beside the scene's ground: " + ", ".join(
            f"{name} = {fit.values[name]:.6g}" for name in others))  # fmt: skip
    _write_toml(folder / "fit.toml", tables, comments)
    yield folder / "fit.toml"
    with whole(folder / "fit.json") as part:
        part.write_text(strict_json(record), "utf-8")
    yield folder / "fit.json"
    draw(fit, folder / "fit.png")
    yield folder / "fit.png"


def _write_toml(path: Path, tables: Tables, comments: list[str]) -> None:
    from mjsim.files.scene_tables.written import as_toml

    with whole(path) as part:
        part.write_text(as_toml(tables, comments), "utf-8")


def _summary(fit: "Estimate", record: dict[str, Any]) -> str:
    units = {"angle": ("rad", 1.0), "turn": ("rad", 1.0), "speed": ("mm/s", 1e3)}
    noise = []
    for kind, value in fit.noise.items():
        unit, factor = units.get(kind, ("mm", 1e3))
        noise.append(f"{kind} {factor * value:.3g} {unit}")
    apart = record["apart_over_noise"]
    second = (
        "" if apart is None else f"; {record['confirmed_by']} is {apart:.2g} times the noise away"
    )
    return (f"{fit.count} numbers, noise of {', '.join(noise)}{second}; {record['walks']} walks, "
            f"{record['wall_time_s']:.1f} s")  # fmt: skip
