"""Documentation of the fields of a dataclass, the text below each, and the unit in it.

Values of fields may be given with a unit, as in `Robot(length="110 mm")`: see `in_si`.
"""

import ast
import inspect
import re
import sys
from collections.abc import Iterable, Mapping
from dataclasses import MISSING, fields
from functools import cache
from itertools import pairwise
from typing import Any, TypeVar, get_args, get_type_hints

from analytic.checks import one_of
from analytic.units import in_unit

Kind = TypeVar("Kind")

_CITATION = re.compile(r"[A-Z][a-z]+\d\d$")


@cache
def field_docs(kind: type) -> Mapping[str, str]:
    """Text below each field of a dataclass, its documentation, in one line."""
    module = ast.parse(inspect.getsource(sys.modules[kind.__module__]))
    classes = {node.name: node for node in module.body if isinstance(node, ast.ClassDef)}
    docs: dict[str, str] = {}
    for statements in pairwise(classes[kind.__name__].body):
        match statements:
            case (
                ast.AnnAssign(target=ast.Name(id=name)),
                ast.Expr(value=ast.Constant(value=str(text))),
            ):
                docs[name] = " ".join(text.split())
    return docs


def units(kind: type) -> Mapping[str, str]:
    """Unit of each field that has one in its documentation: [m], [Pa s/m], [1]."""
    brackets = {name: re.findall(r"\[([^\]]+)\]", text) for name, text in field_docs(kind).items()}
    texts = {name: [w for w in words if not _CITATION.match(w)] for name, words in brackets.items()}
    return {name: words[0] for name, words in texts.items() if words}


def in_si(record: Any) -> None:
    """Convert the texts among the numbers of a frozen dataclass, `110 mm`, to SI.

    Args:
        record: of a class whose fields have their units in their documentation.

    Raises:
        ValueError: a text is no number, or has a unit of another kind.
    """
    texts = {
        field.name: value for field in fields(record)
        if field.type is not str
        and isinstance(value := getattr(record, field.name), str | tuple | list)
    }  # fmt: skip
    if not any(isinstance(v, str) or any(isinstance(x, str) for x in v) for v in texts.values()):
        return
    hints, unit_of = get_type_hints(type(record)), units(type(record))
    for name, value in texts.items():
        kinds = {hints[name], *get_args(hints[name])}
        if isinstance(value, str) and float in kinds:
            object.__setattr__(record, name, in_unit(name, value, unit_of.get(name)))
        elif not isinstance(value, str) and any(float in get_args(kind) for kind in kinds):
            parts = tuple(
                in_unit(name, part, unit_of.get(name)) if isinstance(part, str) else part
                for part in value
            )
            object.__setattr__(record, name, parts)


def records(kind: type[Kind], noun: str, given: Iterable[Kind | Mapping[str, Any]]) -> list[Kind]:
    """Make a dataclass of each table of its fields; those that are made are taken.

    Args:
        kind: the dataclass.
        noun: of one, for messages.
        given: tables or records.

    Raises:
        ValueError: one is neither, or has a key that is no field, or misses one.
    """
    if isinstance(given, str) or not hasattr(given, "__iter__"):
        raise ValueError(f"{_plural(noun)} must be {kind.__name__}, or tables of its fields, got "
                         f"{given!r}")  # fmt: skip
    return [_record(kind, noun, one) for one in given]


def _record(kind: type[Kind], noun: str, given: Kind | Mapping[str, Any]) -> Kind:
    if isinstance(given, kind):
        return given
    if not isinstance(given, Mapping):
        raise ValueError(f"{_plural(noun)} must be {kind.__name__}, or tables of its fields, got "
                         f"{given!r}")  # fmt: skip
    every = fields(kind)  # type: ignore[arg-type]
    for key in given:
        one_of(f"key of a {noun}", key, [field.name for field in every])
    for field in every:
        if field.default is MISSING and field.name not in given:
            raise ValueError(f"{field.name} of a {noun} is missing, got {dict(given)!r}")
    check_keys(kind, given)
    return kind(**given)


def check_keys(kind: type[Any], given: Mapping[str, Any], where: str = "") -> None:
    """Let a dataclass with a `check_keys` refuse the keys of a table by ValueError.

    Args:
        kind, given: the dataclass and the table of its fields.
        where: beginning of the message.
    """
    check = getattr(kind, "check_keys", None)
    if check:
        check(given, where)


def _plural(noun: str) -> str:
    return {"foot": "feet"}.get(noun, f"{noun}s")
