"""The family of gaits in which every segment inflates alike, one after the other.

A segment's pressure is a periodic trapezoid: it rises, is constant, falls and is none. The
three named gaits belong to it: wave is trapezoid(1/5, 2/5, 1/5), full-wave (1/6, 1/2, 1/6), pulse
(1/4, 1/4, 1/4).
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from analytic.checks import is_number, positive, whole
from analytic.scene.gait import Gait

Array = NDArray[np.float64]

_ALIKE = 1e-9  # of the cycle: stages so close in time are one


def trapezoid(
    lag: float, duty: float, ramp: float, segments: int = 3, period: float = 10.0
) -> Gait:
    """The gait with these parts of the cycle [1]; it begins as the first segment begins to rise.

    Args:
        lag: from one segment to the next on its right, in (-1, 1); below 0 the wave runs left.
        duty: for which a segment has more than half the peak pressure, in (0, 1).
        ramp: that a rise or a fall takes, at most duty and at most 1 - duty.
        segments: number of segments.
        period: of the cycle [s].

    Raises:
        ValueError: a value is out of its range.
    """
    for name, value in (("lag", lag), ("duty", duty), ("ramp", ramp)):
        if not is_number(value):
            raise ValueError(f"{name} must be a part of the cycle, got {value!r}")
    if not -1 < lag < 1:
        raise ValueError(f"lag must lie between -1 and 1, got {lag!r}")
    if not 0 < duty < 1:
        raise ValueError(f"duty must lie between 0 and 1, got {duty!r}")
    most = min(duty, 1 - duty)
    if not 0 < ramp <= most + _ALIKE:
        raise ValueError(f"ramp must be above 0 and at most {most:g} at a duty of {duty:g}, "
                         f"got {ramp!r}")  # fmt: skip
    whole("segments", segments, 1)
    positive("period", period, "s")

    starts = lag * np.arange(float(segments))
    stages, ramps = _stages(starts, [duty] * segments, [ramp] * segments, [1.0] * segments, period)
    alike = np.ptp(ramps) < _ALIKE * period
    return Gait(
        f"trapezoid-{lag:.3g}-{duty:.3g}-{ramp:.3g}",
        stages,
        period / len(ramps) if alike else tuple(ramps.tolist()),
    )


def staggered(
    starts: Sequence[float],
    duties: Sequence[float],
    ramps: Sequence[float],
    fractions: Sequence[float],
    period: float = 10.0,
    name: str = "staggered",
) -> Gait:
    """A gait in which each segment has a trapezoid of its own; parts of the cycle [1].

    Args:
        starts: when each begins to rise, left segment first, of any size.
        duties, ramps: see trapezoid, one per segment.
        fractions: of the peak pressure at the top of each trapezoid, 0 to 1.
        period: of the cycle [s].
        name: of the gait.

    Raises:
        ValueError: they are not alike many, or a value is out of its range.
    """
    if not len(starts) == len(duties) == len(ramps) == len(fractions) > 0:
        raise ValueError("starts, duties, ramps and fractions must be one per segment")
    for duty, ramp in zip(duties, ramps, strict=True):
        trapezoid(0.0, duty, ramp, 1, period)
    stages, times = _stages(np.asarray(starts, dtype=float), duties, ramps, fractions, period)
    return Gait(name, stages, tuple(times.tolist()))


def _stages(
    starts: Array,
    duties: Sequence[float],
    ramps: Sequence[float],
    fractions: Sequence[float],
    period: float,
) -> tuple[tuple[tuple[float, ...], ...], Array]:
    """Stages where any segment has a corner, and the times between them."""
    shapes = zip(duties, ramps, strict=True)
    corners = np.array([[0.0, ramp, duty, duty + ramp] for duty, ramp in shapes])
    times = np.sort(np.append(((starts[:, None] + corners) % 1.0).ravel(), [0.0, 1.0]))
    times = times[np.append(True, np.diff(times) > _ALIKE)]
    if 1.0 - times[-1] < _ALIKE:
        times[-1] = 1.0
    since = (times[:, None] - starts + 0.5 * _ALIKE) % 1.0
    columns = [
        fraction * np.interp(since[:, i], [*corners[i], 1.0], [0.0, 1.0, 1.0, 0.0, 0.0])
        for i, fraction in enumerate(fractions)
    ]
    stages = np.stack(columns, axis=1)
    stages = np.clip(stages.round(8), 0.0, 1.0)  # without the rounding of times
    stages[-1] = stages[0]
    return tuple(map(tuple, stages.tolist())), period * np.diff(times)
