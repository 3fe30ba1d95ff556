"""Ground that changes along x: one surface after the other."""

import math
from bisect import bisect_right
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.checks import file_word, is_number
from analytic.scene.surface import RESISTANCES, Ground, Surface

_SAMPLES = 16  # of a field along a side contact; chosen
_INSTANT = 1e-12  # s; a shortest increment


@dataclass(frozen=True)
class Patches:
    """Surfaces beside each other, the robot's left end beginning at x = 0.

    Args:
        name: how files and tables call it.
        borders: where one ends and the next begins, ascending [m].
        surfaces: one more than borders, left first.

    Raises:
        ValueError: there is no border, borders do not ascend, or the numbers do not match.
    """

    name: str
    borders: tuple[float, ...]
    surfaces: tuple[Surface, ...]

    def __post_init__(self) -> None:
        file_word("name of a ground", self.name)
        object.__setattr__(self, "borders", tuple(self.borders))
        object.__setattr__(self, "surfaces", tuple(self.surfaces))
        if not self.borders:
            raise ValueError("patches must have at least one border between them, got none")
        for border in self.borders:
            if not is_number(border):
                raise ValueError(f"borders of patches must be finite numbers [m], got {border!r}")
        if any(after <= before for before, after in pairwise(self.borders)):
            raise ValueError(f"borders of patches must ascend, got {self.borders!r}")
        if len(self.surfaces) != len(self.borders) + 1:
            raise ValueError(
                f"{len(self.borders)} borders need {len(self.borders) + 1} surfaces, "
                f"got {len(self.surfaces)}"
            )

    def at(self, x: float) -> Surface:
        """The surface at a place [m]; at a border the right one."""
        return self.surfaces[bisect_right(self.borders, x)]

    def extents(self) -> list[tuple[float, float, Surface]]:
        """Places where each surface begins and ends, the outer ones at infinity [m]."""
        places = (-math.inf, *self.borders, math.inf)
        return list(zip(places[:-1], places[1:], self.surfaces, strict=True))


def surfaces_of(ground: Ground) -> tuple[Surface, ...]:
    """Every surface that can occur on a ground.

    Raises:
        ValueError: the ground does not list them.
    """
    surfaces = tuple(getattr(ground, "surfaces", ()))
    if not surfaces:
        raise ValueError(
            f"ground {ground.name!r} must list as `surfaces` every surface that its `at` can give"
        )
    return surfaces


def uniform(ground: Ground) -> Surface:
    """The surface of a uniform ground.

    Raises:
        ValueError: the ground changes along x.
    """
    if not isinstance(ground, Surface):
        raise ValueError(f"the ground must be one surface everywhere, got {ground.name!r}")
    return ground


def depends_on_speed(ground: Ground) -> bool:
    """Tell whether a ground resists anywhere by how fast it is slid over."""
    return any(surface.depends_on_speed for surface in surfaces_of(ground))


def is_round(ground: Ground) -> bool:
    """Tell whether a ground resists everywhere alike in all directions."""
    return all(surface.is_round for surface in surfaces_of(ground))


def check_round(ground: Ground, what: str) -> None:
    """Raise ValueError for ground that resists otherwise back or across than ahead.

    Args:
        ground: what is asked.
        what: needs it to be alike in all directions.
    """
    for surface in surfaces_of(ground):
        if not surface.is_round:
            raise ValueError(
                f"{what} is for friction that is alike in all directions, surface "
                f"{surface.name!r} resists otherwise back or across than ahead"
            )


def durations(times: ArrayLike) -> NDArray[np.float64]:
    """Durations of the increments between times (B,) [s], (B - 1,) [s]; at least an instant.

    Viscous ground gives way to nothing in no time.
    """
    return np.maximum(np.diff(np.asarray(times, dtype=float)), _INSTANT)


def check_adhesion(ground: Ground) -> None:
    """Raise ValueError for ground that changes along x and is adhesive anywhere."""
    adhesive = any(surface.adhesion for surface in surfaces_of(ground))
    if adhesive and not isinstance(ground, Surface):
        raise ValueError(f"adhesion must be of uniform ground, got {ground.name!r}")


class Incline(NamedTuple):
    """Ground that rises.

    Attributes:
        slope: its angle [rad].
        uphill: direction in which it rises, from +x to the left [rad].
    """

    slope: float = 0.0
    uphill: float = 0.0

    @property
    def normal(self) -> float:
        """Part of a weight that presses on the ground."""
        return math.cos(self.slope)

    @property
    def downhill(self) -> tuple[float, float]:
        """Part of a weight that pulls along the ground, in plan."""
        part = -math.sin(self.slope)
        return part * math.cos(self.uphill), part * math.sin(self.uphill)


LEVEL = Incline()


def check_for_limbs(ground: Ground) -> None:
    """Raise ValueError for ground that limbs are not told of: a film under a nap."""
    for surface in surfaces_of(ground):
        if surface.viscosity and not surface.is_round:
            raise ValueError(
                f"viscosity of surface {surface.name!r}, which resists otherwise back or across "
                f"than ahead, is for strips, not for robots of limbs; got {surface.viscosity!r}"
            )


def over(ground: Ground, begin: float, end: float) -> Surface:
    """Surface under a side contact between two places: the mean of the ground's properties.

    Bounds and viscous resistance are linear in them, so that theirs is the sum over the stretch.
    """
    if isinstance(ground, Surface) or end <= begin:
        return ground.at(begin)
    if isinstance(ground, Patches):
        inner = [border for border in ground.borders if begin < border < end]
        edges = [begin, *inner, end]
    else:
        edges = [begin + (end - begin) * i / _SAMPLES for i in range(_SAMPLES + 1)]
    if len(edges) == 2:
        return ground.at(begin)
    pieces = [(ground.at(0.5 * (a + b)), (b - a) / (end - begin)) for a, b in pairwise(edges)]
    means: dict[str, Any] = {}
    for name in RESISTANCES:
        if all(getattr(surface, name) is None for surface, _ in pieces):
            continue
        values = [surface.resistance(name) for surface, _ in pieces]
        parts = zip(values, (part for _, part in pieces), strict=True)
        means[name] = values[0] if len(set(values)) == 1 else sum(v * part for v, part in parts)
    return replace(ground.at(0.5 * (begin + end)), **means)
