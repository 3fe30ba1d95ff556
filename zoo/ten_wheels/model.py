"""Ten wheels at equal radius on a carousel, each driven at its own speed: how fast the whole goes.

Of an even number of contacts every speed between the two middle ones dissipates alike, and a median
is half-way by convention: the prediction is how far those speeds lie outside of the two middle
ones, at most over random speeds, beside the spread of the speeds.
"""

import numpy as np

from analytic.friction.dissipation import least_dissipation
from zoo.comparison import Predicted

WHEELS, DRAWS = 10, 2000


def speed(wheels: np.ndarray) -> float:
    """Speed of the whole where each wheel's contact is driven at a speed under equal loads."""
    # a contact that the drive moves back by its speed stands still if the whole goes ahead by it
    return least_dissipation(np.ones(len(wheels)), -wheels)


def predicted() -> dict[str, Predicted]:
    """The largest distance of the speed from the middle speeds, over the spread."""
    rng = np.random.default_rng(0)
    worst = 0.0
    for _ in range(DRAWS):
        wheels = np.sort(rng.normal(size=WHEELS))
        low, high = wheels[WHEELS // 2 - 1], wheels[WHEELS // 2]
        found = speed(wheels)
        worst = max(worst, low - found, found - high)
    return {"speed less the median": Predicted(float(worst))}
