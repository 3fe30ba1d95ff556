"""Motion of a strip by friction at every contact, along a sequence of shapes."""

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contacts import StripContact, contacts_of
from analytic.friction.dissipation import least_dissipation, minimisers
from analytic.friction.grip import Grip
from analytic.friction.laws import LAWS, Friction
from analytic.scene.ground import over
from analytic.scene.surface import Ground
from analytic.shapes import ContactShapes, Shapes

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_ENDS = 2  # contacts between which the paper's rule decides


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
    x, contacts = _contacts(shapes, friction.roughness)
    strip, count = _Strip(shapes, ground, friction), len(shapes)
    left = np.zeros(count)
    changes = np.zeros(count - 1, dtype=bool)
    for i in range(count - 1):
        pair = contacts[i : i + 2]
        if not all(pair):
            left[i + 1 :] = np.nan
            break
        step = x[i + 1] - x[i]
        sides = [strip.slide(touching, i + j, x[i] + left[i], step)
                 for j, touching in enumerate(pair)]  # fmt: skip
        (begin, begin_open, begin_stuck), (end, end_open, end_stuck) = sides
        left[i + 1] = left[i] + 0.5 * (begin + end)
        moved = abs(begin_stuck - end_stuck) > 1.5 * float(np.diff(shapes.nodes).max())
        changes[i] = moved or begin_open != end_open
    return left, changes


def undecided_motion(shapes: ContactShapes, ground: Ground, friction: Friction) -> float:
    """Displacement along a sequence that the bounds of all contacts leave open, either way [m].

    Where no contact resists, or by load the bounds of some add up to those of the others, the whole
    may move by anything between what leaves one contact in its place and what leaves another. Two
    contacts that resist alike under constant bounds slide alike by rule ([Majidi13], section 2.2);
    of more than two nothing says so.

    Args:
        shapes: states in order of time, with `left` where friction bends the strip.
        ground: under the left end at x = 0 and on both sides of it.
        friction: law.
    """
    x, contacts = _contacts(shapes, friction.roughness)
    left = motion(shapes, ground, friction)[0] if shapes.left is None else shapes.left
    strip, total = _Strip(shapes, ground, friction), 0.0
    for i in range(len(shapes) - 1):
        pair = contacts[i : i + 2]
        if all(pair):
            step, place = x[i + 1] - x[i], x[i] + left[i]
            ranges = (_open(*strip.resistance(touching, i + j, place, step), friction)
                      for j, touching in enumerate(pair))  # fmt: skip
            total += 0.5 * min(ranges)
    return total


def _contacts(shapes: ContactShapes, roughness: float) -> tuple[Array, list[list[StripContact]]]:
    """Places of the nodes from the left end, (B, N) [m], and contacts of each state, if it has."""
    x, height = shapes.curve(shapes.nodes)
    return x, [
        contacts_of(shapes, height, i, roughness) if np.isfinite(shapes.separation[i]) else []
        for i in range(len(shapes))
    ]


def _open(bounds: Array, back: Array, moves: Array, friction: Friction) -> float:
    """Range of motions of the whole between which the bounds of contacts do not decide [m]."""
    if LAWS[friction.law].needs_load:
        low, high = minimisers(bounds.tolist(), moves.tolist(), back.tolist())
        return max(min(high, -float(moves.min())) - max(low, -float(moves.max())), 0.0)
    decided = len(bounds) <= _ENDS or max(bounds.max(), back.max()) > 0
    return 0.0 if decided else float(moves.max() - moves.min())


class _Strip:
    """Contacts of a strip on a ground.

    Args:
        shapes: states.
        ground: under the left end at x = 0 and on both sides of it.
        friction: law.
    """

    def __init__(self, shapes: ContactShapes, ground: Ground, friction: Friction) -> None:
        self._grip = Grip(shapes.robot, LAWS[friction.law])
        self._nodes, self._pressures, self._ground = shapes.nodes, shapes.pressures, ground

    def slide(
        self, contacts: list[StripContact], state: int, x: Array, step: Array
    ) -> tuple[float, bool, float]:
        """Motion in an increment [m], whether bounds leave it open, and where one sticks [m]."""
        bounds, back, moves = self.resistance(contacts, state, x, step)
        low, high = minimisers(bounds.tolist(), moves.tolist(), back.tolist())
        whole = least_dissipation(bounds, moves, back)
        stuck = contacts[int(np.argmin(np.abs(whole + moves)))]
        place = float(stuck.share @ x[stuck.nodes])
        return whole, high > low and moves.max() > moves.min(), place

    def resistance(
        self, contacts: list[StripContact], state: int, x: Array, step: Array
    ) -> tuple[Array, Array, Array]:
        """Bounds of contacts ahead and back [N], and moves by the shape alone [m], (C,) each.

        Args:
            contacts: of the state of a number.
            state: that number.
            x, step: places of the nodes, and by how much the shape moves them, (N,) [m].
        """
        bounds = np.array([
            self._grip.both_ways(
                over(self._ground, *contact.extent(x)), contact.length, contact.load,
                contact.extent(self._nodes), self._pressures[state],
            )
            for contact in contacts
        ])  # fmt: skip
        moves = np.array([contact.share @ step[contact.nodes] for contact in contacts])
        return bounds[:, 0], bounds[:, 1], moves
