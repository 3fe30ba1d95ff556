"""Points that stand for a contact of a limb: two along it, as Gauss's rule has them.

Where the ground resists by area they are those of an even stretch. By load a stretch is far from
even: all that holds up the limb's raised part pushes where it lifts off. The two points and their
parts are then those of Gauss's rule for the pushes of the vertices, by which force, moment and the
two moments beyond are right, so that a side turns about where its load is.
"""

import math
from collections.abc import Sequence

EVEN: tuple[float, ...] = ()  # parts of points that are alike
_ALONG = (0.5 - 12**-0.5, 0.5 + 12**-0.5)
_NARROW = 1e-9  # spread of the pushes over the length, within which they are at one place


def of_area(begin: float, length: float) -> tuple[float, float]:
    """Arclengths of the points of an even stretch [m]."""
    near, far = _ALONG
    return begin + length * near, begin + length * far


def of_load(
    places: Sequence[float], pushes: Sequence[float], length: float
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Arclengths of the points of a stretch [m], and their parts of its load [1].

    Args:
        places, pushes: of the vertices that load it [m, N].
        length: of the limb [m].
    """
    load = sum(pushes)
    mean = sum([place * push for place, push in zip(places, pushes, strict=True)]) / load
    square = cube = 0.0
    for place, push in zip(places, pushes, strict=True):
        arm = place - mean
        moment = push * arm * arm
        square, cube = square + moment, cube + moment * arm
    if square <= (_NARROW * length) ** 2 * load:
        return (mean, mean), (0.5, 0.5)
    lean = 0.5 * cube / square
    half = math.hypot(lean, math.sqrt(square / load))
    part = 0.5 * (1.0 + lean / half)  # of the first
    return (mean + lean - half, mean + lean + half), (part, 1.0 - part)
