"""What one more measurement would tell: `python -m zoo.terresoro_iv.decide`.

For each measurement that could be made, with the accuracy that is written beside it: how many
standard errors apart it puts the two minima of the fit, and by how much it narrows the error of the
five gaits' distances within one of them, by the information matrix of the fit. Its covariance is
that of the jackknife, since errors of transitions that share a cause are no chance.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from studies import Array
from zoo.terresoro_iv.best import reach
from zoo.terresoro_iv.model import Numbers, by_friction, cycle, fitted, gaits

_STEP = 0.02  # of differences; wide, since laws have kinks


class Measurement(NamedTuple):
    """A measurement that could be made.

    Attributes:
        name: in words, with its accuracy.
        value: what it would show of a robot of some numbers.
        error: its standard error, in the unit of the value.
    """

    name: str
    value: Callable[[Numbers], float]
    error: float


def reached(states: tuple[str, ...], numbers: Numbers) -> float:
    """Distance after 60 transitions [cm]."""
    return reach(states, by_friction(numbers))


MEASUREMENTS = (
    Measurement("direction of a flat limb's contact, 5 deg", lambda n: n.flat_angle, np.radians(5)),
    Measurement("distance of a flat limb's contact, 0.5 cm", lambda n: n.flat, 0.5),
    Measurement("how far curling moves it outwards, 0.3 cm", lambda n: n.curled - n.flat, 0.3),
    Measurement("friction of a curling over a resting limb, 10 %", lambda n: n.curling, 0.1),
    Measurement("friction of an uncurling over a resting limb, 10 %", lambda n: n.uncurling, 0.1),
    Measurement("friction of a curled over a flat limb, 10 %", lambda n: n.resting, 0.1),
    Measurement("60 transitions of 0011 1001 0110, 1 cm",
                partial(reached, ("0011", "1001", "0110")), 1.0),
    Measurement("60 transitions of 0011 1101 (gait D), 1 cm",
                partial(reached, ("0011", "1101")), 1.0),
)  # fmt: skip


def slopes(function: Callable[[Numbers], Array | float], at: Numbers) -> Array:
    """Central differences by the numbers, (..., 7)."""
    columns = []
    for k in range(len(at)):
        step = _STEP * max(1.0, abs(at[k]) if k in (0, 2) else 1.0) * np.eye(len(at))[k]
        ahead, back = (np.asarray(function(Numbers(*(np.array(at) + sign * step))))
                       for sign in (1, -1))  # fmt: skip
        columns.append((ahead - back) / (2 * step[k]))
    return np.stack(columns, axis=-1)


def covariance(left_out: Array) -> Array:
    """Covariance of the numbers by the jackknife, (7, 7)."""
    folds = len(left_out)
    return np.asarray((folds - 1) ** 2 / folds * np.cov(left_out, rowvar=False))


def distances(numbers: Numbers) -> Array:
    """Distances of the five gaits, (5,) [cm]."""
    law = by_friction(numbers)
    return np.array([cycle(gait.states, law)[0] for gait in gaits()])


def main() -> None:
    """Print a row per measurement."""
    fits = [fitted(0), fitted(1)]
    spreads = [covariance(left_out) for _, left_out in fits]
    gradients = [slopes(distances, numbers) for numbers, _ in fits]
    print("| measurement | lower minimum | other | apart | gaits' error, lower | other |")
    print("|---|---|---|---|---|---|")
    errors = [_error(g, c) for g, c in zip(gradients, spreads, strict=True)]
    print(f"| none | | | | {errors[0]:.3f} cm | {errors[1]:.3f} cm |")
    for one in MEASUREMENTS:
        values, variances, narrowed = [], [], []
        for (numbers, _), spread, gradient in zip(fits, spreads, gradients, strict=True):
            slope = slopes(one.value, numbers)
            gain = spread @ slope
            variance = float(slope @ gain)
            values.append(one.value(numbers))
            variances.append(variance)
            after = spread - np.outer(gain, gain) / (variance + one.error**2)
            narrowed.append(_error(gradient, after))
        apart = abs(values[0] - values[1]) / np.sqrt(sum(variances) + one.error**2)
        print(f"| {one.name} | {values[0]:.2f} | {values[1]:.2f} | {apart:.1f} | "
              f"{narrowed[0]:.3f} | {narrowed[1]:.3f} |")  # fmt: skip


def _error(gradient: Array, spread: Array) -> float:
    """Root mean square of the standard errors of the gaits' distances [cm]."""
    return float(np.sqrt(np.mean(np.einsum("ij,jk,ik->i", gradient, spread, gradient))))


if __name__ == "__main__":
    main()
