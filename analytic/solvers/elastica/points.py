"""States along the branch, and what those before one tell of it."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.shapes import Flag
from analytic.solvers.elastica.signature import Signature
from analytic.solvers.elastica.state import ChainState, Mask

Array = NDArray[np.float64]


NO_MEASURES = np.zeros(0)


class Point(NamedTuple):
    """A state of the branch.

    Attributes:
        row: place along the path of pressures, in its rows.
        pressure: of the segments, (S,) [Pa].
        state: shape and forces.
        status: flag of it.
        iterations: Newton steps to it.
        residual: see ContactShapes.
        contacts: tips and sides, and which of them slide, see StickSlip.signature.
        unsettled: whether it is in no balance with the bounds of its contacts, see StickSlip.begin.
        measures: of its contacts, see StickSlip.measures.
    """

    row: float
    pressure: Array
    state: ChainState
    status: Flag = Flag.OK
    iterations: int = 0
    contacts: Signature | None = None
    unsettled: bool = False
    measures: Array = NO_MEASURES
    residual: float = np.nan


def changed(before: Point, after: Point) -> bool:
    """Tell whether other contacts slide after than before."""
    if before.contacts is None or after.contacts is None:
        return False
    return after.contacts.differs(before.contacts)


def turned(points: list[Point], after: Point) -> bool:
    """Tell whether a contact that slid comes to a stop in the middle of a ramp."""
    before = points[-1]
    if before.contacts is None or after.contacts is None or len(points) <= 2:
        return False
    return after.contacts.turned(before.contacts) and _ratio(points, after.pressure) > 0


def slides_alike(points: list[Point]) -> bool:
    """Tell whether the last two points are of one ramp, the same contacts sliding in both."""
    if len(points) <= 3 or points[-2].contacts != points[-1].contacts:
        return False
    return _ratio(points[:-1], points[-1].pressure) > 0


def _ratio(points: list[Point], pressure: Array) -> float:
    """Length of a step to a pressure over that of the one before it; 0 if not straight on."""
    step, previous = pressure - points[-1].pressure, points[-1].pressure - points[-2].pressure
    size = float(previous @ previous)
    ratio = float(step @ previous) / size if size else 0.0
    bend = np.abs(step - ratio * previous).max()
    return ratio if bend <= 1e-6 * np.abs(step).max() else 0.0


def guess(points: list[Point], pressure: Array, row: float, beyond: Point | None) -> ChainState:
    """First guess of a state: between two known ones, or beyond where the path goes on straight."""
    middle = points[-1]
    if beyond is not None and math.isfinite(beyond.state.left):
        part = (row - middle.row) / (beyond.row - middle.row)
        return _along(middle.state, beyond.state, part)
    ratio = _ratio(points, pressure) if len(points) > 2 else 0.0
    if not 0 < ratio <= 2:
        return middle.state
    return _along(middle.state, points[-2].state, -ratio)


def _along(state: ChainState, toward: ChainState, part: float) -> ChainState:
    """A shape part of the way from one towards another."""
    return state._replace(
        theta=state.theta + part * (toward.theta - state.theta),
        shear=state.shear + part * (toward.shear - state.shear),
        active=_active(state, toward, part) if part > 0 else state.active,
    )


def _active(state: ChainState, toward: ChainState, part: float) -> Mask:
    """Nodes on the ground part of the way: of those that leave it, first those that end highest.

    Newton's method need not find them one by one then. Nodes that land stay up, since with them on
    the ground a tip would be taken for a side before it is one.
    """
    leaving = np.flatnonzero(state.active & ~toward.active)
    highest = leaving[np.argsort(-toward.y[leaving], kind="stable")]
    active = state.active.copy()
    active[highest[: round(part * len(leaving))]] = False
    return active
