"""One state of a tree of limbs at rest on the ground."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Rest(NamedTuple):
    """A tree at rest.

    Attributes:
        q: its coordinates, see analytic.solvers.limbs.kinematics.
        nodes: places, (P, 3) [m].
        force: of the ground on each, (P,) [N].
        converged: whether forces and heights are those of an equilibrium.
    """

    q: Array
    nodes: Array
    force: Array
    converged: bool
