"""Uncertainty of a predicted displacement: where it rests on states that carry flags."""

import math

import numpy as np
from numpy.typing import NDArray

from analytic.locomotion import weaker_bound
from analytic.prediction import Prediction
from analytic.scene import pneunet
from analytic.scene.surface import Surface
from analytic.shapes import Flag

Array = NDArray[np.float64]

_POINTS = 81  # of a shape, whose integrals they are; chosen
_STILL = 1e-9  # of the length, that no separation changes by

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


def small_slopes(prediction: Prediction) -> float:
    """Estimate of the error that small slopes make in the modes' displacement per cycle [m].

    The modes shorten the strip by half the integral of the slope squared, which leaves out an
    eighth of that of its fourth power, and bend it linearly: of the shortening L - Lambda a part
    of about the steepest slope squared. What counts is where one end ceases to slide and the other
    begins, as between the two the displacement is a difference of separations.
    """
    shapes, (s, y) = prediction.shapes, _heights(prediction)
    slope = np.abs(np.gradient(y, s, axis=1)).max(axis=1)
    return _at_changes(prediction, slope**2 * (shapes.robot.length - shapes.separation))


def bending_by_friction(prediction: Prediction, surface: Surface, law: str = "constant") -> float:
    """Bound on what bending by friction changes in a displacement per cycle without it [m].

    The ground pulls at most with the lesser bound b of the two ends. A pull H changes the
    separation of an arch of height y by H times the integral of y^2 / D0 (its virtual work;
    contacts and pressure make it stiffer), which counts where one end ceases to slide and the other
    begins.

    Args:
        prediction: by a solver of weak friction.
        surface, law: under it.
    """
    shapes, (s, y) = prediction.shapes, _heights(prediction)
    yielding = np.trapezoid(y**2, s, axis=1) / pneunet.base_rigidity(shapes.robot)
    return _at_changes(prediction, yielding * weaker_bound(shapes, surface, law))


def _heights(prediction: Prediction) -> tuple[Array, Array]:
    """Arclengths (S,) and heights of the strip there in all states, (B, S) [m]."""
    s = np.linspace(0.0, prediction.shapes.robot.length, _POINTS)
    return s, prediction.shapes.curve(s)[1]


def _at_changes(prediction: Prediction, change: Array) -> float:
    """Sum of changes of separation (B,), each times how much the slip of an end changes there."""
    shift, slid = np.diff(prediction.shapes.separation), np.diff(prediction.locomotion.left)
    moves = np.abs(shift) > _STILL * prediction.shapes.robot.length
    if not moves.any():
        return 0.0
    part = -slid[moves] / shift[moves]
    jump = np.abs(np.diff(part, append=part[0]))
    before, after = change[1:][moves], np.roll(change[:-1][moves], -1)
    return float((jump * np.maximum(before, after)).sum()) / prediction.cycles
