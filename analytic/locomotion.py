"""From a sequence of shapes and a surface to the way the robot goes ([Majidi13], section 2.2)."""

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.equilibria import ContactShapes, Shapes
from analytic.friction import (
    Friction,
    Surface,
    coulomb_resistance,
    left_slip_fraction,
    sliding_resistance,
)

Array = NDArray[np.float64]
Direction = Literal["forward", "backward", "none"]

STANDSTILL = 0.005  # |Delta|/L below which a cycle counts as no travel; chosen, 0.65 mm on 130 mm


class Locomotion(NamedTuple):
    """Displacements along a sequence of B states.

    Attributes:
        left: displacement of the left end since the first state, shape (B,) [m].
        right: displacement of the right end since the first state, shape (B,) [m].
        per_cycle: Delta, displacement of the left end per cycle [m]; NaN if a state has none.
    """

    left: Array
    right: Array
    per_cycle: float


UNBENT = Friction()


def locomotion(
    shapes: Shapes, surface: Surface, cycles: int = 1, friction: Friction = UNBENT
) -> Locomotion:
    """Apply the anchor rule of section 2.2 to a sequence of states.

    Each change of separation is taken up by the end that resists less, by both alike when they
    resist alike. An increment uses the mean of the rule at its two states, so that the reversed
    sequence gives exactly the opposite displacement, on level ground.

    Args:
        shapes: states in order of time, evenly or unevenly spaced; finer is more accurate.
        surface: the ground.
        cycles: number of cycles that the sequence holds.
        friction: law and slope.

    Raises:
        ValueError: fewer than two states, cycles below 1, or a law that needs contact forces for
            shapes that have none.
    """
    if len(shapes) < 2 or cycles < 1:
        raise ValueError(
            f"need at least two states and one cycle, got {len(shapes)} states, {cycles} cycles"
        )
    change = np.diff(shapes.separation)
    left = np.concatenate(
        [[0.0], np.cumsum(-mean_slip_fraction(shapes, surface, friction) * change)]
    )
    right = left + (shapes.separation - shapes.separation[0])
    return Locomotion(left, right, float(left[-1] / cycles))


def mean_slip_fraction(shapes: Shapes, surface: Surface, friction: Friction = UNBENT) -> Array:
    """Part of each change of separation that the left end takes up, (B - 1,): 0 to 1."""
    left, right = resistances(shapes, surface, friction.law)
    downhill, growing = friction.downhill(shapes.robot), np.diff(shapes.separation) > 0
    before = left_slip_fraction(left[:-1], right[:-1], downhill, growing)
    after = left_slip_fraction(left[1:], right[1:], downhill, growing)
    return 0.5 * (before + after)


def slip_fraction(shapes: Shapes, surface: Surface, law: str = "constant") -> Array:
    """Part of a change of separation that the left end takes up at each state, (B,): 0, 1/2, 1.

    On level ground; see `mean_slip_fraction` for slopes.
    """
    return left_slip_fraction(*resistances(shapes, surface, law))


def resistances(shapes: Shapes, surface: Surface, law: str) -> tuple[Array, Array]:
    """What the left and the right end resist by at each state, (B,) each [V0].

    Under "constant" V_t or tau A, under "coulomb" mu N; see analytic.friction.

    Raises:
        ValueError: the law needs contact forces and the shapes have none.
    """
    ends = shapes.contact_left, shapes.contact_right
    if law == "constant":
        left, right = (sliding_resistance(shapes.robot, surface, end) for end in ends)
        return left, right
    if not isinstance(shapes, ContactShapes):
        raise ValueError(f"law {law!r} needs contact forces, which the modes do not give")
    _, y = shapes.curve(shapes.nodes)
    return coulomb_resistance(shapes.robot, surface, ends, shapes.force, y)


def undecided(shapes: Shapes, surface: Surface, law: str = "coulomb") -> float:
    """How much of the displacement along a sequence the law leaves open, either way [m].

    Where both ends resist alike, by nothing or to the last digit, Coulomb's law does not say which
    one slides: the whole change of separation may be the left end's or the right end's, and
    `locomotion` takes half. The constant-bound law decides so by rule.
    """
    share = slip_fraction(shapes, surface, law)
    tied = (share[1:] == 0.5) & (share[:-1] == 0.5)
    return float(0.5 * np.abs(np.diff(shapes.separation))[tied].sum())


def direction(displacement: float, length: float) -> Direction:
    """Name the way a cycle went: "forward" is +x, "none" is below STANDSTILL of the length.

    Raises:
        ValueError: the displacement is NaN, so that there is nothing to name.
    """
    if np.isnan(displacement):
        raise ValueError("the displacement is NaN: some state has no solution")
    if abs(displacement) < STANDSTILL * length:
        return "none"
    return "forward" if displacement > 0 else "backward"
