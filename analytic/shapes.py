"""Results of every quasi-static solver: the strip's shape and contact at a batch of states."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import IntEnum, IntFlag
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from analytic.scene.robot import Robot

Array = NDArray[np.float64]


class Mode(IntEnum):
    """Contact mode: which end lies flat, and in which segment it lifts off (Figure 6)."""

    TIP = 0  # both ends in point contact
    LEFT_1 = 1  # (i): the left end lies flat up to a lift-off in segment 1
    LEFT_2 = 2  # (ii)
    LEFT_3 = 3  # (iii)
    RIGHT_1 = 4  # (iv): the right end lies flat from a touch-down in segment 1
    RIGHT_2 = 5  # (v)
    RIGHT_3 = 6  # (vi)
    FLAT = 7  # the whole strip lies on the ground
    BOTH = 8  # both ends lie flat; the paper's modes do not know it


class Flag(IntFlag):
    """Flags of a state that say how far it can be trusted; they add up.

    Values are NaN with NO_ROOT, NOT_CONVERGED, BRANCH_END and ROLLED_UP, else numbers.
    """

    OK = 0
    NO_ROOT = 1  # no lift-off point exists with one end flat: no equilibrium of the assumed kind
    SEVERAL_ROOTS = 2  # several lift-off points balance; the one with least contact was taken
    PENETRATES = 4  # the shape sinks below the ground between its contacts
    BOTH_FLAT = 8  # the end in point contact slopes into the ground: both ends want to lie flat
    HELD_FLAT = 16  # a part that lies flat is inflated: the paper's modes have no moment for that
    NOT_CONVERGED = 32  # the iteration gave up
    BRANCH_END = 64  # the stable equilibrium that the sequence followed ended before this state
    ROLLED_UP = 128  # an end curls up off the ground: neither tip nor side, so no law of friction
    JUMPED = 256  # friction gave way at once; this is where slow motion with damping comes to rest


@dataclass(frozen=True)
class Shapes:
    """Equilibria at B pressure states.

    Attributes:
        robot: the strip they belong to.
        separation: Lambda, horizontal distance of the two ends, shape (B,) [m].
        contact_left: length of side contact at the left end, 0 for a tip, shape (B,) [m].
        contact_right: the same at the right end, shape (B,) [m].
        amplitude: greatest height of the strip, shape (B,) [m].
        status: shape (B,), values of Flag.
        curve: material points s of shape (S,) [m] -> (x, y), each of shape (B, S) [m], with x
            measured from the left end.
    """

    robot: Robot
    separation: Array
    contact_left: Array
    contact_right: Array
    amplitude: Array
    status: NDArray[np.int_]
    curve: Callable[[Array], tuple[Array, Array]]

    def __len__(self) -> int:
        return len(self.separation)

    def with_states(self, other: Self, order: NDArray[np.int_]) -> Self:
        """These states and others of the same solver and nodes.

        Args:
            other: more states.
            order: places of all states among these followed by the others.
        """
        merged = {
            name: np.concatenate([values, getattr(other, name)])[order]
            for name, values in vars(self).items()
            if isinstance(values, np.ndarray) and name != "nodes"
        }

        def curve(s: Array) -> tuple[Array, Array]:
            x, y = (np.concatenate(pair)[order]
                    for pair in zip(self.curve(s), other.curve(s), strict=True))  # fmt: skip
            return x, y

        states: dict[str, Any] = {"curve": curve, **merged}
        return replace(self, **states)

    @property
    def mode(self) -> NDArray[np.int_]:
        """Contact mode by the ends' contact lengths, shape (B,), values of Mode; TIP if NaN.

        Segments are counted from the left; the third stands for all beyond it too.
        """
        left, right, length = self.contact_left, self.contact_right, self.robot.length
        inner = self.robot.borders[1:-1]
        reach = length * (1 + 1e-9)  # lengths come with rounding
        in_left = np.minimum(np.searchsorted(inner, left / reach, side="right"), 2)
        in_right = np.minimum(np.searchsorted(inner, 1 - right / length, side="right"), 2)
        mode = np.full(len(left), int(Mode.TIP))
        mode = np.where(left > 0, Mode.LEFT_1 + in_left, mode)
        mode = np.where(right > 0, Mode.RIGHT_1 + in_right, mode)
        mode = np.where((left > 0) & (right > 0), Mode.BOTH, mode)
        return np.where(left + right >= length * (1 - 1e-9), Mode.FLAT, mode)


@dataclass(frozen=True)
class ContactShapes(Shapes):
    """Equilibria of a solver with unilateral contact at nodes.

    Attributes:
        nodes: arclength of the nodes, shape (S,) [m].
        force: of the ground on each node, upwards, shape (B, S) [N].
        pressures: of the segments, left first, shape (B, number of segments) [Pa].
        residual: largest violation of the conditions of contact and balance, with heights over L
            and forces over the strip's weight, shape (B,) [1].
        iterations: linear systems that were solved for each state, those of attempts that failed
            included, shape (B,).
    """

    nodes: Array
    force: Array
    pressures: Array
    residual: Array
    iterations: NDArray[np.int_]
    rows: Array | None = None
    """place of each state along the path that was asked for, in its rows, where states were added
    to it, shape (B,)"""
    left: Array | None = None
    """displacement of the left end since the first state where friction bends the strip and so
    decides place and shape together, shape (B,) [m]"""
