"""Numbers of one's own ground from tilt and pull tests: `undulator ground`."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import tyro

from mjsim.files.command_line.cli import FAILED, fail, parse, say, strict_json
from mjsim.files.files import check_folder, whole

if TYPE_CHECKING:
    from analytic.scene.robot import Robot
    from mjsim.files.scene_tables.tables import Tables
    from mjsim.fitting.sliding_report import Ground

PROGRAM = "undulator ground"
EXAMPLES = (
    "examples/ground_tests.csv --out cloth.toml",
    "--angle 31,29,30,32deg --mass 12g --width 40mm --length 43mm",
    "--force 33,36,34,31mN --tips 1 --mass 7g",
)


@dataclass(frozen=True)
class Options:
    """Make a [ground] of tilt and pull tests: bounds and coefficients with 95 % intervals.

    Data are CSV files, one reading per row, which docs/own_ground.md describes; or readings are
    options. Prints a table, which law of friction the loads support, and the command that fits a
    film; writes a file that undulator run --scene takes. Exit code 0: done; 2: bad input; 3: two
    tests contradict each other, or neither law fits.
    """

    data: Annotated[tuple[Path, ...], tyro.conf.Positional] = ()
    """files of readings"""
    angle: str = ""
    """angles of a board at which a sample begins to slide, with commas between: 31,29,30deg"""
    force: str = ""
    """forces of a level pull at which it begins to, with commas between: 33,36,34mN"""
    mass: str = ""
    """of all that rests on the ground, where rows do not say it, with its unit"""
    load: str = ""
    """its weight, in place of the mass"""
    width: str = ""
    """of a side that lies flat, where rows do not say it"""
    length: str = ""
    """of a side that lies flat"""
    area: str = ""
    """of a side, in place of width and length"""
    tips: str = ""
    """number of tips that a sample stands on in place of a side"""
    way: Literal["ahead", "back", "across"] | None = None
    """direction in which it slides, where rows do not say it; ahead if not given"""
    state: Literal["begins", "slides"] | None = None
    """what rows are that do not say whether the sample begins to slide or slides on, and which of
    both the file has; begins if not given"""
    scene: Path | None = None
    """scene of a robot and a gait, which the file has beside the ground"""
    nap: Literal["robot", "ground"] = "robot"
    """whose ahead it is: of bristles under the sample, or of a nap of the ground"""
    name: str = "measured"
    """of the surface"""
    out: Path = Path("ground.toml")
    """file to write"""
    overwrite: bool = False
    """write over a file that is there"""
    json: bool = False
    """print one JSON object instead of the table"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, EXAMPLES)
    from mjsim.files.scene_tables.written import as_toml
    from mjsim.fitting import sliding_report as report
    from mjsim.fitting.sliding_bounds import BOTH, quantities, samples
    from mjsim.fitting.sliding_tests import SHARED, read_tests
    from mjsim.scene import Scene

    try:
        _check_out(options)
        shared = {name: getattr(options, name) or "" for name in (*SHARED, "way", "state")}
        tests = read_tests(options.data, shared, {"angle": options.angle, "force": options.force})
        tested = samples(tests.readings)
        coefficients = quantities(tested)
        ground = report.ground_of(
            tested, coefficients, options.name, options.nap, options.state or ""
        )
        tables, strip = _scene(options.scene, ground)
        check_folder(options.out.parent)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    lines = report.notes(tested, coefficients, ground)
    if strip is not None:
        lines += report.loads(strip, ground)
    if tests.ignored:
        lines.append(f"columns that are not read: {', '.join(tests.ignored)}")
    law = tables["numerics"].get("friction", Scene.friction)
    film = report.film_command(ground, options.out, law)
    rows = report.table(coefficients)
    if options.json:
        record = report.record_of(tested, coefficients)
        told = {"law": ground.law or None, "ground": ground.fields, "notes": lines, "film": film}
        say(strict_json(record | told | {"file": str(options.out)}))
    else:
        say("\n".join([rows, *lines, f"two cycles on film tell more: {film}"]))
    try:
        with whole(options.out) as part:
            comments = ["Measured; 95 % intervals:", *rows.splitlines(), *lines]
            part.write_text(as_toml(tables, comments), "utf-8")
    except OSError as error:
        sys.stdout.flush()  # after the numbers, which are not lost
        fail(PROGRAM, f"out cannot be written: {error}")
    if not options.json:
        print(options.out)
    neither = any(sample.verdict and sample.verdict.law == BOTH for sample in tested)
    return FAILED if neither or any(quantity.apart for quantity in ground.used) else 0


def _check_out(options: Options) -> None:
    if options.out.suffix != ".toml":
        raise ValueError(f"out must end in .toml, got {str(options.out)!r}")
    if options.out.exists() and not options.overwrite:
        raise ValueError(
            f"out must be a file that is not there, got {str(options.out)!r}; --overwrite writes "
            "over it"
        )


def _scene(path: Path | None, ground: "Ground") -> "tuple[Tables, Robot | None]":
    """Tables of the file to write, and the strip of the scene that was given, if there is one.

    Raises:
        ValueError: what was measured is no surface, or the scene cannot be read or cannot have it.
    """
    from mjsim.files.scene_tables.keys import WITH_ANY_SURFACE
    from mjsim.files.scene_tables.tables import build, build_ground, merged, read_tables
    from mjsim.files.scene_tables.written import as_tables

    build_ground(ground.table)  # alone: how heavy a robot it may be of is not known here
    numerics = {"friction": ground.law} if ground.law else {}
    if path is None:
        return {"ground": ground.table, "numerics": numerics}, None
    base = read_tables(path)
    kept = {k: v for k, v in base.get("ground", {}).items() if k in WITH_ANY_SURFACE}
    tables = merged({**base, "ground": {**kept, **ground.table}}, {"numerics": numerics})
    scene, settings = build(tables)
    return as_tables(scene, settings), None if scene.in_space else scene.strip
