"""Measurements to decide on GeckoBot's actuators: `python -m zoo.geckobot_actuators.decide`.

A power law c (p - p_0)^n goes through the four published points of each of the six. How they differ
is what is known of a seventh before it is measured; points at some angles, each to 2 degrees,
narrow it, by the information matrix.
"""

from collections.abc import Sequence

import numpy as np
from scipy.optimize import least_squares

from studies import Array
from studies.muscles import one_robot
from zoo.deciding import errors, narrowed

ERROR = 2.0  # degrees, of a point; chosen
ANGLES = np.arange(5.0, 95.0, 5.0)  # degrees, whose mean error counts
PLANS = ((), (90,), (60, 90), (30, 60, 90), (10, 30, 60, 90), (10, 20, 30, 60, 90),
         (45, 30, 60, 90), (75, 30, 60, 90))  # fmt: skip
_FLAT = 1e-3  # kPa over the start, below which a slope is none


def bend(numbers: Array, pressure: Array) -> Array:
    """Angle [deg] by p_0 [kPa], log c and n at pressures [kPa]."""
    start, size, power = numbers
    return np.asarray(np.exp(size) * np.maximum(pressure - start, 0.0) ** power)


def through(pressure: Array, angle: Array) -> Array:
    """Numbers of the law that goes through the points of one actuator, (3,)."""
    start = 0.5 * pressure[1]
    first = np.array([start, np.log(angle[-1] / (pressure[-1] - start)), 1.0])
    least = least_squares(lambda n: bend(n, pressure[1:]) - angle[1:], first,
                          bounds=([0, -20, 0.2], [pressure[1] - _FLAT, 10, 6]))  # fmt: skip
    return np.asarray(least.x)


def slopes(numbers: Array, pressure: Array) -> Array:
    """Slopes of angles by the numbers, (K, 3)."""
    start, size, power = numbers
    over = np.maximum(pressure - start, _FLAT)
    angle = np.exp(size) * over**power
    return np.stack([-power * angle / over, angle, angle * np.log(over)], axis=1)


def left(angles: Sequence[float], numbers: Array, covariance: Array) -> Array:
    """Standard errors of the angles of ANGLES with points measured at some, (K,) [deg]."""

    def at(some: Array) -> Array:
        start, size, power = numbers
        return slopes(numbers, np.asarray(start + (some / np.exp(size)) ** (1 / power)))

    for slope in at(np.array(angles, dtype=float)):
        covariance = narrowed(covariance, slope, ERROR)
    return errors(covariance, at(ANGLES))


def main() -> None:
    """Print a row per plan."""
    _, pressures, angle = one_robot()
    parameters = np.array([through(p, angle) for p in pressures])
    covariance, middle = np.cov(parameters, rowvar=False), parameters.mean(axis=0)
    print(
        "p_0 [kPa], c, n of the six:",
        *(f"{a:.1f} {np.exp(b):.2g} {c:.2f};" for a, b, c in parameters),
    )
    print("| points at [deg] | mean error | at 30 | at 60 |")
    print("|---|---|---|---|")
    for plan in PLANS:
        error = left(plan, middle, covariance)
        at = (error[np.argmin(np.abs(ANGLES - one))] for one in (30, 60))
        print(f"| {', '.join(map(str, plan)) or 'none'} | {np.sqrt(np.mean(error**2)):.1f} deg | "
              + " | ".join(f"{x:.1f}" for x in at) + " |")  # fmt: skip


if __name__ == "__main__":
    main()
