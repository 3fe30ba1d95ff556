"""Interval of the predicted distance for all that is not known of a scene, and what causes it.

Where the distance has a derivative by all fields, and is as straight as it says at the two ends of
what the fields may be, it is taken for straight. Else the reference walks at values drawn by a
Latin hypercube (McKay and others 1979), with half its links and states: the change from the scene's
own value is what counts. A quadratic of the
coordinates is fitted to the walks, each also predicted without itself (PRESS, Allen 1974), and the
interval is that of many draws of the quadratic and of those errors. What a field causes alone is
the part of the variance that the quadratic's terms of it alone have: its first-order Sobol index
(Saltelli and others 2008).
"""

import contextlib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from analytic.locomotion import direction
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.fitting.parameters import with_values
from mjsim.results.prediction import HALF, displacement, prediction, reference
from mjsim.scene import Numerics
from mjsim.uncertainty.fields import Spread, by_spread, values_at

Array = NDArray[np.float64]
Distance = Callable[[Tables], float]

DERIVATIVE, SAMPLE = "derivative", "sample"
_LENGTH = "robot.length"
_LEAST, _A_TERM = 24, 3  # walks, and walks for each term of the quadratic; chosen
_DRAWS = 20_000
_TAILS = (0.025, 0.975)
_BENT = 0.05  # of its change to the ends, that a straight distance may miss there; chosen
_ROUNDING = 1e-7  # of L: spreads of distances that are none; chosen
_LEVER = 1e-3  # least part of a walk that the others leave open


@dataclass(frozen=True)
class Interval:
    """Interval of the distance per cycle over L.

    Attributes:
        low, high: which it is in with 95 %; NaN where no walk has a distance.
        parts: of the variance, by the name of each spread alone.
        together: part of the variance by several spreads at a time, and by jumps.
        directions: part of the walks that go forward, none or backward.
        walks: how many were walked.
        failed: how many of them have no distance.
        how: DERIVATIVE or SAMPLE.
    """

    low: float
    high: float
    parts: Mapping[str, float]
    together: float
    directions: Mapping[str, float]
    walks: int
    failed: int
    how: str


def by_reference(tables: Tables, numerics: Numerics | None = None) -> float:
    """Distance over L of a scene by the reference at half its links and states."""
    scene, stated = build(tables)
    return float(reference(scene, numerics or stated, HALF).displacement[0])


def walks_for(spreads: Sequence[Spread]) -> int:
    """Number of walks that are drawn."""
    return max(_LEAST, _A_TERM * _terms(np.zeros((1, _axes(spreads)))).shape[1])


def distance_interval(
    base: Tables,
    spreads: Sequence[Spread],
    distance: Distance | None = None,
    centre: float | None = None,
    seed: int = 0,
    advance: Callable[[int], object] = lambda _: None,
) -> Interval:
    """Interval of the distance of a scene of which fields are not known.

    Args:
        base: tables of the scene.
        spreads: what is not known of it.
        distance: of a scene's tables over L; by_reference if not given.
        centre: distance over L of the scene itself, by finer links and states; as `distance` has it
            if not given.
        seed: of the draws.
        advance: called with 1 after each walk.

    Raises:
        ValueError: valves are not ideal: the pressures that they let through are not those that the
            reference follows.
    """
    if not build(base)[0].valves.ideal:
        raise ValueError("uncertain is for ideal valves, got valves that take time to fill")
    if distance is None:
        straight = _straight(base, spreads, centre)
        if straight is not None:
            advance(walks_for(spreads))
            return straight
    distance = distance or by_reference
    chance = qmc.LatinHypercube(_axes(spreads), rng=np.random.default_rng(seed))
    places = _coordinates(spreads, chance.random(walks_for(spreads)))
    base_distance = distance(base) if centre is not None else 0.0
    walked = np.full(len(places), math.nan)
    for number, place in enumerate(places):
        with contextlib.suppress(ValueError):  # such a robot does not walk the gait
            walked[number] = distance(with_values(base, values_at(spreads, place)))
        advance(1)
    return interval_of(spreads, places, walked + ((centre or 0.0) - base_distance))


def _straight(base: Tables, spreads: Sequence[Spread], centre: float | None) -> Interval | None:
    """Interval by derivatives, None where there are none or the distance is not straight."""
    scene, numerics = build(base)
    names = [name for spread in spreads for name in spread.names]
    if scene.in_space or not all(spread.of_robot_and_ground for spread in spreads):
        return None
    try:
        walk = prediction(scene, gradient=names)
    except ValueError:  # a field that was turned into another one
        return None
    shift, length = displacement(scene, walk), scene.strip.length
    by_field = {name: float(walk.gradient[name].value) / length for name in names}
    if _LENGTH in by_field:
        by_field[_LENGTH] -= shift / length
    slopes = np.concatenate([spread.slopes(by_field) for spread in spreads])
    if not np.isfinite(slopes).all():
        return None
    ends = np.concatenate([np.full(spread.axes, spread.end) for spread in spreads])
    worst = np.where(slopes < 0, -ends, ends)
    try:
        away = [by_reference(with_values(base, values_at(spreads, place)), numerics)
                for place in (worst, 0.0 * worst, -worst)]  # fmt: skip
    except ValueError:
        return None
    reach = float(slopes @ worst)
    errors = np.array([away[0] - away[1] - reach, 0.0, away[2] - away[1] + reach])
    if not np.abs(errors).max() <= max(_BENT * reach, _ROUNDING):
        return None
    coefficients = np.concatenate([[shift if centre is None else centre], slopes])
    return _interval(spreads, coefficients, errors, None, 4, 0)


def interval_of(spreads: Sequence[Spread], places: Array, walked: Array) -> Interval:
    """Interval by walks at places.

    Args:
        spreads: what is not known.
        places: coordinates, (N, axes of all).
        walked: distances over L, NaN where there is none, (N,).
    """
    finite = np.isfinite(walked)
    failed = int((~finite).sum())
    if finite.sum() < 2:
        return Interval(math.nan, math.nan, {}, math.nan, {}, len(walked), failed, SAMPLE)
    values = walked[finite]
    terms = _terms(places[finite])
    inverse = np.linalg.pinv(terms)
    coefficients = inverse @ values
    lever = np.einsum("nt,tn->n", terms, inverse)
    errors = (values - terms @ coefficients) / np.maximum(1.0 - lever, _LEVER)
    return _interval(spreads, coefficients, errors, values, len(walked), failed)


def _interval(
    spreads: Sequence[Spread], coefficients: Array, errors: Array, walked: Array | None,
    walks: int, failed: int,
) -> Interval:  # fmt: skip
    """Interval of many draws.

    Args:
        spreads: what is not known.
        coefficients: of the first terms.
        errors: of what they say of walks, to draw from.
        walked: distances of walks, which tell the directions; the draws do if None.
        walks, failed: see Interval.
    """
    rng = np.random.default_rng(0)
    drawn = _coordinates(spreads, rng.random((_DRAWS, _axes(spreads))))
    count = len(coefficients)
    total = _terms(drawn)[:, :count] @ coefficients + rng.choice(errors, _DRAWS)
    low, high = np.quantile(total, _TAILS)
    variance = float(total.var())
    if variance < _ROUNDING**2:
        variance = 0.0
    parts = {}
    for number, spread in enumerate(spreads):
        masked = [part * (i == number) for i, part in enumerate(by_spread(spreads, drawn))]
        alone = float((_terms(np.hstack(masked))[:, :count] @ coefficients).var())
        parts[spread.name] = min(alone / variance, 1.0) if variance else 0.0
    ways = [direction(value, 1.0) for value in (total if walked is None else walked).tolist()]
    return Interval(
        float(low), float(high), parts, max(0.0, 1.0 - sum(parts.values())) if variance else 0.0,
        {way: ways.count(way) / len(ways) for way in ("forward", "none", "backward")},
        walks, failed, DERIVATIVE if walked is None else SAMPLE,
    )  # fmt: skip


def _axes(spreads: Sequence[Spread]) -> int:
    return sum(spread.axes for spread in spreads)


def _coordinates(spreads: Sequence[Spread], chance: Array) -> Array:
    """Coordinates (N, axes of all) of numbers spread evenly from 0 to 1."""
    parts = zip(spreads, by_spread(spreads, chance), strict=True)
    return np.hstack([spread.coordinates(part) for spread, part in parts])


def _terms(places: Array) -> Array:
    """1, t, t^2 and products of two, of coordinates (N, D)."""
    products = [places[:, i] * places[:, j] for i, j in combinations(range(places.shape[1]), 2)]
    return np.column_stack([np.ones((len(places), 1)), places, places**2, *products])
