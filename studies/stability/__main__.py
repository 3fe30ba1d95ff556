"""Map where methods fail: `python -m studies.stability`."""

import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from matplotlib.figure import Figure

from mjsim.files.command_line.cli import choose, fail, parse
from mjsim.scene import registry
from studies.drawing import save
from studies.stability import figure, maps, parameters
from studies.table import complete, read

PROGRAM = "python -m studies.stability"


class Map(NamedTuple):
    """Function that measures, grid of its arguments (a few if quick), and figure of the rows."""

    measure: Callable[..., Any]
    grid: Callable[[bool], Iterator[Any]]
    draw: Callable[[Any], Figure]


MAPS = {
    **{body: Map(maps.walked, partial(maps.walks, body), figure.draw_integrators)
       for body in registry.names()},
    "robots": Map(maps.robot_outcome, maps.robots, figure.draw_robots),
    "parameters": Map(parameters.varied, parameters.variations, figure.draw_parameters),
}  # fmt: skip


@dataclass(frozen=True)
class Options:
    """Walk the default gait over grids of settings and of robots, and map how each walk came out.

    chain, cable, rod: time step over links and over stiffness of that body, for each integrator,
    with the time step beyond which its highest mode is predicted to grow. robots: pressure over
    weight, where the reference's stable branch ends, where MuJoCo topples, how far the paper's
    modes lie below the ground, and what the solvers of the theory have to do. parameters: the error
    over ramp time, friction, softness and what else may matter. Walks are appended to a table as
    they come, and a run that was stopped goes on where it was. Exit code 0: done; 2: bad input.

    Example: python -m studies.stability --map robots --quick --out /tmp/maps
    """

    map: str = "all"
    """chain, cable, rod, robots, parameters, or all"""
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
        paths = {name: options.out / f"stability_{name}.csv"
                 for name in choose("map", options.map, MAPS)}  # fmt: skip
        options.out.mkdir(parents=True, exist_ok=True)
        for path in paths.values() if options.fresh else ():
            path.unlink(missing_ok=True)
        for name, path in paths.items():
            read(path, MAPS[name].measure)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    for name, path in paths.items():
        measure, grid, draw = MAPS[name]
        rows = complete(path, measure, grid(options.quick))
        save(draw(rows), path.with_suffix(".png"))
        print(path.with_suffix(".png"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
