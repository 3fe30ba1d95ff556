"""Values with a unit, `7 psi`, `90 mm`, `2.5 kgf/cm2`, in SI.

Units are products and quotients of the table's, with SI prefixes where these are usual: `kgf/cm2`,
`mN m^2/kPa`. Upper and lower case are told apart only where that makes a difference, as in mPa and
MPa. Pressures are over the ambient one: psig, barg and `kPa gauge` are psi, bar and kPa.
"""

import math
import re
from collections.abc import Iterator
from difflib import get_close_matches
from functools import cache
from typing import NamedTuple

_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_LARGEST = 60  # letters of a value; longer ones are no quantity

_PREFIXES = {"n": 1e-9, "u": 1e-6, "m": 1e-3, "c": 1e-2, "d": 0.1, "h": 100.0, "k": 1e3, "M": 1e6,
             "G": 1e9}  # fmt: skip
_SPELLED = {"nano": "n", "micro": "u", "milli": "m", "centi": "c", "deci": "d", "hecto": "h",
            "kilo": "k", "mega": "M", "giga": "G"}  # fmt: skip
_LENGTH, _MASS, _TIME, _NONE = (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)
_FORCE, _PRESSURE, _ENERGY = (1, 1, -2), (-1, 1, -2), (2, 1, -2)


class Unit(NamedTuple):
    """Size of a unit in SI, and its powers of m, kg and s."""

    size: float
    powers: tuple[int, ...]


# symbol, names, size in SI, powers of m, kg and s, usual prefixes; sizes of NIST SP 811, B.8
_UNITS: tuple[tuple[str, str, float, tuple[int, ...], str], ...] = (
    ("m", "meter metre", 1.0, _LENGTH, "n u m c d k"),
    ("in", "inch inches", 0.0254, _LENGTH, ""),
    ("ft", "foot feet", 0.3048, _LENGTH, ""),
    ("mil", "thou", 2.54e-5, _LENGTH, ""),
    ("g", "gram gramme", 1e-3, _MASS, "u m k"),
    ("lb", "pound", 0.45359237, _MASS, ""),
    ("oz", "ounce", 0.028349523125, _MASS, ""),
    ("s", "sec second", 1.0, _TIME, "n u m"),
    ("msec", "", 1e-3, _TIME, ""),
    ("usec", "", 1e-6, _TIME, ""),
    ("min", "minute", 60.0, _TIME, ""),
    ("h", "hr hour", 3600.0, _TIME, ""),
    ("Hz", "hertz", 1.0, (0, 0, -1), "m k M"),
    ("N", "newton", 1.0, _FORCE, "u m c k M"),
    ("gf", "gram-force", 9.80665e-3, _FORCE, "m"),
    ("kgf", "kp kilopond", 9.80665, _FORCE, ""),
    ("lbf", "", 4.4482216152605, _FORCE, ""),
    ("Pa", "pascal", 1.0, _PRESSURE, "u m h k M G"),
    ("bar", "", 1e5, _PRESSURE, "u m"),
    ("psi", "", 6894.757293168, _PRESSURE, ""),
    ("ksi", "", 6894757.293168, _PRESSURE, ""),
    ("atm", "atmosphere", 101325.0, _PRESSURE, ""),
    ("torr", "", 101325.0 / 760, _PRESSURE, ""),
    ("mmHg", "", 133.322387415, _PRESSURE, ""),
    ("inHg", "", 3386.38864, _PRESSURE, ""),
    ("cmH2O", "", 98.0665, _PRESSURE, ""),
    ("mmH2O", "", 9.80665, _PRESSURE, ""),
    ("inH2O", "", 249.08891, _PRESSURE, ""),
    ("J", "joule", 1.0, _ENERGY, "u m k"),
    ("W", "watt", 1.0, (2, 1, -3), "m k"),
    ("l", "liter litre", 1e-3, (3, 0, 0), "u m"),
    ("rad", "radian", 1.0, _NONE, "m u"),
    ("deg", "degree °", math.pi / 180, _NONE, ""),
    ("%", "percent", 1e-2, _NONE, ""),
    ("1", "", 1.0, _NONE, ""),
)

_TOKEN = re.compile(r"\s*(?:(?P<open>\()|(?P<close>\))|(?P<over>/|\bper\b)|(?P<times>\*(?!\*)|·|⋅)|"
                    r"(?P<unit>1(?![\d.])|%|°|(?:mm|cm|in)H2O|[A-Za-z]+(?:-force)?)"
                    r"(?P<power>(?:\^|\*\*)?[-+]?\d+|[²³])?)")  # fmt: skip
_REFERENCE = re.compile(
    r"(?i)(?P<unit>.*?(?:pa|bar|psi|torr|hg|atm|cm2|cm\^2|cm²))"
    r"[\s_,]*\(?(?P<word>g|gauge|gage|a|abs|absolute)\)?"
)


def in_unit(name: str, value: str, unit: str | None) -> float:
    """Convert a number, or a number with a unit, to another unit.

    Args:
        name: of the value, for the message.
        value: text.
        unit: of the result; None or "1" for a plain number, which may be in %.

    Raises:
        ValueError: it is no number, or one with a unit of another kind or an unknown one.
    """
    try:
        return float(value)
    except ValueError:
        pass
    number, unit_words = split_number(value)
    if number is None:
        raise ValueError(refusal(name, value, unit))
    words, absolute = split_reference(unit_words)
    size = factor(words, unit)
    if size is None:
        raise ValueError(refusal(name, value, unit))
    if absolute:
        raise ValueError(f"{name} must be a pressure over the ambient one, got {value!r}: absolute")
    return number * size


def split_number(value: str) -> tuple[float | None, str]:
    """Number at the beginning of a text, None if it is no quantity, and the words after it."""
    number = _NUMBER.match(value)
    if number is None or len(value) > _LARGEST:
        return None, ""
    return float(number.group()), value[number.end() :].strip()


def factor(words: str, unit: str | None) -> float | None:
    """Factor from a unit to another; None if it is unknown or of another kind."""
    given, target = find(words), find("1" if unit in (None, "") else str(unit))
    if given is None or target is None or given.powers != target.powers:
        return None
    return given.size / target.size


@cache
def find(words: str) -> Unit | None:
    """The unit of a text, such as `kgf/cm2`; None if it is none."""
    tokens = []
    at = 0
    text = words.strip().replace("µ", "u").replace("μ", "u")
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None or match.end() == at:
            return None
        tokens.append(match)
        at = match.end()
    try:
        return _product(iter(tokens), inside=False) if tokens else None
    except (ValueError, OverflowError):
        return None


def split_reference(words: str) -> tuple[str, bool | None]:
    """Unit of a pressure without the word that says over what, and whether it is absolute."""
    match = _REFERENCE.fullmatch(words.strip())
    unit = find(match["unit"]) if match else None
    if match is None or unit is None or unit.powers != _PRESSURE:
        return words.strip(), None
    return match["unit"].strip(), match["word"].lower().startswith("a")


def refusal(name: str, value: str, unit: str | None) -> str:
    """Message about a value that is none of a unit, with the unit that may have been meant."""
    plain = unit in (None, "", "1")
    kind = "a number" if plain else f"a number of {unit}, or one with its unit"
    number = _NUMBER.match(value)
    near = [] if number is None or plain else meant(value[number.end() :], str(unit))
    ending = f"; did you mean {' or '.join(near)}?" if near else ""
    return f"{name} must be {kind}, got {value!r}{ending}"


def meant(words: str, unit: str) -> list[str]:
    """Names of units of a kind, like a word that is none."""
    target = find(unit)
    if find(words) is not None or target is None:
        return []
    names = {name: name.lower() for name, kind in _named().items() if kind.powers == target.powers}
    near = get_close_matches(words.strip().lower(), names.values(), 1, 0.75)
    return [name for name, lower in names.items() if lower in near]


def _product(tokens: Iterator[re.Match[str]], inside: bool) -> Unit:
    """Product of tokens up to the end, or the bracket that closes.

    Raises:
        ValueError: a word is no unit, or brackets or strokes stand where they cannot.
    """
    size, powers, sign = 1.0, [0, 0, 0], 1
    for token in tokens:
        if token["close"]:
            if not inside:
                raise ValueError
            return Unit(size, tuple(powers))
        if token["over"]:
            sign = -1
            continue
        if token["times"]:
            continue
        unit = _product(tokens, inside=True) if token["open"] else _unit(token)
        size *= unit.size**sign
        powers = [power + sign * more for power, more in zip(powers, unit.powers, strict=True)]
        sign = 1
    if inside or sign < 0:
        raise ValueError
    return Unit(size, tuple(powers))


def _unit(token: re.Match[str]) -> Unit:
    word = token["unit"]
    unit = _named().get(word) or _any_case().get(word.lower())
    if unit is None:
        raise ValueError
    power = {"²": 2, "³": 3, None: 1}.get(token["power"])
    if power is None:
        power = int(token["power"].lstrip("^*"))
    return Unit(unit.size**power, tuple(power * one for one in unit.powers))


@cache
def _named() -> dict[str, Unit]:
    """Every unit by its symbol and names, with their prefixes."""
    units: dict[str, Unit] = {}
    for symbol, names, size, powers, prefixes in _UNITS:
        plain = [word + end for word in names.split() for end in (("", "s") if word.isalpha() and
                 not word.endswith("s") and len(word) > 2 else ("",))]  # fmt: skip
        for word in (symbol, *plain):
            units[word] = Unit(size, powers)
        for prefix in prefixes.split():
            units[prefix + symbol] = Unit(_PREFIXES[prefix] * size, powers)
        for spelled, prefix in _SPELLED.items():
            if prefix in prefixes.split():
                for word in plain:
                    units[spelled + word] = Unit(_PREFIXES[prefix] * size, powers)
    return units


@cache
def _any_case() -> dict[str, Unit]:
    """Units by their names in lower case, without those of which case tells the size."""
    sizes: dict[str, set[Unit]] = {}
    for name, unit in _named().items():
        sizes.setdefault(name.lower(), set()).add(unit)
    return {name: units.pop() for name, units in sizes.items() if len(units) == 1}
