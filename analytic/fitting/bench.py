"""Pressure and bend of an actuator, as a bench measured them."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_CLOSE, _APART, _GROWS, _NOISES = 0.01, 0.15, 0.05, 6.0  # see check_function; chosen
_FEW = 8  # samples whose differences do not tell of noise


class Bench(NamedTuple):
    """What a bench measured, in order of time.

    Attributes:
        name: of the file, for messages.
        pressure: (n,) [Pa].
        bend: curvature [1/m], or angle [rad], (n,).
        unit: of the bend.
    """

    name: str
    pressure: Array
    bend: Array
    unit: str = "rad"


def check_function(bench: Bench) -> None:
    """Refuse data in which the bend is no function of the pressure on a branch.

    It is none where the bend changes by 15 % of its range while the pressure stays within 1 % of
    its own, or grows by 5 %, and beyond its noise, after the highest pressure: an actuator that
    balloons, or one that slips in its clamp.

    Raises:
        ValueError: it is none; the message names the pressure.
    """
    p, bend = bench.pressure, np.abs(bench.bend)
    span, reach = float(np.ptp(p)), float(np.ptp(bend))
    if not (span and reach):
        raise ValueError(f"{bench.name}: pressure and bend must change, got {p[0]:g} Pa alone")
    top = int(np.argmax(p))
    for rows in (np.arange(top, len(p)), np.arange(top + 1)[::-1]):
        # from the highest pressure on: along time, and back from it
        q, b = p[rows], bend[rows]
        _check_beyond(bench, q, b, span, reach, later=rows[-1] > rows[0])


def _check_beyond(bench: Bench, q: Array, b: Array, span: float, reach: float, later: bool) -> None:
    """Refuse a branch from its highest pressure on, see check_function."""
    if later and len(b) > 1:
        worst = int(np.argmax(b))
        noise = float(np.median(np.abs(np.diff(b)))) if len(b) > _FEW else 0.0
        if b[worst] - b[0] > max(_GROWS * reach, _NOISES * noise) and q[worst] < q[0]:
            raise ValueError(_no_function(bench, q[0], q[worst], b[0], b[worst]))
    order = np.argsort(q, kind="stable")
    q, b = q[order], b[order]
    ends = np.searchsorted(q, q + _CLOSE * span, side="right")
    for i, end in enumerate(ends.tolist()):
        if end - i < 2:
            continue
        part = b[i:end]
        low, high = int(part.argmin()) + i, int(part.argmax()) + i
        if b[high] - b[low] > _APART * reach:
            raise ValueError(_no_function(bench, q[low], q[high], b[low], b[high]))


def _no_function(bench: Bench, p: float, q: float, bend: float, other: float) -> str:
    size, unit = (math.degrees(1), "deg") if bench.unit == "rad" else (1.0, bench.unit)
    return (f"{bench.name}: the bend must be a function of the pressure, but it is "
            f"{size * bend:.4g} {unit} at {1e-3 * p:.4g} kPa and {size * other:.4g} {unit} at "
            f"{1e-3 * q:.4g} kPa; leave out what comes after")  # fmt: skip


def late_start(bench: Bench) -> float:
    """Pressure of the last sample before the bend leaves 0, where it is exactly that [Pa]."""
    first = int(np.argmax(bench.bend != 0))
    return float(bench.pressure[first - 1]) if first else 0.0
