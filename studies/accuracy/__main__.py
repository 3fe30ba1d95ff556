"""Measure speed against accuracy and draw it: `python -m studies.accuracy`."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mjsim.files.command_line.cli import choose, fail, parse
from mjsim.files.files import check_folder
from studies.accuracy import figure
from studies.accuracy.cases import CASES, grid, measured
from studies.accuracy.rows import MEASURED, read
from studies.drawing import save
from studies.table import complete

PROGRAM = "python -m studies.accuracy"


@dataclass(frozen=True)
class Options:
    """Measure every method over links and time steps on three cases, and draw the Pareto fronts.

    cantilever: a heavy clamped strip settles, without contact; error of its tip, whose place is
    known exactly. walk: one slow cycle of the default gait on felt and on gelatin; error of the
    displacement against the converged elastica. coulomb: the same on gelatin under Coulomb
    friction, which peers know as well. Rows are appended to a table as they come, and a run that
    was stopped goes on where it was. Exit code 0: done; 2: bad input.

    Example: python -m studies.accuracy --quick --out /tmp/chart
    """

    case: str = "all"
    """cantilever, walk, coulomb, or all"""
    out: Path = Path("docs")
    """folder for the figures"""
    rows: Path | None = None
    """the table: CSV that measurements are read from and appended to; accuracy.csv in the folder
    of the figures if not given"""
    fresh: bool = False
    """measure everything anew"""
    quick: bool = False
    """only a few settings of each method"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    try:
        chosen = choose("case", options.case, CASES)
        check_folder(options.out)
        path = options.rows or options.out / MEASURED.name
        if options.fresh:
            path.unlink(missing_ok=True)
        read(path)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    # one process: more would disturb the times
    rows = complete(path, measured, grid(chosen, options.quick), processes=1)
    for case in chosen:
        save(figure.draw(rows, case), options.out / f"{case}.png")
        print(figure.table(rows, case))
        print(options.out / f"{case}.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
