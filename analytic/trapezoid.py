"""The family of gaits in which every segment inflates alike, one after the other.

A segment's pressure is a periodic trapezoid: it rises, is held, falls and is held at rest. The
three named gaits belong to it: wave is trapezoid(1/5, 2/5, 1/5), full-wave (1/6, 1/2, 1/6), pulse
(1/4, 1/4, 1/4).
"""

import numpy as np

from analytic.checks import is_number, positive, whole
from analytic.gait import Gait

_ALIKE = 1e-9  # of the cycle: stages so close in time are one


def trapezoid(
    lag: float, duty: float, ramp: float, segments: int = 3, period: float = 10.0
) -> Gait:
    """The gait with these parts of the cycle [1]; it begins as the first segment begins to rise.

    Args:
        lag: from one segment to the next on its right, in (-1, 1); below 0 the wave runs left.
        duty: for which a segment holds more than half the peak pressure, in (0, 1).
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

    corners = np.array([0.0, ramp, duty, duty + ramp])
    starts = lag * np.arange(segments)
    times = np.sort(np.append(((starts[:, None] + corners) % 1.0).ravel(), [0.0, 1.0]))
    times = times[np.append(True, np.diff(times) > _ALIKE)]
    if 1.0 - times[-1] < _ALIKE:
        times[-1] = 1.0
    since = (times[:, None] - starts + 0.5 * _ALIKE) % 1.0
    fractions = np.interp(since, [*corners, 1.0], [0.0, 1.0, 1.0, 0.0, 0.0])
    fractions = np.clip(fractions.round(8), 0.0, 1.0)  # what is left of the rounding of times
    fractions[-1] = fractions[0]
    ramps = period * np.diff(times)
    alike = np.ptp(ramps) < _ALIKE * period
    return Gait(
        f"trapezoid-{lag:.3g}-{duty:.3g}-{ramp:.3g}",
        tuple(map(tuple, fractions.tolist())),
        period / len(ramps) if alike else tuple(ramps.tolist()),
    )
