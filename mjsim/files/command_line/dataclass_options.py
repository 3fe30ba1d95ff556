"""Options of a command from the fields of a dataclass: their types, units and help."""

from collections.abc import Iterable, Mapping
from dataclasses import field, fields, is_dataclass, make_dataclass
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Optional, Union, get_args, get_origin, get_type_hints

import tyro

from analytic.fields import field_docs


def optional(
    name: str,
    kinds: Mapping[type, Iterable[str]],
    aliases: Mapping[str, str] | None = None,
) -> type[Any]:
    """Make a dataclass of fields of others, each None unless it is given.

    Args:
        name: of the new class.
        kinds: names of the fields by their dataclass, documented by the words below each.
        aliases: other options that mean the same, by field.
    """
    items = []
    for kind, names in kinds.items():
        hints, docs = get_type_hints(kind), field_docs(kind)
        defaults = {item.name: item.default for item in fields(kind)}
        for key in names:
            alias = (aliases or {}).get(key)
            hint = option(_plain(hints[key]), docs.get(key, ""), defaults[key], alias)
            items.append((key, hint, field(default=None)))
    new = make_dataclass(name, items, frozen=True)
    new.__doc__ = " "
    return new


def option(kind: Any, text: str, default: Any = None, alias: str | None = None) -> Any:
    """Type of an option that is None unless given.

    Args:
        kind: type of its value.
        text: its help.
        default: value if it is not given, to be shown.
        alias: another name of the option.
    """
    words = get_args(kind) if get_origin(kind) is Literal else ()
    metavar = "{" + ",".join(words) + "}" if words else kind.__name__.upper()
    argument = tyro.conf.arg(
        help=text,
        aliases=(alias,) if alias else None,
        metavar=metavar,
        help_behavior_hint="" if default in (None, ()) else f"(default: {_shown(default)})",
    )
    # text of a number, which may carry its unit; for X | None tyro would import typeguard
    return Annotated[Optional[str if kind is float else kind], argument]  # noqa: UP045


def given(options: Any) -> dict[str, Any]:
    """Fields that are not None."""
    return {key: value for key, value in vars(options).items() if value is not None}


def parts(text: str) -> tuple[str, ...] | str:
    """Words of a list with commas between, or the text if it is a single word."""
    words = tuple(word.strip() for word in text.split(","))
    return words if len(words) > 1 else text


def _shown(default: Any) -> str:
    if isinstance(default, tuple):
        return ",".join(f"{part:g}" for part in default)
    return f"{default:.6g}" if isinstance(default, float) else str(default)


def _plain(hint: Any) -> Any:
    """Type without None, and text in place of a list or of a table."""
    parts = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    parts = tuple(part for part in parts if part is not NoneType)
    text = any(get_origin(part) is tuple or is_dataclass(part) for part in parts)
    return str if text else Union[parts]  # noqa: UP007
