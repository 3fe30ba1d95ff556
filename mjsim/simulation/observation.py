"""Controllers, and their observations."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mjsim.results.status import Status

Array = NDArray[np.float64]


class Observation(NamedTuple):
    """Measurements that a controller gets after each step.

    Attributes:
        time: since the first cycle began [s].
        pressure: in the chambers, in the order of the gait's columns, (S,) [Pa].
        place: of the trunk's beginning, the left end of a strip, (2,) [m].
        heading: direction of the trunk, to the left of where it first points [rad].
        right: x of the right end of a strip, of the end of a trunk [m].
        contact_left, contact_right: length of side contact of a strip's ends, 0 for a tip [m]; NaN
            of a robot of limbs.
        contacts: number of limbs of such a robot that touch the ground; NaN of a strip.
        status: OK, or why the simulation stopped.
    """

    time: float
    pressure: Array
    place: Array
    heading: float
    right: float
    contact_left: float
    contact_right: float
    contacts: float
    status: Status

    @property
    def left(self) -> float:
        """Place of the left end of a strip, of the beginning of a trunk, along x [m]."""
        return float(self.place[0])


Policy = Callable[[Observation], ArrayLike]
"""Function from an observation to commands of the valves, (S,) [Pa]; a Gait is open-loop."""
