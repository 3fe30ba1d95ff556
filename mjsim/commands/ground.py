"""Numbers of one's own ground from tilt and pull tests: `undulator ground`."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import tyro

from mjsim.files.cli import FAILED, fail, parse, say, strict_json
from mjsim.files.files import check_folder, whole

PROGRAM = "undulator ground"
EXAMPLES = (
    "examples/ground_tests.csv --out cloth.toml",
    "--angle 31,29,30,32deg --mass 12g --width 40mm --length 43mm",
    "--force 33,36,34,31mN --tips 1 --mass 7g",
)


@dataclass(frozen=True)
class Options:
    """Make a [ground] of tilt and pull tests: bounds and coefficients with 95 % intervals.

    Data are CSV files, a reading a row, which docs/own_ground.md describes; or readings are
    options. Prints a table, which law of friction the loads support, and the command that fits a
    film; writes a file that undulator run --scene takes. Exit code 0: done; 2: bad input; 3: two
    tests contradict each other, or neither law holds.
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
    from mjsim.files.tables import build_ground
    from mjsim.files.written import as_toml
    from mjsim.fitting import sliding_report as report
    from mjsim.fitting.sliding_bounds import BOTH, quantities, samples
    from mjsim.fitting.sliding_tests import SHARED, read_tests

    try:
        if options.out.suffix != ".toml":
            raise ValueError(f"out must end in .toml, got {str(options.out)!r}")
        if options.out.exists() and not options.overwrite:
            raise ValueError(
                f"out must be a file that is not there, got {str(options.out)!r}; --overwrite "
                "writes over it"
            )
        shared = {name: getattr(options, name) or "" for name in (*SHARED, "way", "state")}
        tests = read_tests(options.data, shared, {"angle": options.angle, "force": options.force})
        tested = samples(tests.readings)
        found = quantities(tested)
        if not found:
            raise ValueError(
                "mass, area or tips must be given: without them a force tells neither a "
                "coefficient nor a bound"
            )
        ground = report.ground_of(tested, found, options.name, options.nap, options.state or "")
        numerics = {"friction": ground.law} if ground.law else {}
        tables = {"ground": ground.table, "numerics": numerics}
        build_ground(
            ground.table
        )  # refuses what no surface is; a robot, which has a say, is not here
        check_folder(options.out.parent)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    lines = report.notes(tested, found, ground)
    if tests.ignored:
        lines.append(f"columns that are not read: {', '.join(tests.ignored)}")
    film = report.film_command(ground, options.out)
    rows = report.table(found)
    if options.json:
        record = report.record_of(tested, found)
        say(strict_json(record | {"law": ground.law or None, "ground": ground.fields,
                                  "notes": lines, "film": film,
                                  "file": str(options.out)}))  # fmt: skip
    else:
        say("\n".join([rows, *lines, f"two cycles on film tell more: {film}"]))
    try:
        with whole(options.out) as part:
            comments = ["Measured; 95 % intervals:", *rows.splitlines(), *lines]
            part.write_text(as_toml(tables, comments), "utf-8")
    except OSError as error:
        sys.stdout.flush()
        fail(PROGRAM, f"out cannot be written: {error}")
    if not options.json:
        print(options.out)
    doubtful = any(q.apart for q in ground.used) or any(
        sample.verdict and sample.verdict.law == BOTH for sample in tested
    )
    return FAILED if doubtful else 0
