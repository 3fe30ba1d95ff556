"""Uncertainty of a predicted displacement: where it rests on states that carry flags."""

import math

import numpy as np

from analytic.prediction import Prediction
from analytic.shapes import Flag

# flags of shapes that are no equilibrium: somewhere the ground would have to pull, or exert a
# moment. Several roots alone are no such thing, the one taken is the stable one
UNSOUND = Flag.NO_ROOT | Flag.PENETRATES | Flag.BOTH_FLAT | Flag.HELD_FLAT


# flags of states of which nothing is sure, of any solver
DOUBTFUL = UNSOUND | Flag.NOT_CONVERGED | Flag.BRANCH_END | Flag.ROLLED_UP | Flag.JUMPED


def flagged_change(prediction: Prediction, flags: Flag = DOUBTFUL) -> float:
    """Change of separation per cycle in increments that begin or end in a flagged state [m].

    So much of the displacement rests on states that carry a flag: what is left of it when they do
    not count is the displacement less this. Without a displacement, infinite.
    """
    if math.isnan(prediction.locomotion.per_cycle):
        return math.inf
    shapes = prediction.shapes
    flagged = (shapes.status & int(flags)) != 0
    change = np.abs(np.diff(shapes.separation))
    return float(change[flagged[1:] | flagged[:-1]].sum()) / prediction.cycles


def modes_error(prediction: Prediction) -> float:
    """Bound on the error that the modes' assumed contacts make in the displacement per cycle [m].

    Where no state is flagged, the modes are the equilibria of exact contact and the bound is 0. In
    increments that begin or end in a state that is no equilibrium (UNSOUND) either end may slide,
    and all change of separation in them may be wrong; measured on random gaits, the bound is about
    five times the error against exact contact and nowhere less. Without a displacement, infinite.
    Solvers with exact contact raise none of these flags: 0.
    """
    return flagged_change(prediction, UNSOUND)
