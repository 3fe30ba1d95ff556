"""What one more measurement would tell: `python -m zoo.terresoro_iv.decide`.

For each measurement that could be made, with the accuracy that is written beside it: how sure the
fit is of it already, and by how much it narrows the errors of the five gaits' distances, by the
information matrix of the fit. Its covariance is by kinds of transitions, since errors of those that
share a cause are no chance. And the gaits that tell forms of memory apart.
"""

from collections.abc import Callable
from functools import partial
from itertools import combinations
from typing import NamedTuple

import numpy as np

from studies import Array
from zoo.deciding import errors, narrowed
from zoo.terresoro_iv.best import cycles, reach, reaches
from zoo.terresoro_iv.hub import jackknife
from zoo.terresoro_iv.model import FORM, Lagged, covariance, motions, remembered, slopes, steady
from zoo.terresoro_iv.model import cycles as cycles_of_gaits

FORMS = ("no memory", FORM, "free flat contact", "load", "order of curling")


class Measurement(NamedTuple):
    """A measurement that could be made.

    Attributes:
        name: in words, with its accuracy.
        value: what it would show of a robot of some numbers.
        error: its standard error, in the unit of the value.
    """

    name: str
    value: Callable[[Lagged], float]
    error: float


def half_speed(numbers: Lagged) -> Lagged:
    """The robot with 0.9 s a transition: half the viscous part, and twice the time to curl."""
    return numbers._replace(viscous=numbers.viscous - np.log(2), lag=numbers.lag**2)


def reached(states: tuple[str, ...], numbers: Lagged) -> float:
    """Distance after 60 transitions [cm]."""
    return reach(motions(numbers, *steady(states)))


def reached_slowly(states: tuple[str, ...], numbers: Lagged) -> float:
    """The same at half the speed [cm]."""
    return reached(states, half_speed(numbers))


C, D = ("0111", "1000", "1111"), ("0011", "1101")
MEASUREMENTS = (
    Measurement("damping of a curled over a flat resting limb, 10 %", lambda n: n.resting, 0.1),
    Measurement("damping of a curling over a flat limb, 10 %", lambda n: n.curling, 0.1),
    Measurement("damping of an uncurling over a flat limb, 10 %", lambda n: n.uncurling, 0.1),
    Measurement("damping over dry friction of a flat limb, 10 %", lambda n: n.viscous, 0.1),
    Measurement("part of the curl that lacks after 0.45 s, 0.02", lambda n: n.lag, 0.02),
    Measurement(
        "direction of a curled limb's contact, 2 deg", lambda n: n.curled_angle, np.radians(2)
    ),
    Measurement("distance of a curled limb's contact, 0.2 cm", lambda n: n.curled, 0.2),
    Measurement("gait C, 60 transitions, 1 cm", partial(reached, C), 1.0),
    Measurement("gait D, 60 transitions, 1 cm", partial(reached, D), 1.0),
    Measurement("gait C at half the speed, 1 cm", partial(reached_slowly, C), 1.0),
    Measurement("gait D at half the speed, 1 cm", partial(reached_slowly, D), 1.0),
)


def distances(values: Array) -> Array:
    """Distances of the five gaits, (5,) [cm]."""
    return cycles_of_gaits(values)[:, 0]


def slope(measurement: Measurement, values: Array) -> Array:
    """Slope of what a measurement shows by the numbers, (7,)."""
    return slopes(lambda at: np.asarray(measurement.value(Lagged(*at))), values)


def main() -> None:
    """Print a row per measurement, and the gaits that tell forms apart."""
    values, _ = remembered()
    numbers, spread = Lagged(*values), covariance()
    gradient = slopes(distances, values)
    print("| measurement | the fit says | after it | gaits' error left |")
    print("|---|---|---|---|")
    print(f"| none | | | {_error(gradient, spread):.3f} cm |")
    for measurement in MEASUREMENTS:
        shows = slope(measurement, values)
        after = narrowed(spread, shows, measurement.error)
        before, then = (float(np.sqrt(shows @ s @ shows)) for s in (spread, after))
        shown = f"{measurement.value(numbers):.2f} ± {before:.2f} | ± {then:.2f}"
        print(f"| {measurement.name} | {shown} | {_error(gradient, after):.3f} cm |")
    every, far, wide = list(cycles()), {}, {}
    for form in FORMS:
        best, others = remembered(form)
        far[form] = reaches(every, best, form)
        wide[form] = jackknife(np.array([reaches(every, row, form) for row in others]))
    for one, two in combinations(FORMS, 2):
        apart = np.abs(far[one] - far[two]) / np.sqrt(wide[one] ** 2 + wide[two] ** 2 + 1.0)
        k = int(np.argmax(apart))
        print(
            f"{one} or {two}: {' '.join(every[k])}, {far[one][k]:.1f} ± {wide[one][k]:.1f} or "
            f"{far[two][k]:.1f} ± {wide[two][k]:.1f} cm, {apart[k]:.1f} errors apart"
        )


def _error(gradient: Array, spread: Array) -> float:
    """Root mean square of the standard errors of the gaits' distances [cm]."""
    return float(np.sqrt(np.mean(errors(spread, gradient) ** 2)))


if __name__ == "__main__":
    main()
