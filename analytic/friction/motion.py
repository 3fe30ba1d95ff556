"""Motion of a strip by friction at every contact, along a sequence of shapes."""

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contacts import StripContact, contacts_of
from analytic.friction.dissipation import least_dissipation, minimisers
from analytic.friction.laws import LAWS, Friction
from analytic.scene.ground import over
from analytic.scene.surface import Ground
from analytic.shapes import ContactShapes, Shapes

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


def motion(shapes: Shapes, ground: Ground, friction: Friction) -> tuple[Array, Mask]:
    """Motion of least dissipation over all contacts, its mean at the two states of an increment.

    Returns:
        Displacement of the left end since the first state, (B,) [m], NaN from where a shape is
        missing; and the increments in which another contact begins to stick, (B - 1,).

    Raises:
        ValueError: the shapes have no contact forces.
    """
    if not isinstance(shapes, ContactShapes):
        raise ValueError(
            "friction at all contacts needs contact forces, which the modes do not give"
        )
    x, height = shapes.curve(shapes.nodes)
    count = len(shapes)
    left = np.zeros(count)
    changes = np.zeros(count - 1, dtype=bool)
    contacts = [
        contacts_of(shapes, height, i) if np.isfinite(shapes.separation[i]) else []
        for i in range(count)
    ]
    for i in range(count - 1):
        pair = contacts[i : i + 2]
        if not all(pair):
            left[i + 1 :] = np.nan
            break
        step = x[i + 1] - x[i]
        sides = [_slide(state, x[i] + left[i], step, ground, shapes.robot.width, friction)
                 for state in pair]  # fmt: skip
        (begin, begin_open, begin_stuck), (end, end_open, end_stuck) = sides
        left[i + 1] = left[i] + 0.5 * (begin + end)
        moved = abs(begin_stuck - end_stuck) > 1.5 * float(np.diff(shapes.nodes).max())
        changes[i] = moved or begin_open != end_open
    return left, changes


def _slide(
    contacts: list[StripContact],
    x: Array,
    step: Array,
    ground: Ground,
    width: float,
    friction: Friction,
) -> tuple[float, bool, float]:
    """Motion in an increment [m], whether bounds leave it open, and where a contact sticks [m]."""
    law = LAWS[friction.law]
    bounds = np.array([
        law.bound(over(ground, *contact.extent(x)), width, contact.length, contact.load)
        for contact in contacts
    ])  # fmt: skip
    moves = np.array([contact.share @ step[contact.nodes] for contact in contacts])
    low, high = minimisers(bounds.tolist(), moves.tolist())
    whole = least_dissipation(bounds, moves)
    stuck = contacts[int(np.argmin(np.abs(whole + moves)))]
    place = float(stuck.share @ x[stuck.nodes])
    return whole, high > low and moves.max() > moves.min(), place
