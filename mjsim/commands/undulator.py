"""One console script for all commands: `undulator run`, `undulator fit` and so on."""

import sys
from collections.abc import Sequence

from mjsim.files.interruption import guarded

PROGRAM = "undulator"
COMMANDS = {  # module of mjsim.commands, and the line of the help
    "run": ("run", "walk in MuJoCo, beside the theory, with a video"),
    "compare": ("compare", "every model on the same scenes in one table"),
    "sensitivity": ("sensitivity", "what a per cent of each field does to the distance"),
    "fit": ("fit", "fit unknown parameters of a scene to measurements"),
    "ground": ("ground", "numbers of one's own ground from tilt and pull tests"),
    "view": ("view", "play a scene live in MuJoCo's viewer"),
    "report": ("report", "one self-contained page about saved walks"),
    "replay": ("replay", "a video of a saved walk"),
    "export": ("export", "a scene as MJCF that walks by itself"),
    "sweep": ("sweep", "many scenes on all cores or a cluster, into one file"),
    "analyse": ("analysis", "a sweep as a table and pictures"),
    "optimise": ("optimise", "the best gait for a ground"),
}


def main(argv: Sequence[str] | None = None) -> int:
    """Call the command that is named first; returns its exit code.

    Args:
        argv: what was typed; that of this process if None, which Ctrl-C then ends in one line.
    """
    return call(argv) if argv is not None else start(sys.argv[1:])


def start(words: Sequence[str]) -> int:
    """Call the command as the one work of this process, whose Ctrl-C is taken over."""
    name = f"{PROGRAM} {words[0]}" if words and words[0] in COMMANDS else PROGRAM
    return guarded(name, lambda: call(words))


def call(words: Sequence[str]) -> int:
    """Call the command that is the first of the words; returns its exit code."""
    from importlib import import_module

    from mjsim.files.command_line.cli import fail, say

    name = words[0] if words else "--help"
    if name in ("-h", "--help"):
        say(_help())
        return 0
    if name == "--version":
        from mjsim.results.provenance import versions

        say("\n".join(f"{package} {version}" for package, version in versions().items()))
        return 0
    if name not in COMMANDS:
        from difflib import get_close_matches

        near = get_close_matches(name, COMMANDS, 1)
        hint = f"; did you mean {near[0]}?" if near else ""
        fail(PROGRAM, f"command must be one of {', '.join(COMMANDS)}; got {name!r}{hint}")
    return int(import_module(f"mjsim.commands.{COMMANDS[name][0]}").main(words[1:]))


def _help() -> str:
    commands = "\n".join(f"  {name:<12}{text}" for name, (_, text) in COMMANDS.items())
    return f"""\
How far, and which way, a robot of pneumatic limbs goes on a ground.

usage: {PROGRAM} COMMAND [OPTIONS]

{commands}

{PROGRAM} COMMAND --help explains each, {PROGRAM} --version prints versions.

examples:
  {PROGRAM} run --surface gelatin
  {PROGRAM} run --robot quadruped --surface all
  {PROGRAM} fit track.csv --scene my.toml --free robot.modulus,surface.tip_force"""
