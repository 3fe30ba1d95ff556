"""Columns of a log: which one is the time, and which ones are a robot's chambers.

The time is told by its name. Chambers are told by the names of the robot's chambers, as `left
[kPa]` or `pressure right`; else by numbers or letters, as p3, p2, p1 or a, b, c, in their order;
else they are the columns of pressures from left to right, where there are as many as chambers.
Other columns do not count, and are named in a note.
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from analytic.checks import meant
from analytic.units import factor, find
from mjsim.files.csv_table import CsvTable, Head, head_of

_TIMES = ("time", "t", "timestamp", "stamp", "elapsed", "seconds", "zeit", "clock", "ms", "s")
_SAID = frozenset(  # words that say no more than that a column is of pressures
    [
        "p",
        "pres",
        "press",
        "pressure",
        "pressures",
        "pneumatic",
        "chamber",
        "chambers",
        "ch",
        "segment",
        "seg",
        "channel",
        "sensor",
        "actuator",
        "gauge",
        "gage",
        "absolute",
        "abs",
        "measured",
        "meas",
        "of",
        "in",
        "the",
    ]
)
_NUMBER = re.compile(r"[-+\d.,eE]+")
_ABSOLUTE = ("abs", "absolute")


class Columns(NamedTuple):
    """Columns of a log.

    Attributes:
        time: number of that of the time.
        chambers: numbers of those of the chambers, in their order.
        heads: of all columns; of those that were chosen with the units that were given.
        notes: on what was left out, or taken in the order of the file.
    """

    time: int
    chambers: list[int]
    heads: list[Head]
    notes: list[str]

    @property
    def absolute(self) -> bool:
        """Tell whether the heads of the chambers say that pressures are absolute."""
        return any(
            self.heads[i].absolute or {*_words(self.heads[i].name)} & {*_ABSOLUTE}
            for i in self.chambers
        )


def find_columns(table: CsvTable, chambers: Sequence[str], chosen: Sequence[str] = ()) -> Columns:
    """Find the columns of time and chambers.

    Args:
        table: the log.
        chambers: names of the robot's chambers; empty if not known.
        chosen: names of the columns of the chambers in their order, before them that of the time if
            there is one more; each may have a unit in brackets, which counts.

    Raises:
        ValueError: a column is not there or not a single one, or it is not clear which are meant.
    """
    if all(_NUMBER.fullmatch(head) for head in table.heads):
        raise ValueError(
            f"{table.where}: needs a first line of names and units, such as time [s], p1 [kPa]; "
            f"got {', '.join(table.heads)}"
        )
    heads = [head_of(head) for head in table.heads]
    if chosen:
        return _chosen(table, heads, chambers, chosen)
    time = _time(heads)
    others = [i for i in range(len(heads)) if i != time]
    if not others:
        raise ValueError(
            f"{table.where}: needs a column of time and one per segment, with commas, semicolons, "
            f"tabs, bars or blanks between, got one column, {table.heads[0]!r}"
        )
    keys = _keys(heads, others)
    normal = [_normal(name) for name in chambers]
    named = [i for i in others if _number(keys[i]) is not None or keys[i] in normal]
    pressures = [i for i in others if _is_pressure(heads[i])]
    candidates = sorted({*pressures, *(named if pressures else others)})
    picked, notes = _picked(table, heads, keys, candidates, normal)
    ignored = [table.heads[i] for i in others if i not in picked and table.heads[i]]
    if ignored:
        notes.append(f"columns that do not count: {', '.join(map(repr, ignored))}")
    return Columns(time, picked, heads, notes)


def _chosen(
    table: CsvTable, heads: list[Head], chambers: Sequence[str], chosen: Sequence[str]
) -> Columns:
    heads = list(heads)
    with_time = bool(chambers) and len(chosen) == len(chambers) + 1
    if not with_time and _time_word(head_of(chosen[0])):
        with_time = True
    numbers = []
    for word in chosen:
        given = head_of(word)
        same = [i for i, head in enumerate(table.heads) if head == word]
        same = same or [i for i, head in enumerate(heads) if head.name == given.name]
        same = same or [i for i, h in enumerate(heads) if _normal(h.name) == _normal(given.name)]
        if len(same) != 1:
            names = [head.name for head in heads]
            raise ValueError(
                f"{table.where}: columns must be among {', '.join(names)}; got {word!r}, which is "
                f"{'in it twice' if same else 'not'}{'' if same else meant(word, names)}"
            )
        if given.unit:
            heads[same[0]] = given
        numbers += same
    time = numbers.pop(0) if with_time else _time(heads)
    if time in numbers or len(set(numbers)) < len(numbers):
        raise ValueError(f"{table.where}: columns must be different ones, got {', '.join(chosen)}")
    return Columns(time, numbers, heads, [])


def _time(heads: Sequence[Head]) -> int:
    """Number of the column of the time: by name, by unit, else the first."""
    named = [i for i, head in enumerate(heads) if _time_word(head)]
    timed = [i for i, head in enumerate(heads) if factor(head.unit, "s") is not None]
    return next((i for i in named if i in timed), (named or timed or [0])[0])


def _time_word(head: Head) -> bool:
    return any(word in _TIMES for word in _words(head.name)[:2])


def _is_pressure(head: Head) -> bool:
    return factor(head.unit, "Pa") is not None


def _words(name: str) -> list[str]:
    """Words and numbers of a name, in lower case: p1_Left is p, 1, left."""
    return re.findall(r"\d+|[^\W\d_]+", name.lower())


def _normal(name: str) -> str:
    return "-".join(_words(name))


def _keys(heads: Sequence[Head], others: Sequence[int]) -> dict[int, str]:
    """Names of columns without the words that all of them have, or that say nothing."""
    words = {i: _words(_whole(heads[i])) for i in others}
    pressures = [{*words[i]} for i in others if _is_pressure(heads[i])]
    common = set.intersection(*pressures) if len(pressures) > 1 else set()
    kept = {
        i: [w for w in of if w not in _SAID and (w not in common or w.isdigit())] or of
        for i, of in words.items()
    }
    return {i: "-".join(of) for i, of in kept.items()}


def _whole(head: Head) -> str:
    """Name of a column, with what looks like a unit and is neither of time nor of pressure."""
    unit = find(head.unit)
    other = unit is not None and factor(head.unit, "Pa") is None and factor(head.unit, "s") is None
    return f"{head.name} {head.unit}" if other else head.name


def _number(key: str) -> int | None:
    return int(key) if key.isdigit() else None


def _picked(
    table: CsvTable, heads: Sequence[Head], keys: dict[int, str], candidates: list[int],
    chambers: Sequence[str],
) -> tuple[list[int], list[str]]:  # fmt: skip
    """Columns of the chambers in their order, and notes."""
    names = [keys[i] for i in candidates]
    named = [key for key in chambers if key in names]
    for key in named or [n for n in names if n.isdigit()]:
        if names.count(key) > 1:
            twice = [table.heads[i] for i in candidates if keys[i] == key]
            raise ValueError(f"{table.where}: {' and '.join(twice)} name the same chamber; choose "
                             "with columns = [...], or --columns")  # fmt: skip
    if named and len(named) < len(chambers):
        raise ValueError(
            f"{table.where}: columns must be {', '.join(chambers)}; got "
            f"{', '.join(heads[i].name for i in candidates)}"
        )
    if named:
        return [candidates[names.index(key)] for key in chambers], []
    for order in (_by_number(names), _by_letter(names)):
        if order and (len(order) == len(candidates) or len(order) in (len(chambers), 3)):
            return [candidates[at] for at in order], []
    if not chambers or len(candidates) == len(chambers):
        notes = []
        if chambers and any(name != names[0] for name in names):
            pairs = zip(chambers, candidates, strict=True)
            said = ", ".join(f"{table.heads[i]!r} is {chamber}" for chamber, i in pairs)
            notes.append(f"columns in the order of the file: {said}")
        return candidates, notes
    if len(candidates) < len(chambers):
        return candidates, []  # as many as the gait is for, which the scene compares
    raise ValueError(
        f"{table.where}: {len(candidates)} columns may be the {len(chambers)} chambers: "
        f"{', '.join(table.heads[i] for i in candidates)}; choose with columns = [...], or "
        "--columns"
    )


def _by_number(names: Sequence[str]) -> list[int]:
    """Places of names that are numbers, if they follow each other, by number."""
    numbers = {int(name): at for at, name in enumerate(names) if name.isdigit()}
    ordered = sorted(numbers)
    follow = ordered == list(range(ordered[0], ordered[0] + len(ordered))) if ordered else False
    return [numbers[number] for number in ordered] if follow else []


def _by_letter(names: Sequence[str]) -> list[int]:
    """Places of names that are the first letters of the alphabet, by letter."""
    letters = sorted(names)
    first = [chr(ord("a") + number) for number in range(len(names))]
    return [names.index(letter) for letter in letters] if letters == first else []
