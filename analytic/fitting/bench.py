"""Pressure and bend of an actuator, as a bench measured them."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_CLOSE, _APART, _GROWS = 0.01, 0.15, 0.05  # see check_function; chosen
_NOISES = 4.0  # times the median second difference: 6.6 standard deviations of independent noise
_FEW = 8  # samples whose differences do not tell of noise


class Bench(NamedTuple):
    """Readings of a bench, in order of time.

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

    It is none where, by more than its noise, the bend changes by 15 % of its range while the
    pressure stays within 1 % of its own, or grows by 5 % after the highest pressure: an actuator
    that balloons, or one that slips in its clamp.

    Raises:
        ValueError: it is none; the message names the pressure.
    """
    p, bend = bench.pressure, np.abs(bench.bend)
    span, reach, top = float(np.ptp(p)), float(np.ptp(bend)), int(np.argmax(p))
    if not (span and reach):
        raise ValueError(f"{bench.name}: pressure and bend must change, got {p[0]:g} Pa alone")
    noise = float(np.median(np.abs(np.diff(bend, 2)))) if len(bend) > _FEW else 0.0
    later = top + int(np.argmax(bend[top:]))
    if bend[later] - bend[top] > max(_GROWS * reach, _NOISES * noise) and p[later] < p[top]:
        raise ValueError(_no_function(bench, p[top], p[later], bend[top], bend[later]))
    for rows in (slice(top + 1), slice(top, None)):
        order = np.argsort(p[rows], kind="stable")
        q, b = p[rows][order], bend[rows][order]
        ends = np.searchsorted(q, q + _CLOSE * span, side="right")
        for first, end in enumerate(ends.tolist()):
            low, high = (
                first + int(part) for part in (b[first:end].argmin(), b[first:end].argmax())
            )
            if b[high] - b[low] > max(_APART * reach, _NOISES * noise):
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
