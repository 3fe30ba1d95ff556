"""The path of a tree of limbs: its shapes, contacts, places and headings."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from analytic.solvers.limbs.contacts import Contact
from analytic.solvers.limbs.statics import Rest

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Path:
    """The path of a tree through B states.

    Attributes:
        pressures: of the limbs, (B, L) [Pa].
        rests: its shapes.
        contacts: of each state.
        place: of the trunk's beginning, (B, 2) [m].
        heading: of the trunk, to the left, (B,) [rad].
    """

    pressures: Array
    rests: list[Rest]
    contacts: list[list[Contact]]
    place: Array
    heading: Array

    @property
    def displacement(self) -> Array:
        """Displacement of the trunk's beginning in all, (2,) [m]."""
        return np.asarray(self.place[-1] - self.place[0])

    @property
    def turn(self) -> float:
        """Turn of the trunk in all, to the left [rad]."""
        return float(self.heading[-1] - self.heading[0])

    @property
    def converged(self) -> bool:
        """True if all shapes are equilibria."""
        return all(rest.converged for rest in self.rests)
