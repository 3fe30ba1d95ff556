"""Measure speed against accuracy and draw it: `python -m mjsim.chart`."""

import logging
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from mjsim.accuracy import figure, grid, heavy, scenes, settling, walking
from mjsim.accuracy.rows import MEASURED, Row, append, read
from mjsim.accuracy.setting import Setting
from mjsim.cli import bar, choose, fail, parse
from mjsim.provenance import machine, signature

PROGRAM = "python -m mjsim.chart"
WORKS = (heavy.WORK, *scenes.GROUNDS)


@dataclass(frozen=True)
class Options:
    """Measure every method over links and time steps on three pieces of work, and draw the fronts.

    settle: a heavy clamped strip sags to rest, without contact; error of its tip, whose place is
    known exactly. walk: one slow cycle of the default gait on felt and on gelatin; error of the
    displacement against the converged elastica. coulomb: the same on gelatin by Coulomb's law,
    which peers know as well. Rows are appended to a table as they come, and a
    run that was stopped goes on where it was. Exit code 0: done; 2: bad input.

    Example: python -m mjsim.chart --quick --out /tmp/chart
    """

    work: str = "all"
    """settle, walk, coulomb, or all"""
    out: Path = Path("docs")
    """folder for the figures"""
    rows: Path = MEASURED
    """the table: CSV that measurements are read from and appended to"""
    fresh: bool = False
    """measure everything anew"""
    quick: bool = False
    """only a few settings of each method"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    try:
        works = choose("work", options.work, WORKS)
        if options.fresh:
            options.rows.unlink(missing_ok=True)
        known = read(options.rows)
        options.out.mkdir(parents=True, exist_ok=True)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    logging.getLogger("absl").setLevel(logging.ERROR)  # divergence is a row, not a warning
    seen = {row.key for row in known}
    todo = [job for job in _jobs(works, options.quick) if job[0] not in seen]
    with bar("measuring", len(todo)) as advance:
        for row in append(
            (replace(run(), machine=machine(), **signature()) for _, run in todo), options.rows
        ):
            known.append(row)
            advance(1)
    for work in works:
        figure.save(figure.draw(known, work), options.out / f"{work}.png")
        print(figure.table(known, work))
        print(options.out / f"{work}.png")
    return 0


Job = tuple[tuple[str, str, Setting], Callable[[], Row]]


def _jobs(works: Sequence[str], quick: bool) -> Iterator[Job]:
    for work in works:
        if work == heavy.WORK:
            for setting in settling.settings(quick):
                yield (work, heavy.TIP, setting), partial(settling.run, setting)
        else:
            for setting in grid.settings(work, quick):
                for ground in scenes.GROUNDS[work]:
                    yield (work, ground, setting), partial(walking.run, work, ground, setting)


if __name__ == "__main__":
    sys.exit(main())
