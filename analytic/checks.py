"""Checks of values that people give: each refuses in one line that names the value."""

import math
from collections.abc import Collection, Iterable
from difflib import get_close_matches
from numbers import Integral, Real
from pathlib import Path
from typing import Any

import numpy as np

_LONGEST_WORD = 60  # of a file name
_ALIKE = 0.7  # part of the letters from which on a word is taken for another mistyped; chosen


def is_number(value: Any) -> bool:
    """Tell whether a value is a finite real number, of Python or NumPy, and no truth value."""
    return isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)


def positive(name: str, value: Any, unit: str = "") -> None:
    """Raise ValueError unless the value is a number above 0."""
    if not (is_number(value) and value > 0):
        raise ValueError(f"{name} must be a positive finite number{_of(unit)}, got {_shown(value)}")


def not_negative(name: str, value: Any, unit: str = "") -> None:
    """Raise ValueError unless the value is a number of 0 or more."""
    if not (is_number(value) and value >= 0):
        raise ValueError(
            f"{name} must be a finite number{_of(unit)}, at least 0, got {_shown(value)}"
        )


def whole(name: str, value: Any, least: int, most: int | None = None) -> None:
    """Raise ValueError unless the value is a whole number within bounds, both included."""
    number = isinstance(value, Integral) and not isinstance(value, bool)
    if not (number and value >= least and (most is None or value <= most)):
        bounds = f"of at least {least}" if most is None else f"from {least} to {most}"
        raise ValueError(f"{name} must be a whole number {bounds}, got {_shown(value)}")


def one_of(name: str, value: Any, valid: Iterable[str]) -> None:
    """Raise ValueError unless the value is one of the valid words."""
    if isinstance(value, str) and isinstance(valid, Collection) and value in valid:
        return  # a registry need not look for all that it has
    words = list(valid)
    if value not in words:
        raise ValueError(
            f"{name} must be one of {', '.join(words)}; got {value!r}{meant(value, words)}"
        )


def slope(value: Any) -> None:
    """Raise ValueError unless the value is the angle of a slope, below a right angle [rad]."""
    if not (is_number(value) and abs(value) < math.pi / 2):
        shown = f"{math.degrees(value):g} degrees" if isinstance(value, Real) else repr(value)
        raise ValueError(f"slope must be less steep than 90 degrees, got {shown}")


def file_word(name: str, value: Any) -> None:
    """Raise ValueError unless the value can stand in a file name."""
    fine = isinstance(value, str) and value.isprintable() and "/" not in value
    if not (fine and 0 < len(value) <= _LONGEST_WORD):
        raise ValueError(
            f"{name} must be a word of up to {_LONGEST_WORD} letters without slashes, got {value!r}"
        )


def _of(unit: str) -> str:
    return f" [{unit}]" if unit else ""


def _shown(value: Any) -> str:
    """Written form of a value: NumPy's numbers without their type."""
    return repr(value.item()) if hasattr(value, "item") else repr(value)


def times_of(times: Any, rows: int) -> None:
    """Refuse times that are not one for each of so many rows, or go back.

    Raises:
        ValueError: they are.
    """
    clock = np.asarray(times, dtype=float)
    if clock.shape != (rows,) or not np.isfinite(clock).all():
        raise ValueError(f"times must be {rows} numbers, one for each row of the path, got {times}")
    back = np.flatnonzero(np.diff(clock) < 0)
    if len(back):
        raise ValueError(
            f"times of a path must not decrease, got {clock[back[0] + 1]:g} s after "
            f"{clock[back[0]]:g} s"
        )


def meant(word: Any, words: Iterable[str]) -> str:
    """Question after the word that is meant by a mistyped one, or nothing."""
    by_lower_case = {name.lower(): name for name in words}
    near = get_close_matches(str(word).lower(), by_lower_case, 1, _ALIKE)
    return f"; did you mean {by_lower_case[near[0]]}?" if near else ""


def missing(path: Path, error: OSError) -> str:
    """Reason why a file cannot be read; of one that is not there the name of a similar one."""
    if not isinstance(error, FileNotFoundError):
        return str(error.strerror)
    if not path.parent.is_dir():
        return f"no such file, nor a folder {str(path.parent)!r}"
    return f"no such file{meant(path.name, (other.name for other in path.parent.iterdir()))}"
