"""Map where methods fail: `python -m studies.stability`."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mjsim.files.cli import bar, choose, fail, parse
from mjsim.results.provenance import signature
from mjsim.scene import registry
from studies import workers
from studies.accuracy.figure import save
from studies.accuracy.rows import append, read
from studies.stability import figure, maps, parameters

PROGRAM = "python -m studies.stability"
KINDS: dict[str, type[Any]] = {
    **dict.fromkeys(registry.names(), maps.Tried), "robots": maps.Standing,
    "parameters": parameters.Varied,
}  # fmt: skip


@dataclass(frozen=True)
class Options:
    """Walk the default gait over grids of settings and of robots, and map how each walk came out.

    planar, cable, rod: time step over links and over stiffness of that body, for each integrator,
    with the time step beyond which its highest mode is predicted to grow. robots: pressure over
    weight, where the reference's stable branch ends, where MuJoCo topples, how far the paper's
    modes lie below the ground, and what the solvers of the theory have to do. parameters: the error
    over ramp time, friction, softness and what else may matter. Walks are appended to a table as
    they come, and a run that was stopped goes on where it was. Exit code 0: done; 2: bad input.

    Example: python -m studies.stability --map robots --quick --out /tmp/maps
    """

    map: str = "all"
    """planar, cable, rod, robots, parameters, or all"""
    out: Path = Path("docs")
    """folder for tables and figures"""
    fresh: bool = False
    """walk everything anew"""
    quick: bool = False
    """only a few walks of each map"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    try:
        names = choose("map", options.map, KINDS)
        known = {name: _known(options, name) for name in names}
        options.out.mkdir(parents=True, exist_ok=True)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    for name in names:
        rows = known[name]
        seen = {row.key for row in rows}
        todo = [row for row in _grid(options, name) if row.key not in seen]
        with workers.pool() as pool, bar(name, len(todo)) as advance:
            outcomes = pool.map(KINDS[name].done, todo, chunksize=2)
            signed = (replace(row, **signature()) for row in outcomes)
            for row in append(signed, _table(options, name)):
                rows.append(row)
                advance(1)
        picture = options.out / f"stability_{name}.png"
        save(figure.draw(name, rows), picture)
        print(picture)
    return 0


def _table(options: Options, name: str) -> Path:
    return options.out / f"stability_{name}.csv"


def _known(options: Options, name: str) -> list[Any]:
    if options.fresh:
        _table(options, name).unlink(missing_ok=True)
    return read(_table(options, name), KINDS[name])


def _grid(options: Options, name: str) -> list[Any]:
    if name == "robots":
        return list(maps.robots(options.quick))
    if name == "parameters":
        return list(parameters.variations(options.quick))
    return list(dict.fromkeys(maps.integrators(name, options.quick)))


if __name__ == "__main__":
    sys.exit(main())
