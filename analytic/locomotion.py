"""Locomotion of a robot along a sequence of shapes on a ground ([Majidi13], section 2.2)."""

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import end_loads
from analytic.friction.grip import Grip, pressures_of
from analytic.friction.laws import LAWS, Friction, slip_fraction
from analytic.friction.motion import motion
from analytic.scene.feet import refuse_proud
from analytic.scene.ground import over
from analytic.scene.surface import Ground, Surface
from analytic.shapes import ContactShapes, Shapes

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Direction = Literal["forward", "backward", "none"]

STANDSTILL = 0.002  # |Delta|/L below which a cycle counts as no travel; chosen, 0.26 mm on 130 mm
_ROUNDING = 1e-12  # of the greatest bound, by which those of two ends differ that are alike; chosen
WEAK = Friction()


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


def displacements(
    shapes: Shapes, ground: Ground, cycles: int = 1, friction: Friction = WEAK
) -> Locomotion:
    """Apply the anchor rule of section 2.2 to a sequence of states.

    Each change of separation is taken up by the end whose bound is less, by both alike where they
    are alike; with friction at all contacts by least dissipation, see analytic.friction.motion. An
    increment uses the mean of the rule at its two states, so that the reversed sequence gives
    exactly the opposite displacement, on uniform level ground.

    Args:
        shapes: states in order of time, evenly or unevenly spaced; finer is more accurate.
        ground: under the left end at x = 0 and on both sides of it.
        cycles: number of cycles in the sequence.
        friction: law and slope.

    Raises:
        ValueError: fewer than two states, cycles below 1, or a law that needs contact forces for
            shapes that have none.
    """
    if len(shapes) < 2 or cycles < 1:
        raise ValueError(
            f"need at least two states and one cycle, got {len(shapes)} states, {cycles} cycles"
        )
    left, _ = left_end(shapes, ground, friction)
    right = left + (shapes.separation - shapes.separation[0])
    return Locomotion(left, right, float(left[-1] / cycles))


def left_end(shapes: Shapes, ground: Ground, friction: Friction) -> tuple[Array, Mask]:
    """Apply the rule of `displacements`, and see where the anchor changes.

    Returns:
        Displacement of the left end since the first state, (B,) [m]; and the increments in which
        another contact begins to stick, (B - 1,).
    """
    if friction.tension and isinstance(shapes, ContactShapes) and shapes.left is not None:
        return shapes.left, np.zeros(len(shapes) - 1, dtype=bool)  # all known
    if shapes.robot.tether and shapes.robot.tether.resists:
        raise ValueError(
            "a tether that resists is for elastica with friction that bends the strip: tension "
            "must be above 0"
        )
    if friction.contacts == "ends":
        refuse_proud(shapes.robot.feet, "friction at the ends alone")
    else:
        return motion(shapes, ground, friction)
    if isinstance(ground, Surface):
        return _on_uniform(shapes, ground, friction)
    return _along(shapes, ground, friction)


def _on_uniform(shapes: Shapes, surface: Surface, friction: Friction) -> tuple[Array, Mask]:
    """See `left_end`."""
    change, downhill = np.diff(shapes.separation), friction.downhill(shapes.robot)
    sides = _resisting(shapes, surface, friction.law, change > 0)
    near = _ROUNDING * float(np.nanmax(sides, initial=0.0))
    before, after = (slip_fraction(*ends, downhill, change > 0, near) for ends in sides)
    slip = 0.5 * (before + after)
    switches = before != after
    if not Grip(shapes.robot, LAWS[friction.law]).is_round(surface):
        # where the separation turns, the other end's turn may come
        turns = (np.diff(np.sign(change)) != 0) & (np.diff(slip) != 0)
        switches[1:] |= turns
        switches[:-1] |= turns
    return np.concatenate([[0.0], np.cumsum(-slip * change)]), switches


def _resisting(
    shapes: Shapes, surface: Surface, law: str, growing: Mask
) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Bounds of both ends at the begin and at the end of each increment, against their motion.

    Args:
        shapes, surface, law: see bounds.
        growing: whether the separation grows in the increment, (B - 1,).
    """
    left, right = (
        [np.where(way, back[part], ahead[part]) for part in (slice(-1), slice(1, None))]
        for (ahead, back), way in zip(_both_ways(shapes, surface, law), (growing, ~growing),
                                      strict=True)
    )  # fmt: skip
    return (left[0], right[0]), (left[1], right[1])


def _along(shapes: Shapes, ground: Ground, friction: Friction) -> tuple[Array, Mask]:
    """See `left_end`, for ground that changes under the robot."""
    grip, stretches = Grip(shapes.robot, LAWS[friction.law]), _stretches(shapes)
    contact, load = _ends(shapes, friction.law)
    pressures = pressures_of(shapes)
    downhill = friction.downhill(shapes.robot)
    left = np.zeros(len(shapes))
    changes, before = np.zeros(len(shapes) - 1, dtype=bool), 0.5
    for i, separation in enumerate(shapes.separation[:-1]):
        change = shapes.separation[i + 1] - separation
        slips, surfaces, x = [], [], left[i]
        ways = (1, 0) if change > 0 else (0, 1)  # back or ahead
        for j in (i, i + 1):
            right = x + shapes.separation[j]
            under = over(ground, x, x + contact[0][j]), over(ground, right - contact[1][j], right)
            state = None if pressures is None else pressures[:, j]
            ends = (
                grip.both_ways(under[k], contact[k][j], load[k][j], stretches[k][j], state)[ways[k]]
                for k in (0, 1)
            )
            slips.append(slip_fraction(next(ends), next(ends), downhill, change > 0))
            surfaces.append((ground.at(x), ground.at(right)))
            x = left[i] - slips[0] * change  # where the second state would be by the first's rule
        left[i + 1] = left[i] - 0.5 * sum(slips) * change
        changes[i] = slips[0] != slips[1] or slips[0] != before or surfaces[0] != surfaces[1]
        before = slips[1]
    return left, changes


def state_slip(shapes: Shapes, surface: Surface, law: str = "constant") -> Array:
    """Part of a change of separation that the left end takes up at each state, (B,): 0, 1/2, 1.

    On level ground that is alike in all directions.
    """
    return np.asarray(slip_fraction(*bounds(shapes, surface, law)))


def bounds(shapes: Shapes, surface: Surface, law: str) -> tuple[Array, Array]:
    """Greatest friction of the left and the right end at each state, ahead, (B,) each [N].

    Raises:
        ValueError: the law needs contact forces and the shapes have none.
    """
    (left, _), (right, _) = _both_ways(shapes, surface, law)
    return left, right


def _both_ways(
    shapes: Shapes, surface: Surface, law: str
) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Bounds of the left end, ahead and back, and of the right end, (B,) each [N]; see bounds."""
    grip, (contact, load) = Grip(shapes.robot, LAWS[law]), _ends(shapes, law)
    pressures = pressures_of(shapes)
    left, right = (
        grip.both_ways(surface, contact[end], load[end], tuple(stretch.T), pressures)
        for end, stretch in enumerate(_stretches(shapes))
    )
    return left, right


def weaker_bound(shapes: Shapes, surface: Surface, law: str) -> Array:
    """Lesser of the bounds of the two ends, each the way it holds more, (B,) [N]."""
    left, right = _both_ways(shapes, surface, law)
    return np.minimum(np.maximum(*left), np.maximum(*right))


def _stretches(shapes: Shapes) -> tuple[Array, Array]:
    """Arclengths between which the left and the right end touch, (B, 2) each [m]."""
    zero, length = np.zeros(len(shapes)), np.full(len(shapes), shapes.robot.length)
    left, right = shapes.contact_left, shapes.robot.length - shapes.contact_right
    return np.stack([zero, left], axis=1), np.stack([right, length], axis=1)


def _ends(shapes: Shapes, law: str) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Contact lengths and loads of the two ends."""
    contact = shapes.contact_left, shapes.contact_right
    if not LAWS[law].needs_load:
        return contact, (np.zeros(len(shapes)), np.zeros(len(shapes)))
    if not isinstance(shapes, ContactShapes):
        raise ValueError(f"law {law!r} needs contact forces, which the modes do not give")
    _, y = shapes.curve(shapes.nodes)
    return contact, end_loads(shapes.force, y)


def undecided(shapes: Shapes, surface: Surface, law: str = "coulomb", alike: float = 0.0) -> float:
    """Displacement along a sequence that the law leaves open, either way [m].

    Where both ends resist alike, by nothing or to the last digit, Coulomb's law does not say which
    one slides: the whole change of separation may be the left end's or the right end's, and
    `displacements` takes half. The constant bounds of [Majidi13] decide so by rule.

    Args:
        shapes, surface, law: the walk.
        alike: part of the larger bound by which two may differ and count as equal [1].
    """
    change = np.diff(shapes.separation)
    before, after = (
        np.abs(left - right) <= alike * np.maximum(left, right)
        for left, right in _resisting(shapes, surface, law, change > 0)
    )
    return float(0.5 * np.abs(change)[before & after].sum())


def direction(displacement: float, length: float, error: float = 0.0) -> Direction:
    """Name the way a cycle went: "forward" is +x, "none" is within its error or STANDSTILL.

    Args:
        displacement: per cycle [m].
        length: of the robot, of which STANDSTILL is a part [m].
        error: bar of the displacement [m].

    Raises:
        ValueError: the displacement is NaN, so that there is nothing to name.
    """
    if np.isnan(displacement):
        raise ValueError("the displacement is NaN: some state has no solution")
    if abs(displacement) < max(STANDSTILL * length, error):
        return "none"
    return "forward" if displacement > 0 else "backward"
