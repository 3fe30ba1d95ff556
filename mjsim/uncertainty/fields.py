"""Fields of a scene that are not known, and how their values are spread."""

import itertools
import json
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from analytic.checks import missing
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.files.units import in_unit
from mjsim.fitting.parameters import OWN_GROUND, check_free, unit_of, value_of, with_values

Array = NDArray[np.float64]

MOST_AXES = 3  # of corners: eight; chosen
_MOST = 0.9  # of a value, by which it may be off; chosen
_EXAMPLE = "such as surface.tip_force=20%, robot.modulus=10%"
_FIT = ".json"  # of what a fit printed


class Spread(ABC):
    """Values that fields may have, by coordinates.

    Attributes:
        name: of the fields, as tables call it.
        names: of each field, as surface.tip_force.
        axes: number of coordinates.
        end: of a coordinate, either way: 95 % or all of what may be lies between.
    """

    name: str
    names: tuple[str, ...]
    axes: int
    end: float

    @property
    def of_robot_and_ground(self) -> bool:
        """True if all fields are of the robot or of the scene's ground, none of valves."""
        return all(name.partition(".")[0] in ("robot", OWN_GROUND) for name in self.names)

    @property
    @abstractmethod
    def known(self) -> str:
        """Words on how well the fields are known."""

    @abstractmethod
    def coordinates(self, chance: Array) -> Array:
        """Coordinates of numbers that are spread evenly from 0 to 1, (N, axes) each."""

    @abstractmethod
    def at(self, place: Array) -> Mapping[str, float]:
        """Values of the fields in SI at coordinates, (axes,)."""

    @abstractmethod
    def slopes(self, by_field: Mapping[str, float]) -> Array:
        """Slopes of what has these derivatives by fields, along the coordinates, (axes,)."""


@dataclass(frozen=True)
class Within(Spread):
    """Fields that lie within a part of their values, anywhere alike likely.

    Fields of one spread are too large or too small together. Its coordinate is -1 where they are
    lowest, and 1 where they are highest.

    Attributes:
        names: of the fields, as surface.tip_force.
        values: of them in the scene, in SI.
        part: of the values by which they may be off, either way.
    """

    names: tuple[str, ...]
    values: tuple[float, ...]
    part: float
    axes = 1
    end = 1.0

    @property
    def name(self) -> str:  # type: ignore[override]
        """All names, with + between."""
        return "+".join(self.names)

    @property
    def known(self) -> str:
        """Words on how well they are known."""
        return f"{self.name} within {100 * self.part:.3g} %"

    def coordinates(self, chance: Array) -> Array:
        """See Spread."""
        return 2.0 * chance - 1.0

    def at(self, place: Array) -> Mapping[str, float]:
        """See Spread."""
        factor = 1.0 + self.part * float(place[0])
        return {name: factor * value for name, value in zip(self.names, self.values, strict=True)}

    def slopes(self, by_field: Mapping[str, float]) -> Array:
        """See Spread."""
        changes = [value * by_field[name]
                   for name, value in zip(self.names, self.values, strict=True)]  # fmt: skip
        return np.array([self.part * sum(changes)])


@dataclass(frozen=True)
class Fitted(Spread):
    """Parameters of a fit: logarithms spread as its covariance says, independent of others.

    Attributes:
        names: of the parameters.
        values: that were fitted, in SI.
        factor: of the covariance of their logarithms, with its transpose, (P, P).
    """

    names: tuple[str, ...]
    values: tuple[float, ...]
    factor: tuple[tuple[float, ...], ...]
    end = 1.96

    @property
    def axes(self) -> int:  # type: ignore[override]
        """Number of coordinates."""
        return len(self.names)

    @property
    def name(self) -> str:  # type: ignore[override]
        """All names, with a comma between."""
        return "fitted " + ", ".join(self.names)

    @property
    def known(self) -> str:
        """Words on how well they are known."""
        errors = np.linalg.norm(np.array(self.factor), axis=1)
        return ", ".join(f"{name} by a standard error of {100 * error:.3g} %"
                         for name, error in zip(self.names, errors, strict=True))  # fmt: skip

    def coordinates(self, chance: Array) -> Array:
        """See Spread."""
        return np.asarray(ndtri(chance))

    def at(self, place: Array) -> Mapping[str, float]:
        """See Spread."""
        logarithms = np.array(self.factor) @ place
        return dict(zip(self.names, (np.array(self.values) * np.exp(logarithms)).tolist(),
                        strict=True))  # fmt: skip

    def slopes(self, by_field: Mapping[str, float]) -> Array:
        """See Spread."""
        changes = [value * by_field[name]
                   for name, value in zip(self.names, self.values, strict=True)]  # fmt: skip
        return np.array(self.factor).T @ changes


def read_spreads(base: Tables, text: str) -> tuple[Spread, ...]:
    """Spreads from a list such as surface.tip_force=20%, robot.length=1mm, fit.json.

    Args:
        base: tables of the scene.
        text: name=part, or name=size in its unit, with commas between; fields with + between are
            off together; or fit.json, which `undulator fit` wrote.

    Raises:
        ValueError: a name is no field with a number, is there twice, a size is none, or a file is
            not of a fit, or no scene is built with them.
    """
    parts = [part.strip() for part in text.split(",") if part.strip()]
    spreads = [
        _fitted(Path(part)) if part.endswith(_FIT) and "=" not in part else _within(base, part)
        for part in parts
    ]
    if not spreads:
        raise ValueError(f"uncertain must name fields and how far they may be off, {_EXAMPLE}; got "
                         f"{text!r}")  # fmt: skip
    names = [name for spread in spreads for name in spread.names]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"uncertain must name each field once, got {name} twice")
    build(with_values(base, values_at(spreads, np.zeros(sum(spread.axes for spread in spreads)))))
    return tuple(spreads)


def _within(base: Tables, text: str) -> Within:
    left, sign, size = text.partition("=")
    if not sign:
        raise ValueError(f"uncertain must be name=size, {_EXAMPLE}, or a .json file of a fit; got "
                         f"{text!r}")  # fmt: skip
    names = tuple(name.strip() for name in left.split("+"))
    for name in names:
        check_free(name, "uncertain")
    values = tuple(_value(base, name) for name in names)
    size = size.strip()
    if size.endswith("%"):
        part = in_unit("uncertain", size[:-1], "1") / 100.0
    elif len(names) > 1:
        raise ValueError(f"uncertain must be in % of fields that are off together, got {size!r}")
    elif not values[0]:
        raise ValueError(f"uncertain {names[0]} is 0 in the scene and cannot be off by {size}")
    else:
        part = in_unit(f"uncertain {names[0]}", size, unit_of(names[0])) / values[0]
    if not 0 < part <= _MOST:
        raise ValueError(f"uncertain {left.strip()} must be above 0 and at most {100 * _MOST:g} % "
                         f"of its value, got {size!r}")  # fmt: skip
    return Within(names, values, part)


def _value(base: Tables, name: str) -> float:
    value = value_of(base, name)
    if value is None:
        raise ValueError(f"uncertain {name}: the scene gives it no value that could be off")
    return value


def _fitted(path: Path) -> Fitted:
    try:
        content = json.loads(path.read_text("utf-8"))
        rows, correlation = content["parameters"], np.array(content["correlation"], dtype=float)
        names = tuple(str(row["name"]) for row in rows)
        errors = [row["relative_error"] for row in rows]
        values = tuple(float(row["value"]) for row in rows)
        reasons = "".join(f"; {note}" for note in content.get("notes", ()))
    except OSError as error:
        raise ValueError(f"uncertain {str(path)!r}: {missing(path, error)}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(
            f"uncertain {str(path)!r} must be fit.json as undulator fit writes it"
        ) from error
    open_ended = [name for name, error in zip(names, errors, strict=True) if error is None]
    if open_ended:
        raise ValueError(f"uncertain {str(path)!r}: the fit gives no interval of "
                         f"{', '.join(open_ended)}{reasons}")  # fmt: skip
    lengths, directions = np.linalg.eigh(correlation * np.outer(errors, errors))
    factor = directions * np.sqrt(np.maximum(lengths, 0.0))
    return Fitted(names, values, tuple(map(tuple, factor.tolist())))


def corners(spreads: Sequence[Spread]) -> list[dict[str, float]]:
    """Values of all fields where every coordinate is at one of its ends.

    Raises:
        ValueError: there are more than MOST_AXES coordinates.
    """
    ends = [spread.end for spread in spreads for _ in range(spread.axes)]
    if len(ends) > MOST_AXES:
        raise ValueError(f"uncertain must be at most {MOST_AXES} fields where the worst case "
                         f"counts, got {len(ends)}; fields with + between are one")  # fmt: skip
    signs = itertools.product((-1.0, 1.0), repeat=len(ends))
    return [values_at(spreads, np.multiply(sign, ends)) for sign in signs]


def values_at(spreads: Sequence[Spread], place: Array) -> dict[str, float]:
    """Values of all fields at the coordinates of their spreads, one after the other."""
    values: dict[str, float] = {}
    for spread, part in zip(spreads, by_spread(spreads, place), strict=True):
        values |= spread.at(part)
    return values


def by_spread(spreads: Sequence[Spread], along: Array) -> list[Array]:
    """Parts of an array along its last axis, one per spread."""
    return np.split(along, np.cumsum([spread.axes for spread in spreads])[:-1], axis=-1)
