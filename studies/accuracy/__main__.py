"""Measure speed against accuracy and draw it: `python -m studies.accuracy`."""

import logging
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from mjsim.files.cli import bar, choose, fail, parse
from mjsim.files.files import check_folder
from mjsim.results.provenance import machine, signature
from studies.accuracy import (
    benchmark_cases,
    cantilever_bodies,
    figure,
    grid,
    heavy_cantilever,
    walking,
)
from studies.accuracy.rows import MEASURED, Row, append, read
from studies.accuracy.setting import Setting

PROGRAM = "python -m studies.accuracy"
CASES = (heavy_cantilever.CASE, *benchmark_cases.GROUNDS)


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
        cases = choose("case", options.case, CASES)
        check_folder(options.out)
        path = options.rows or options.out / MEASURED.name
        if options.fresh:
            path.unlink(missing_ok=True)
        known = read(path)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    logging.getLogger("absl").setLevel(logging.ERROR)  # divergence is a row, not a warning
    seen = {row.key for row in known}
    todo = [job for job in _jobs(cases, options.quick) if job[0] not in seen]
    with bar("measuring", len(todo)) as advance:
        for row in append(
            (replace(run(), machine=machine(), **signature()) for _, run in todo), path
        ):
            known.append(row)
            advance(1)
    for case in cases:
        figure.save(figure.draw(known, case), options.out / f"{case}.png")
        print(figure.table(known, case))
        print(options.out / f"{case}.png")
    return 0


Job = tuple[tuple[str, str, Setting], Callable[[], Row]]


def _jobs(cases: Sequence[str], quick: bool) -> Iterator[Job]:
    for case in cases:
        if case == heavy_cantilever.CASE:
            for setting in cantilever_bodies.settings(quick):
                yield (case, heavy_cantilever.TIP, setting), partial(cantilever_bodies.run, setting)
        else:
            for setting in grid.settings(case, quick):
                for ground in benchmark_cases.GROUNDS[case]:
                    yield (case, ground, setting), partial(walking.run, case, ground, setting)


if __name__ == "__main__":
    sys.exit(main())
