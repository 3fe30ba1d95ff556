"""The path of a tree of limbs: its shapes, contacts, places and headings."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from analytic.scene.limbs import LimbedRobot, rotation
from analytic.solvers.limbs.contact_search import Contact
from analytic.solvers.limbs.rest import Rest

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Path:
    """The path of a tree through B states.

    Attributes:
        robot: whose limbs they are.
        pressures: of the chambers, (B, S) [Pa].
        times: of the states, (B,) [s]; their numbers where no times were given.
        rests: its shapes.
        contacts: of each state.
        place: of the trunk's beginning, (B, 2) [m].
        heading: of the trunk, to the left, (B,) [rad].
    """

    robot: LimbedRobot
    pressures: Array
    times: Array
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

    def by_cycle(self, cycles: int) -> tuple[Array, Array]:
        """Displacement of the trunk's beginning and its turn in each of C cycles.

        Args:
            cycles: of equal duration, that the path is of.

        Returns:
            (C, 2) [m], ahead and to the left of the trunk's direction when the cycle begins; and
            (C,) to the left [rad].
        """
        moves, turns = self.by_part(cycles, 1)
        return moves[:, 0], turns[:, 0]

    def by_part(self, cycles: int, parts: int) -> tuple[Array, Array]:
        """Displacement and turn in each of P equal parts of each of C cycles, as of `by_cycle`.

        Returns:
            (C, P, 2) [m] and (C, P) [rad].
        """
        ends = np.linspace(self.times[0], self.times[-1], cycles * parts + 1)
        places = np.stack([np.interp(ends, self.times, part) for part in self.place.T], axis=1)
        headings = np.interp(ends, self.times, self.heading)
        direction = self.robot.limbs[0].angle
        moves = np.diff(places, axis=0).reshape(cycles, parts, 2)
        turned = [rotation(direction + at) for at in headings[:-1:parts]]
        return moves @ np.array(turned), np.diff(headings).reshape(cycles, parts)

    @property
    def converged(self) -> bool:
        """True if all shapes are equilibria."""
        return all(rest.converged for rest in self.rests)
