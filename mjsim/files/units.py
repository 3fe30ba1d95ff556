"""Values with the unit that they were measured in: `7 psi`, `90 mm`, `12 g`; inside all are SI."""

import re
from functools import cache
from typing import Any

_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_LARGEST = 60  # letters of a value; longer ones are no quantity


def in_unit(name: str, value: str, unit: str | None) -> float:
    """A number, or a number with a unit, in the unit that the program uses.

    Args:
        name: of the value, for the message.
        value: as it was written.
        unit: in which it is wanted; None or "1" for a plain number, which may be in %.

    Raises:
        ValueError: it is no number, or one with a unit of another kind.
    """
    try:
        return float(value)
    except ValueError:
        pass
    found = _NUMBER.match(value)
    if found is None or len(value) > _LARGEST:
        raise ValueError(_message(name, value, unit)) from None
    words = value[found.end() :].strip()
    try:
        return float(found.group()) * _factor(words, "1" if unit is None else unit)
    except Exception as error:  # whatever a parser of units makes of words that are none
        raise ValueError(_message(name, value, unit)) from error


@cache
def _factor(words: str, unit: str) -> float:
    """How many of the one unit the other is."""
    registry = _registry()
    wanted = registry.Unit("" if unit == "1" else unit)
    return float(registry.Quantity(1.0, words).to(wanted).magnitude)


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


def _message(name: str, value: str, unit: str | None) -> str:
    kind = "a number" if unit in (None, "1") else f"a number of {unit}, or one with its unit"
    return f"{name} must be {kind}, got {value!r}"
