"""Dataclasses of given values: numbers with units, words, lists, each checked against its type."""

import tomllib
from collections.abc import Mapping
from dataclasses import MISSING, fields, is_dataclass
from numbers import Real
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from analytic.checks import meant, missing, one_of
from analytic.fields import check_keys, units
from mjsim.files.units import in_unit

Table = dict[str, Any]
Kind = TypeVar("Kind")

_UNITS = {"ramp_time": "s"}  # of a Gait; other fields have it in their documentation


def make(kind: type[Kind], table: Mapping[str, Any], where: str = "", **more: Any) -> Kind:
    """Make a dataclass of given values and defaults, checked against their types.

    Raises:
        ValueError: a key is no field, a value is not of its type or out of range, or one is
            missing.
    """
    values = {**checked(kind, table, where), **more}
    for field in fields(kind):  # type: ignore[arg-type]
        needed = field.default is MISSING and field.default_factory is MISSING
        if needed and field.name not in values:
            raise ValueError(f"{where}{field.name} is missing")
    check_keys(kind, values, where)
    try:
        return kind(**values)
    except ValueError as error:
        raise ValueError(f"{where}{error}") from error


def checked(kind: type[Any], table: Mapping[str, Any], where: str) -> Table:
    """Values of a table, each of the type of the dataclass's field.

    Raises:
        ValueError: a key is no field, or a value is not of its type.
    """
    hints = get_type_hints(kind)
    values = {}
    for key, value in table.items():
        if key not in hints:
            raise ValueError(
                f"{where}key {key!r} is unknown; known are {', '.join(hints)}{meant(key, hints)}"
            )
        unit = _UNITS.get(key) or units(kind).get(key)
        values[key] = as_type(hints[key], value, f"{where}{key}", unit)
    return values


def as_type(hint: Any, value: Any, name: str, unit: str | None = None) -> Any:
    """Convert a value to its type.

    Lists become tuples and whole numbers floats, and numbers with a unit are converted to SI.

    Raises:
        ValueError: it is not of that type.
    """
    options = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    for option in options:
        if option is NoneType:
            continue
        if get_origin(option) is Literal:
            one_of(name, value, get_args(option))
            return value
        real = isinstance(value, Real) and not isinstance(value, bool)
        if option is float and real:
            return float(value)  # its user checks whether it is finite
        if option is int and real and not isinstance(value, float):
            return value
        if option in (str, bool) and isinstance(value, option):
            return value
        if (
            isinstance(option, type)
            and is_dataclass(option)
            and isinstance(value, option | Mapping)
        ):
            return _record(option, value, name)
        if get_origin(option) is tuple and isinstance(value, list | tuple):
            inner = get_args(option)[0]
            if isinstance(inner, type) and is_dataclass(inner):
                tables = enumerate(value, start=1)
                return tuple(_record(inner, item, f"{name}, number {i}") for i, item in tables)
            return tuple(as_type(inner, item, f"{name}'s parts", unit) for item in value)
    if isinstance(value, str) and float in options:
        return in_unit(name, value, unit)
    raise ValueError(f"{name} must be {_described(options)}, got {value!r}")


def _record(kind: type[Kind], value: Any, name: str) -> Kind:
    """Make a dataclass of a table, or take one that is made.

    Raises:
        ValueError: it is neither.
    """
    if isinstance(value, kind):
        return value
    if not isinstance(value, Mapping):
        raise ValueError(f"{name} must be a table, got {value!r}")
    return make(kind, value, f"{name}: ")


def _described(options: tuple[Any, ...]) -> str:
    words = {float: "a number", int: "a whole number", str: "a word", bool: "true or false"}
    tables = {o: "a table" for o in options if is_dataclass(o)}
    return " or ".join((words | tables).get(o, "a list") for o in options if o is not NoneType)


def as_number(value: Any, name: str, unit: str) -> float:
    """Convert a number in an SI unit, or a text with its own unit.

    Raises:
        ValueError: it is none.
    """
    return float(as_type(float, value, name, unit))


def read_toml(path: Path, what: str) -> Table:
    """Read a TOML file.

    Raises:
        ValueError: it cannot be read, or is no TOML; the message begins with `what`, its kind.
    """
    try:
        return tomllib.loads(path.read_bytes().decode("utf-8-sig"))  # Windows marks the byte order
    except OSError as error:
        raise ValueError(f"{what} {str(path)!r} cannot be read: {missing(path, error)}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{what} {str(path)!r} is no TOML: {error}") from error
