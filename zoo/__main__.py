"""All robots of the zoo beside their measured numbers: `python -m zoo [ROBOT ...] [--draw]`.

Prints one table, measured and predicted with their errors; --draw writes picture.png into each
robot's folder, by the robot's own `model.draw` where it has one.
"""

import argparse
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from types import ModuleType

from zoo.comparison import Row, draw, rows, table

HERE = Path(__file__).parent
ROBOTS = tuple(sorted(path.parent.name for path in HERE.glob("*/measured.csv")))


def model(robot: str) -> ModuleType:
    """Predictor of a robot: the module `model` of its folder."""
    return import_module(f"zoo.{robot}.model")


def walk(robot: str) -> list[Row]:
    """Rows of one robot, from its folder's `model.predicted`."""
    return rows(HERE / robot, model(robot).predicted())


def main(argv: Sequence[str] | None = None) -> list[Row]:
    """Walk robots and print their table."""
    parser = argparse.ArgumentParser(prog="python -m zoo", description=__doc__.splitlines()[0])
    parser.add_argument("robots", nargs="*", metavar="ROBOT", help=f"of {', '.join(ROBOTS)}")
    parser.add_argument("--draw", action="store_true", help="write each robot's picture.png")
    options = parser.parse_args(argv)
    for robot in options.robots:
        if robot not in ROBOTS:
            parser.error(f"no robot {robot!r}; there are {', '.join(ROBOTS)}")
    all_rows: list[Row] = []
    for robot in options.robots or ROBOTS:
        here = walk(robot)
        if options.draw:
            getattr(model(robot), "draw", draw)(here, HERE / robot / "picture.png")
        all_rows += here
    print(*table(all_rows), sep="\n")
    return all_rows


if __name__ == "__main__":
    main()
