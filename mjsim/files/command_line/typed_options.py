"""Options as they were typed: which one a message is about, and which one was meant."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from difflib import get_close_matches
from pathlib import PurePath
from typing import Any, get_args, get_type_hints

from analytic.checks import meant

_SUBJECT = re.compile(
    r"(?:\[(?P<table>\w+)\] )?(?P<key>[a-z_]+)(?P<rest>(?:'s parts)? (?:must|is for) .*)", re.DOTALL
)
_PART = re.compile(
    r"(?:\[(?P<table>\w+)\] )?(?P<key>[a-z_]+)(?P<rest>(?:, number \d+)?: .*)", re.DOTALL
)  # of a key that has tables of its own
_TABLES = {"surface": "ground"}  # of options that are called otherwise
_OTHERS = {"--ground": "--surface", "--mu": "--surface.friction", "--dt": "--timestep",
           "--speed": "--gait.ramp-time"}  # fmt: skip

_FILES = {".toml": "--scene", ".csv": "--gait"}  # of files without an option


class TypedOptions:
    """Options of a command, and the words that were typed.

    Args:
        kind: the dataclass of the options.
        words: as typed.
    """

    def __init__(self, kind: type, words: Sequence[str]) -> None:
        self._kind = kind
        self._typed = [word.partition("=")[0] for word in words if word.startswith("--")]

    def named(self, message: str) -> str:
        """A message that begins with a key, or a table and a key, with the option for the key."""
        match = _SUBJECT.fullmatch(message) or _PART.fullmatch(message)
        if match is None or not self._typed:
            return message
        for typed in self._typed:
            names = self._alike(typed)
            keys = {name.rpartition(".")[2].lstrip("-").replace("-", "_") for name in names}
            tables = {name.lstrip("-").partition(".")[0] for name in names if "." in name}
            tables = {_TABLES.get(table, table) for table in tables}
            if "period" in keys:  # which the ramps are parts of
                keys.add("ramp_time")
            if typed == "--gait":
                keys, tables = {"name"}, {"gait"}
            if match["key"] in keys and (match["table"] is None or match["table"] in tables
                                         or not tables):  # fmt: skip
                return f"{typed}{match['rest']}"
        beside = self._beside(match["table"], match["key"])
        return f"{beside}{match['rest']}" if beside else message

    def _beside(self, table: str | None, key: str) -> str | None:
        """Option for a key of a table, where another of the table was typed, and no scene file."""
        of_table = [
            name for names in self._names() for name in names
            if "." in name and _table_of(name) == table
        ]  # fmt: skip
        if "--scene" in self._typed or not set(self._typed) & set(of_table):
            return None
        wanted = key.replace("_", "-")
        return next((name for name in of_table if name.partition(".")[2] == wanted), None)

    def as_typed(self, option: str) -> str:
        """Name of an option that was typed, of those that it has."""
        names = self._alike(option)
        return next((typed for typed in self._typed if typed in names), option)

    def unknown(self, words: Sequence[str]) -> str:
        """Message about words that are none of the options, with the option that may be meant."""
        word = next((word for word in words if word.startswith("-")), words[0])
        option = word.partition("=")[0]
        if not option.startswith("-"):
            named = {name for names in self._names() for name in names}
            fits = _FILES.get(PurePath(word).suffix.lower())
            asked = f"; did you mean {fits} {word}?" if fits in named else ""
            return f"no argument is known beside options, got {word!r}{asked}"
        return f"option {option} is unknown{self._meant(option)}"

    def _meant(self, option: str) -> str:
        options = [name for names in self._names() for name in names]
        if option in _OTHERS and _OTHERS[option] in options:
            return f"; did you mean {_OTHERS[option]}?"
        key = "--" + option.rpartition(".")[2].lstrip("-")
        begun = [name for name in options if name.startswith(option)]
        same = [name for name in options if name.rpartition(".")[2] == key.lstrip("-")]
        if len(option) > 3 and (begun or same):
            return f"; did you mean {' or '.join((begun or same)[:3])}?"
        ends = {name.rpartition(".")[2]: name for name in options if "." in name}
        near = get_close_matches(key.lstrip("-"), ends, 1, 0.7)
        return meant(option, options) or (f"; did you mean {ends[near[0]]}?" if near else "")

    def _alike(self, typed: str) -> set[str]:
        """All names of an option."""
        return {typed, *(name for names in self._names() if typed in names for name in names)}

    def _names(self) -> list[tuple[str, ...]]:
        return list(_names_of(self._kind, ""))


def _table_of(option: str) -> str:
    """Table of a scene file that an option with a dot is of."""
    name = option.lstrip("-").partition(".")[0]
    return _TABLES.get(name, name)


def _names_of(kind: Any, prefix: str) -> Iterator[tuple[str, ...]]:
    """Names of each option of a dataclass, as tyro makes them."""
    hints = get_type_hints(kind, include_extras=True)
    for field in fields(kind):
        hint = hints[field.name]
        marks = getattr(hint, "__metadata__", ())
        named = next((mark.name for mark in marks if getattr(mark, "name", None)), field.name)
        aliases = next((mark.aliases for mark in marks if getattr(mark, "aliases", None)), ())
        option, inner = prefix + named.replace("_", "-"), get_args(hint)[0] if marks else hint
        if is_dataclass(inner):
            yield from _names_of(inner, f"{option}.")
        else:
            yield (f"--{option}", *aliases)
