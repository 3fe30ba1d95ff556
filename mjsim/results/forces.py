"""Forces of the ground along a walk."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class GroundForces(NamedTuple):
    """Forces of the ground in each step, left end first.

    Attributes:
        normal: push of the ground on each node, (T, N + 2) [N].
        friction: along +x on each node, viscous resistance included, (T, N + 2) [N]. Friction
            of a side contact acts at the one node that stands for it.
    """

    normal: Array
    friction: Array
