"""Gaits by name, or as data: a TOML file of stages and durations.

name = "gallop"                      # optional; else the file's
stages = [[0, 0], [1, 0], [0, 0]]    # fractions of the peak pressure, left segment first
durations = [2.0, 1.5]               # of the ramps between stages [s]; a number stands for all
"""

import tomllib
from pathlib import Path
from typing import Any

from analytic import GAITS, Gait

_KEYS = ("name", "stages", "durations")


def find_gait(word: str) -> Gait:
    """The gait of a name, or of a .toml file.

    Raises:
        ValueError: there is no such gait, or the file cannot be read or says what no gait can be;
            the message names the key.
    """
    if word in GAITS:
        return GAITS[word]
    if not word.endswith(".toml"):
        raise ValueError(f"gait must be one of {', '.join(GAITS)}, or a .toml file; got {word!r}")
    path = Path(word)
    try:
        said = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ValueError(f"gait {word!r} cannot be read: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"gait {word!r} is no TOML: {error}") from error
    try:
        return _gait(said, path.stem)
    except ValueError as error:
        raise ValueError(f"gait {word!r}: {error}") from error


def _gait(said: dict[str, Any], stem: str) -> Gait:
    for key in said:
        if key not in _KEYS:
            raise ValueError(f"key {key!r} is unknown; known are {', '.join(_KEYS)}")
    if "stages" not in said:
        raise ValueError("key 'stages' is missing")
    name = said.get("name", stem)
    if not (isinstance(name, str) and name and "/" not in name):
        raise ValueError(f"key 'name' must be a word without slashes, got {name!r}")
    stages, durations = said["stages"], said.get("durations", Gait.ramp_time)
    if not (isinstance(stages, list) and all(isinstance(s, list) for s in stages)):
        raise ValueError(f"key 'stages' must be a list of lists of fractions, got {stages!r}")
    times = durations if isinstance(durations, list) else [durations]
    for key, numbers in (("stages", [n for stage in stages for n in stage]), ("durations", times)):
        for number in numbers:
            if isinstance(number, bool) or not isinstance(number, int | float):
                raise ValueError(f"key {key!r} must hold numbers, got {number!r}")
    time = tuple(map(float, times)) if isinstance(durations, list) else float(durations)
    shape = tuple(tuple(map(float, stage)) for stage in stages)
    try:
        Gait(name, shape)
    except ValueError as error:
        raise ValueError(f"key 'stages': {error}") from error
    try:
        return Gait(name, shape, time)
    except ValueError as error:
        raise ValueError(f"key 'durations': {error}") from error
