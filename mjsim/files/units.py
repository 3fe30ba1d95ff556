"""Conversion of values with a unit, `7 psi`, `90 mm`, `12 g`, to SI."""

import re
from functools import cache
from typing import Any

_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_LARGEST = 60  # letters of a value; longer ones are no quantity


def in_unit(name: str, value: str, unit: str | None) -> float:
    """Convert a number, or a number with a unit, to the unit of the program.

    Args:
        name: of the value, for the message.
        value: text.
        unit: of the result; None or "1" for a plain number, which may be in %.

    Raises:
        ValueError: it is no number, or one with a unit of another kind.
    """
    try:
        return float(value)
    except ValueError:
        pass
    number = _NUMBER.match(value)
    if number is None or len(value) > _LARGEST:
        raise ValueError(_message(name, value, unit)) from None
    words = value[number.end() :].strip()
    try:
        return float(number.group()) * _factor(words, "1" if unit is None else unit)
    except Exception as error:  # pint raises many kinds for words that are no unit
        raise ValueError(_message(name, value, unit)) from error


@cache
def _factor(words: str, unit: str) -> float:
    """Factor from the unit that words name to another."""
    registry = _registry()
    target = registry.Unit("" if unit == "1" else unit)
    return float(registry.Quantity(1.0, words).to(target).magnitude)


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


def _message(name: str, value: str, unit: str | None) -> str:
    kind = "a number" if unit in (None, "1") else f"a number of {unit}, or one with its unit"
    return f"{name} must be {kind}, got {value!r}"
