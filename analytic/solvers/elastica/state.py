"""A shape of the chain, and the traction of the ground along x."""

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


class ChainState(NamedTuple):
    """A shape.

    Attributes:
        y: heights of the nodes, (N + 2,).
        theta, shear, tension: direction, vertical and horizontal internal force of the links,
            (N + 1,); tension but for the weight's part along a slope.
        active: nodes that the ground pushes.
        left: x of the left end.
        near: nodes low enough for adhesive ground to pull at.
    """

    y: Array
    theta: Array
    shear: Array
    active: Mask
    tension: Array
    left: float
    near: Mask


class GroundTraction(Protocol):
    """Additions of the ground's traction to Newton's method, see solvers.elastica.stick_slip.

    Attributes:
        updates: most times that contacts are read anew for one equilibrium.
    """

    updates: int

    @property
    def balanced(self) -> float:
        """Change in a step of Newton's method within which shapes tell their contacts [rad]."""
        ...

    def tensions(self) -> Array:
        """Tension in the links by a unit of traction at each contact that pulls any, (N + 1, C)."""
        ...

    def resolve(
        self, state: ChainState, free: ChainState, response: ChainState
    ) -> ChainState | None:
        """The state of the next step, None if the ground cannot balance it.

        Args:
            state: where the step begins.
            free: where it would lead without traction.
            response: what a unit of traction at each of those adds, arrays with C columns.
        """
        ...

    def update(self, state: ChainState) -> bool:
        """Read the contacts of a state; True if they are those that it was solved with."""
        ...

    def constraints(self, state: ChainState) -> Array:
        """Slopes of the places of contacts that stick by the links' directions, (M, N + 1)."""
        ...
