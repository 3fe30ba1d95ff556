"""Fit fields of a scene to what was measured: `undulator fit`."""

import dataclasses
import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
import tyro

from mjsim.files.cli import fail, parse, say, strict_json
from mjsim.files.files import check_folder, whole
from mjsim.files.options import SceneOptions, tables_of
from mjsim.files.tables import Tables

if TYPE_CHECKING:
    from mjsim.fitting.determined import Direction
    from mjsim.fitting.estimate import Estimate

PROGRAM = "undulator fit"
EXAMPLES = (
    "track.csv --scene my.toml --free robot.modulus,surface.tip_force,surface.shear_strength",
    "runs.csv --robot quadruped --free surface.tip_force,robot.modulus --model quasi-static",
)
_CORRELATED = 0.3  # of neighbouring residuals; more and the intervals are too narrow; chosen
_SEEN = 0.9  # correlation of parameters that is worth a word


@dataclass(frozen=True)
class Options(SceneOptions):
    """Fit fields of a scene to measurements by least squares, with 95 % intervals.

    Data are CSV files with units in the heads; docs/fitting.md describes them. Prints each
    parameter with its interval, and what the data do not determine; writes the fitted scene (TOML)
    and a picture of data, model and residuals. Exit code 0: done; 2: bad input; 3: a parameter is
    not determined or ended at a bound.
    """

    data: Annotated[tuple[Path, ...], tyro.conf.Positional] = ()
    """files of what was measured"""
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
        found, record = _fit(options, base)
        open_, bound = undetermined(found, base), at_bounds(found)
        notes = _notes(found, open_, bound)
        paths = _write(options.out, found, base, notes)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    if options.json:
        say(strict_json(_record(found, notes) | record | {"files": [str(p) for p in paths]}))
    else:
        say(_table(found))
        say("\n".join([_last_line(found, record), *notes]))
        print(*paths)
    return 3 if open_ or bound else 0


def _fit(options: Options, base: Tables) -> "tuple[Estimate, dict[str, Any]]":
    from mjsim.fitting.estimate import estimate
    from mjsim.fitting.observations import read_observations
    from mjsim.fitting.parameters import parameters
    from mjsim.fitting.walks import WALKS, Predictor, coarse, processes

    began = time.perf_counter()
    free = parameters(base, options.free, options.start, options.bounds, options.prior)
    series = read_observations(options.data)
    walk, other = WALKS[options.model], next(k for k in WALKS if k != options.model)
    runs = {run for one in series if one.quantity != "angle" for run in one.runs}
    pool = processes(len(runs), len(free))
    try:
        fine = Predictor(base, series, walk, pool=pool)
        first = fine
        if options.model == "mujoco" and fine.changes(coarse):
            first = Predictor(base, series, walk, coarse, pool=pool)
        found = estimate(first, free, refined=fine if first is not fine else None)
        apart = _confirmed(found, Predictor(base, series, WALKS[other], pool=pool))
    finally:
        if pool is not None:
            pool.shutdown()
    walks = fine.walks + (first.walks if first is not fine else 0)
    seconds = time.perf_counter() - began
    return found, {"model": options.model, "confirmed_by": other, "apart_over_noise": apart,
                   "walks": walks, "wall_time_s": seconds}  # fmt: skip


def _confirmed(found: "Estimate", other: Any) -> float | None:
    """How far the other model is from this one at the fit, over the noise: rms."""
    try:
        models = other(found.values)
    except ValueError:  # a ground or a body that it does not know
        return None
    squares = []
    for series, mine, its in zip(found.series, found.model, models, strict=True):
        shift = 0.0 if series.offset is None else found.offset[series.offset]
        squares.append(((its + shift - mine) / found.noise[series.noise]) ** 2)
    apart = float(np.sqrt(np.mean(np.concatenate(squares))))
    return apart if math.isfinite(apart) else None


def _notes(found: "Estimate", open_: "list[Direction]", bound: list[str]) -> list[str]:
    """What makes the numbers unsure, a line each."""
    notes = [str(direction) for direction in open_]
    notes += [f"{name} ended at a bound: its interval means nothing" for name in bound]
    if not open_:
        names = [p.name for p in found.parameters]
        for i, one in enumerate(names):
            for j, two in enumerate(names[:i]):
                if abs(found.correlation[i, j]) > _SEEN:
                    notes.append(
                        f"{two} and {one} are seen together: correlation "
                        f"{found.correlation[i, j]:+.2f}"
                    )
    neighbours = found.autocorrelation()
    if neighbours > _CORRELATED:
        notes.append(
            f"neighbouring residuals are alike (correlation {neighbours:.2f}): the model misses "
            "something, and the intervals are too narrow"
        )
    return notes


def _write(folder: Path, found: "Estimate", base: Tables, notes: list[str]) -> list[Path]:
    from mjsim.files.tables import build
    from mjsim.files.written import as_tables, as_toml
    from mjsim.fitting.parameters import with_values
    from mjsim.fitting.picture import draw

    tables = as_tables(*build(with_values(base, found.values)))
    lines = [line.strip() for line in _table(found).splitlines()]
    others = sorted({p.name for p in found.parameters} - set(_own(found)))
    if others:
        notes = [*notes, "of surfaces beside the scene's ground: " + ", ".join(
            f"{name} = {found.values[name]:.6g}" for name in others)]  # fmt: skip
    with whole(folder / "fit.toml") as part:
        part.write_text(as_toml(tables, ["Fitted; 95 % intervals:", *lines, *notes]), "utf-8")
    draw(found, folder / "fit.png")
    return [folder / "fit.toml", folder / "fit.png"]


def _own(found: "Estimate") -> list[str]:
    """Parameters of the robot, the valves and the scene's own ground."""
    return [p.name for p in found.parameters
            if p.name.partition(".")[0] in ("robot", "valves", "surface")]  # fmt: skip


def _table(found: "Estimate") -> str:
    rows = [("parameter", "value", "unit", "95 % interval", "error")]
    for p, value, low, high, error in zip(
        found.parameters, found.value, found.low, found.high, found.error, strict=True
    ):
        unit = "" if p.unit == "1" else p.unit
        part = f"{100 * error:.2g} %" if error < 1 else "> 100 %"
        rows.append((p.name, f"{value:.4g}", unit, f"{low:.4g} .. {high:.4g}", part))
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    )


def _last_line(found: "Estimate", record: dict[str, Any]) -> str:
    units = {"angle": ("rad", 1.0), "turn": ("rad", 1.0), "speed": ("mm/s", 1e3)}
    noise = []
    for kind, value in found.noise.items():
        unit, factor = units.get(kind, ("mm", 1e3))
        noise.append(f"{kind} {factor * value:.3g} {unit}")
    apart = record["apart_over_noise"]
    other = (
        "" if apart is None else f"; {record['confirmed_by']} is {apart:.2g} times the noise away"
    )
    return (f"{found.count} numbers, noise of {', '.join(noise)}{other}; {record['walks']} walks, "
            f"{record['wall_time_s']:.1f} s")  # fmt: skip


def _record(found: "Estimate", notes: list[str]) -> dict[str, Any]:
    return {
        "parameters": [
            dataclasses.asdict(p) | {"unit": p.unit, "value": v, "low_95": lo, "high_95": hi,
                                     "relative_error": e}
            for p, v, lo, hi, e in zip(found.parameters, found.value.tolist(), found.low.tolist(),
                                       found.high.tolist(), found.error.tolist(), strict=True)
        ],
        "correlation": found.correlation.tolist(),
        "noise_SI": found.noise,
        "numbers": found.count,
        "notes": notes,
    }  # fmt: skip
