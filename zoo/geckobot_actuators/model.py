"""Six actuators of GeckoBot v40 at points that their fits have not seen.

A curve of two numbers (`analytic.fitting`) is fitted to each actuator's points but the one at 30 or
60 degrees, and asked for the angle at that pressure. The error is the standard deviation of the
misses of the six.
"""

import numpy as np

from analytic.fitting.actuator import fit_actuator
from analytic.fitting.bench import Bench
from studies.muscles import one_robot
from zoo.comparison import Predicted


def predicted() -> dict[str, Predicted]:
    """The angle at each point that was left out [deg]."""
    names, pressures, angle = one_robot()
    predictions = {}
    for left_out in (1, 2):
        kept = np.arange(len(angle)) != left_out
        at = np.array([
            float(fit_actuator([Bench(name, p[kept], angle[kept], "deg")]).bend(p[left_out]))
            for name, p in zip(names, pressures, strict=True)
        ])  # fmt: skip
        spread = float(np.std(at - angle[left_out], ddof=1))
        for name, bend in zip(names, at.tolist(), strict=True):
            predictions[f"{name} at {angle[left_out]:g} deg"] = Predicted(bend, spread)
    return predictions
