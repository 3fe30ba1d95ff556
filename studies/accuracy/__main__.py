"""Measure speed against accuracy and draw it: `python -m studies.accuracy`."""

import itertools
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from mjsim.files.cli import choose, fail, parse
from mjsim.files.files import check_folder
from mjsim.results.provenance import machine
from studies.accuracy import cantilever_bodies, figure, heavy_cantilever, walking
from studies.accuracy.benchmark_cases import GROUNDS
from studies.accuracy.rows import MEASURED, read
from studies.accuracy.setting import Setting
from studies.drawing import save
from studies.table import columns, complete

PROGRAM = "python -m studies.accuracy"
CASES = (heavy_cantilever.CASE, *GROUNDS)


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
        read(path)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    # one process: more would disturb the times
    rows = complete(path, measured, _grid(cases, options.quick), processes=1)
    for case in cases:
        save(figure.draw(rows, case), options.out / f"{case}.png")
        print(figure.table(rows, case))
        print(options.out / f"{case}.png")
    return 0


def _grid(cases: Sequence[str], quick: bool) -> Iterator[tuple[Any, ...]]:
    """Arguments of `measured`."""
    for case in cases:
        walk = case in GROUNDS
        settings = walking.settings(case, quick) if walk else cantilever_bodies.settings(quick)
        scenes = GROUNDS[case] if walk else (heavy_cantilever.TIP,)
        for setting, scene in itertools.product(settings, scenes):
            values = {"case": case, "scene": scene, **asdict(setting)}
            yield tuple(values[name] for name in columns(measured))


def measured(
    case: str,
    scene: str,
    method: str,
    integrator: str,
    cone: str,
    impratio: float,
    links: int,
    timestep: float,
) -> dict[str, Any]:
    """The row of a setting on a scene of a case, measured on this machine."""
    setting = Setting(method, links, timestep, integrator, cone, impratio)
    if case == heavy_cantilever.CASE:
        row = cantilever_bodies.run(setting)
    else:
        row = walking.run(case, scene, setting)
    return asdict(replace(row, machine=machine()))


if __name__ == "__main__":
    sys.exit(main())
