"""A video of a saved trajectory, of a run that failed too: `undulator replay`."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from mjsim.files import plugins
from mjsim.files.command_line.cli import FAILED, Plugins, fail, parse, warn
from mjsim.pictures import gl

PROGRAM = "undulator replay"


@dataclass(frozen=True)
class Options:
    """Make a video of a trajectory that `undulator run` saved, up to its last state.

    Writes it beside the file. Exit code 0: done; 2: bad input; 3: nothing here can render.
    """

    trajectory: Annotated[Path, tyro.conf.Positional]
    """a .nc file of a run"""
    plugin: Plugins = ()


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, ("videos/felt.nc",))
    if gl.use_backend() is None:
        warn(PROGRAM, gl.HELP)
        return FAILED
    from mjsim.pictures.recording import film
    from mjsim.results.trajectory import read

    try:
        plugins.load(options.plugin)
        walk, _ = read(options.trajectory)
    except ValueError as error:
        fail(PROGRAM, str(error))
    video = options.trajectory.with_suffix(".mp4")
    try:
        film([walk], [video])
    except OSError as error:
        fail(PROGRAM, f"the video cannot be written: {error}")
    print(video)
    return 0
