"""Fit fields of a scene to what was measured: `undulator fit`."""

import contextlib
import dataclasses
import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
import tyro

from mjsim.files.cli import FAILED, fail, parse, say, strict_json
from mjsim.files.files import check_folder, whole
from mjsim.files.options import SceneOptions, tables_of
from mjsim.files.tables import Tables
from mjsim.files.text_table import Column, text_table

if TYPE_CHECKING:
    from mjsim.fitting.determined import Direction
    from mjsim.fitting.estimate import Estimate
    from mjsim.fitting.walks import Predictor

PROGRAM = "undulator fit"
EXAMPLES = (
    "track.csv --scene my.toml --free robot.modulus,surface.tip_force,surface.shear_strength",
    "runs.csv --robot quadruped --free surface.tip_force,robot.modulus --model quasi-static",
)
_CORRELATED = 0.3  # of neighbouring residuals; more and the intervals are too narrow; chosen
_TOGETHER = 0.9  # correlation of parameters beyond which a note says so; chosen
_OF_THE_SCENE = ("robot.", "valves.", "surface.")  # parameters that fit.toml has as keys


@dataclass(frozen=True)
class Options(SceneOptions):
    """Fit fields of a scene to measurements by least squares, with 95 % intervals.

    Data are CSV files, which docs/fitting.md describes. Prints each parameter, and what the data do
    not determine; writes the fitted scene, fit.toml, and fit.png. Exit code 0: done; 2: bad input;
    3: a parameter is not determined or ended at a bound.
    """

    data: Annotated[tuple[Path, ...], tyro.conf.Positional] = ()
    """files of measurements"""
    free: str = ""
    """fields to fit, with commas between: of robot, valves, surface (the scene's ground) or of a
    surface by its name, as felt.shear_strength"""
    start: str = ""
    """where they begin, if not at the scene's values: robot.modulus=2MPa,..."""
    bounds: str = ""
    """between which they lie, if not within a factor of 100: robot.modulus=1MPa..3MPa,..."""
    prior: str = ""
    """what is known beside the data, and counts as one more measurement:
    robot.modulus=2MPa+-0.2MPa,..."""
    model: Literal["mujoco", "quasi-static"] = "mujoco"
    """what walks: MuJoCo, coarse at first and at the end with the scene's own links and time step;
    or the elastica that friction bends, without inertia and with ideal valves"""
    out: Path = Path("fitted")
    """folder for fit.toml and fit.png, made if need be"""
    json: bool = False
    """print one JSON object instead of the table"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, EXAMPLES)
    from mjsim.fitting.determined import at_bounds, undetermined

    try:
        if not options.data:
            raise ValueError("data must be one CSV file at least, got none")
        base, *more = tables_of(options)
        if more:
            raise ValueError("surface must be one: runs on others say so in a column")
        check_folder(options.out)
        fit, record = _fit(options, base)
        open_, bound = undetermined(fit, base), at_bounds(fit)
        notes = _notes(fit, open_, bound)
        paths = _write(options.out, fit, base, notes)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    if options.json:
        say(strict_json(_record(fit, notes) | record | {"files": [str(p) for p in paths]}))
    else:
        say("\n".join([_table(fit), _summary(fit, record), *notes]))
        print(*paths)
    return FAILED if open_ or bound else 0


def _fit(options: Options, base: Tables) -> "tuple[Estimate, dict[str, Any]]":
    from mjsim.fitting.estimate import estimate
    from mjsim.fitting.observations import read_observations
    from mjsim.fitting.parameters import parameters
    from mjsim.fitting.walks import WALKS, Predictor, coarse, processes

    began = time.perf_counter()
    free = parameters(base, options.free, options.start, options.bounds, options.prior)
    series = read_observations(options.data)
    walk, second = WALKS[options.model], next(k for k in WALKS if k != options.model)
    runs = {run for line in series if line.quantity != "angle" for run in line.runs}
    with processes(len(runs), len(free)) or contextlib.nullcontext() as pool:
        fine = Predictor(base, series, walk, pool=pool)
        rough = fine
        if options.model == "mujoco" and fine.changes(coarse):
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
        predictions = second(fit.values)
    except ValueError:  # a ground or a body that it does not know
        return None
    squares = []
    for series, model, prediction in zip(fit.series, fit.model, predictions, strict=True):
        shift = 0.0 if series.offset is None else fit.offset[series.offset]
        squares.append(((prediction + shift - model) / fit.noise[series.noise]) ** 2)
    apart = float(np.sqrt(np.mean(np.concatenate(squares))))
    return apart if math.isfinite(apart) else None


def _notes(fit: "Estimate", open_: "list[Direction]", bound: list[str]) -> list[str]:
    """Reasons why the numbers are unsure, one line each."""
    notes = [str(direction) for direction in open_]
    notes += [f"{name} ended at a bound: its interval means nothing" for name in bound]
    if not open_:
        pairs = combinations(enumerate(p.name for p in fit.parameters), 2)
        notes += [
            f"{first} and {second} are seen together: correlation {fit.correlation[i, j]:+.2f}"
            for (i, first), (j, second) in pairs if abs(fit.correlation[i, j]) > _TOGETHER
        ]  # fmt: skip
    neighbours = fit.autocorrelation()
    if neighbours > _CORRELATED:
        notes.append(
            f"neighbouring residuals are alike (correlation {neighbours:.2f}): the model misses "
            "something, and the intervals are too narrow"
        )
    return notes


def _write(folder: Path, fit: "Estimate", base: Tables, notes: list[str]) -> list[Path]:
    from mjsim.files.tables import build
    from mjsim.files.written import as_tables, as_toml
    from mjsim.fitting.parameters import with_values
    from mjsim.fitting.picture import draw

    tables = as_tables(*build(with_values(base, fit.values)))
    comments = ["Fitted; 95 % intervals:", *_table(fit).splitlines(), *notes]
    others = sorted(name for name in fit.values if not name.startswith(_OF_THE_SCENE))
    if others:
        comments.append("of surfaces beside the scene's ground: " + ", ".join(
            f"{name} = {fit.values[name]:.6g}" for name in others))  # fmt: skip
    with whole(folder / "fit.toml") as part:
        part.write_text(as_toml(tables, comments), "utf-8")
    draw(fit, folder / "fit.png")
    return [folder / "fit.toml", folder / "fit.png"]


def _table(fit: "Estimate") -> str:
    columns = (
        Column("parameter", "name"), Column("value", "value", ".4g"), Column("unit", "unit"),
        Column("95 % interval", "interval"), Column("error", "error", ".2g"),
    )  # fmt: skip
    rows = [
        {**row, "unit": "" if row["unit"] == "1" else row["unit"],
         "interval": f"{row['low_95']:.4g} .. {row['high_95']:.4g}",
         "error": f"{100 * row['relative_error']:.2g} %" if row["relative_error"] < 1
         else "> 100 %"}
        for row in _parameters(fit)
    ]  # fmt: skip
    return text_table(columns, rows)


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


def _parameters(fit: "Estimate") -> list[dict[str, Any]]:
    """Fields of each parameter with its fitted value and interval."""
    numbers = zip(fit.value.tolist(), fit.low.tolist(), fit.high.tolist(), fit.error.tolist(),
                  strict=True)  # fmt: skip
    return [
        dataclasses.asdict(parameter) | {"unit": parameter.unit, "value": value, "low_95": low,
                                         "high_95": high, "relative_error": error}
        for parameter, (value, low, high, error) in zip(fit.parameters, numbers, strict=True)
    ]  # fmt: skip


def _record(fit: "Estimate", notes: list[str]) -> dict[str, Any]:
    return {
        "parameters": _parameters(fit), "correlation": fit.correlation.tolist(),
        "noise_SI": fit.noise, "numbers": fit.count, "notes": notes,
    }  # fmt: skip
