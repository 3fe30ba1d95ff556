"""Play a scene live in MuJoCo's viewer: `undulator view`."""

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass

from mjsim.files.command_line.cli import FAILED, fail, parse, warn
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.scene_tables.tables import build

PROGRAM = "undulator view"


@dataclass(frozen=True)
class Options(SceneOptions):
    """Play a scene in a window: the gait over and over, or pressures by hand.

    Space plays and pauses the gait, Backspace starts anew; under Control, at the right, are sliders
    of the pressures and the ground. Exit code 0: closed; 2: bad input; 3: no screen here.
    """

    speed: float = 1.0
    """times real time, where the machine can"""
    seconds: float | None = None
    """close by itself after so long [s]"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, ("--surface gelatin", "--robot quadruped"))
    try:
        _check("speed", options.speed)
        if options.seconds is not None:
            _check("seconds", options.seconds)
        tables = tables_of(options)
        if len(tables) > 1:
            names = ", ".join(scene.ground.name for scene, _ in map(build, tables))
            raise ValueError(
                f"surface must be one, others can be chosen in the window; got {names}"
            )
        from mjsim.pictures.live.session import Session

        scene, numerics = build(tables[0])
        if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
            warn(PROGRAM, "there is no screen (DISPLAY is not set); without one, xvfb-run -a sets "
                 "one up")  # fmt: skip
            return FAILED
        session = Session(scene, numerics)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))

    from mjsim.pictures.live.window import show

    shown = show(session, options.speed, options.seconds)
    rate, times = shown.frames / shown.wall_time, shown.simulated / shown.wall_time
    print(f"{rate:.0f} frames per second, {times:.2f} times real time, "
          f"{session.displacement:+.4f} L ahead, {session.seen.status}")  # fmt: skip
    return 0


def _check(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0):
        raise ValueError(f"{name} must be a positive number, got {value:g}")
