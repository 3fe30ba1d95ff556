"""An interval as plain data, and in words."""

import math
from collections.abc import Callable, Sequence
from typing import Any

from mjsim.files.scene_tables.tables import Tables
from mjsim.uncertainty.fields import Spread
from mjsim.uncertainty.interval import Interval, distance_interval

_NAMED = 0.005  # part of the variance from which on it is told; chosen
_NOTHING = 1e-9  # part of it that is rounding


def described(
    base: Tables,
    spreads: Sequence[Spread],
    centre: float | None,
    advance: Callable[[int], object] = lambda _: None,
) -> dict[str, Any]:
    """Plain data and words of the interval of a scene; see distance_interval."""
    interval = distance_interval(base, spreads, centre=centre, advance=advance)
    return {"known": known(spreads), "text": sentence(interval), **record(interval)}


def record(interval: Interval) -> dict[str, Any]:
    """Plain data; what does not exist is None."""
    there = math.isfinite(interval.low)
    return {
        "low_over_L": interval.low if there else None,
        "high_over_L": interval.high if there else None,
        "parts_of_variance": dict(interval.parts),
        "together": interval.together if there else None,
        "directions": dict(interval.directions),
        "walks": interval.walks,
        "without_distance": interval.failed,
        "by": interval.how,
    }


def known(spreads: Sequence[Spread]) -> str:
    """Line on how well the fields are known."""
    return "Known: " + ", ".join(spread.known for spread in spreads) + "."


def sentence(interval: Interval) -> str:
    """Line on an interval."""
    if not math.isfinite(interval.low):
        return f"none of {interval.walks} walks has a distance"
    words = [f"{interval.low:+.4f} to {interval.high:+.4f} L (95 %)"]
    parts = sorted(interval.parts.items(), key=lambda item: -item[1])
    causes = [f"{name} {100 * part:.0f} %" for name, part in parts if part > _NAMED]
    if interval.together > _NAMED:
        causes.append(f"several together or jumps {100 * interval.together:.0f} %")
    if causes:
        words.append(f"of the variance {', '.join(causes)}")
    idle = [name for name, part in parts if part < _NOTHING]
    if idle:
        words.append(f"{' and '.join(idle)} change{'s' * (len(idle) == 1)} nothing here")
    ways = {way: part for way, part in interval.directions.items() if part}
    if len(ways) > 1:
        words.append(", ".join(f"{way} in {100 * part:.0f} %" for way, part in ways.items()))
    if interval.failed:
        words.append(f"{interval.failed} of {interval.walks} walks have no distance")
    return "; ".join(words)
