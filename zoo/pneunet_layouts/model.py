"""Angles of 53 layouts of pneu-nets at their highest pressure, from their lower two thirds.

A curve of two numbers (`analytic.fitting`) is fitted to all but the top third of a layout's points,
and asked for the last one. The quantities are those of the layouts: the largest and median error at
the points left out, and how many are met within 2 degrees.
"""

import numpy as np

from studies.muscles import layouts, without_top_third
from zoo.comparison import Predicted

SHOWN = 9  # every ninth layout stands for itself


def predicted() -> dict[str, Predicted]:
    """The angle at the highest pressure of some layouts, and how many of all are met [deg]."""
    fits = {name: without_top_third(*points) for name, points in layouts().items()}
    errors = np.array([error for _, error in fits.values()])
    spread = float(np.sqrt(np.mean(errors**2)))
    predictions = {}
    for name, (p, _) in list(layouts().items())[::SHOWN]:
        predictions[name] = Predicted(float(fits[name][0].bend(p[-1])), spread)
    predictions["layouts met within 2 deg"] = Predicted(float((errors <= 2.0).sum()))
    return predictions
