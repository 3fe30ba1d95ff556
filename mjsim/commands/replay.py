"""Make a video from a saved trajectory, of a run that failed too: `undulator replay`."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from mjsim.files import plugins
from mjsim.files.cli import FAILED, Plugins, fail, parse
from mjsim.pictures import gl

PROGRAM = "undulator replay"


@dataclass(frozen=True)
class Options:
    """Draw a trajectory that `undulator run` saved, up to its last state.

    Writes a video beside the file. Exit code 0: done; 2: bad input; 3: nothing here can render.
    """

    trajectory: Annotated[Path, tyro.conf.Positional]
    """a .nc file of a run"""
    plugin: Plugins = ()


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, ("videos/felt.nc",))
    if gl.use_backend() is None:
        print(f"{PROGRAM}: {gl.HELP}", file=sys.stderr)
        return FAILED

    try:
        plugins.load(options.plugin)
    except ValueError as error:
        fail(PROGRAM, str(error))
    from mjsim.pictures.recording import film
    from mjsim.results.trajectory import load

    try:
        walk = load(options.trajectory)
    except (OSError, KeyError, TypeError, ValueError) as error:
        fail(PROGRAM, f"cannot read a trajectory from {str(options.trajectory)!r}: {error}")
    video = options.trajectory.with_suffix(".mp4")
    film([walk], [video])
    print(video)
    return 0
