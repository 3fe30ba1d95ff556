"""Conversion of values with a unit, `7 psi`, `90 mm`, `12 g`, to SI.

The units are those of analytic.units; pint, which takes long to import, is asked for rarer ones.
"""

from functools import cache
from typing import Any

from analytic import units


def in_unit(name: str, value: str, unit: str | None) -> float:
    """Convert a number, or a number with a unit, to the unit of the program.

    Args:
        name: of the value, for the message.
        value: text.
        unit: of the result; None or "1" for a plain number, which may be in %.

    Raises:
        ValueError: it is no number, or one with a unit of another kind.
    """
    number, words = units.split_number(value)
    if number is None or not words or units.find(units.split_reference(words)[0]) is not None:
        return units.in_unit(name, value, unit)
    try:
        return number * _factor(words, "1" if unit is None else unit)
    except Exception as error:  # pint raises many kinds for words that are no unit
        raise ValueError(units.refusal(name, value, unit)) from error


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
