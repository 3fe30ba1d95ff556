"""Bounds of the contacts of a strip: by a law on the ground, and by the strip's feet.

Bounds of every law are linear in a surface's numbers. So a side resists by the mean grip over its
stretch times what the law says of the ground, and by the hold of what it covers of each foot.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from analytic.friction.laws import Number, TractionLaw, bounds_both_ways
from analytic.scene.feet import Foot, check_chambers, refuse_damping, refuse_proud
from analytic.scene.ground import depends_on_speed, is_round, surfaces_of
from analytic.scene.limbs import AnyRobot, limbs_of
from analytic.scene.robot import Robot
from analytic.scene.surface import Ground, Surface, Way

_NEAR = 1e-9  # of the length, within which a place is at an end
Stretch = tuple[Number, Number]  # arclengths between which a contact is, the same of a tip [m]


class Grip:
    """Bounds of the contacts of one strip or limb.

    Args:
        strip: with its feet.
        law: of friction.
        robot: that the strip is a limb of; itself if not given.

    Attributes:
        feet: whether there are any.
        switched: whether chambers switch any.
        holds: whether any has a bound of its own.
        most: greatest grip of any part of it [1], and hold of all feet together [N].

    Raises:
        ValueError: a foot is switched by a chamber that the robot does not have, or is of a strip
            and resists viscously.
    """

    def __init__(self, strip: Robot, law: TractionLaw, robot: AnyRobot | None = None) -> None:
        whole = strip if robot is None else robot
        self._law, self._width, self._peak = law, strip.width, whole.peak_pressure
        check_chambers(strip.feet, whole.chambers)
        if isinstance(whole, Robot):
            refuse_damping(strip.feet)
        self._feet = [_Placed.of(foot, strip.length, whole.chambers) for foot in strip.feet]
        self.feet = bool(self._feet)
        self.switched = any(foot.column is not None for foot in self._feet)
        self.holds = any(foot.hold for foot in strip.feet)
        self._round = all(foot.is_round for foot in strip.feet)
        ways: tuple[Way, ...] = ("ahead", "back", "across")
        grips = [foot.grip_against(way) for foot in strip.feet for way in ways]
        self.most = max(1.0, *grips, 0.0), sum(foot.hold for foot in strip.feet)

    def is_round(self, ground: Ground) -> bool:
        """Tell whether contacts on a ground resist everywhere alike in all directions."""
        return self._round and is_round(ground)

    def starts_on_a_nap(self, ground: Ground) -> bool:
        """Tell whether contacts resist more at rest than in sliding, unlike in some directions."""
        sticks = any(surface.static_ratio > 1 for surface in surfaces_of(ground))
        return sticks and not self.is_round(ground)

    def both_ways(
        self, surface: Surface, contact: Number, load: Number, stretch: Stretch, pressures: Any
    ) -> tuple[Number, Number]:
        """Greatest friction of a contact against motion ahead and against motion back [N].

        Args:
            surface: under it.
            contact, load: see analytic.friction.laws.TractionLaw.bound.
            stretch: of the strip that touches.
            pressures: of the robot's chambers, the first axis theirs [Pa]; of no matter without
                feet that are switched.

        Raises:
            ValueError: there are such feet, and pressures are None.
        """
        ahead, back = bounds_both_ways(self._law, surface, self._width, contact, load)
        if not self._feet:
            return ahead, back
        grip, hold, _ = self.over("ahead", stretch, pressures)
        if self._round:
            return grip * ahead + hold, grip * back + hold
        grip_back, *_ = self.over("back", stretch, pressures)
        return grip * ahead + hold, grip_back * back + hold

    def over(self, way: Way, stretch: Stretch, pressures: Any) -> tuple[Number, Number, Number]:
        """Mean grip of a contact against motion one way [1], hold and damping of its feet.

        Args:
            way: of the motion.
            stretch, pressures: see both_ways.
        """
        begin, end = stretch
        plain = isinstance(begin, float) and isinstance(end, float)
        low, high = (max, min) if plain else (np.maximum, np.minimum)
        is_side = 1.0 * (end > begin)
        is_tip, length = 1.0 - is_side, end - begin + (1.0 - is_side)
        grip, hold, damping, bare = 0.0, 0.0, 0.0, 1.0
        for foot, first, last, span, column in self._feet:
            on = self._part(column, pressures, low, high)
            stands = is_tip * (first <= begin) * (begin <= last) * (bare > 0.0)
            covered = is_side * low(0.0, high(end, last) - low(begin, first))
            share = stands + (covered / length if span else 0.0)
            if span:
                caught = covered / span + stands
            else:  # a point at an end
                caught = is_side * (begin <= last) * (first <= end) + stands
            grip = grip + share * (on * foot.grip_against(way) + (1.0 - on))
            hold = hold + caught * on * foot.hold
            damping = damping + caught * on * foot.damping
            bare = bare - share
        return grip + bare, hold, damping

    def _part(self, column: int | None, pressures: Any, low: Any, high: Any) -> Any:
        """Part by which a foot is switched on, 0 to 1."""
        if column is None:
            return 1.0
        if pressures is None:
            raise ValueError(
                "feet that a chamber switches need the pressures of shapes, which this solver does "
                "not give"
            )
        return low(0.0, high(1.0, pressures[column] / self._peak))


class _Placed(NamedTuple):
    """A foot where it is.

    Attributes:
        foot: its numbers.
        first, last: arclengths between which it is, beyond the strip where it reaches to an end,
            so that no rounding of an end's place matters [m].
        span: its length [m].
        column: place of its chamber among the robot's.
    """

    foot: Foot
    first: float
    last: float
    span: float
    column: int | None

    @classmethod
    def of(cls, foot: Foot, length: float, chambers: Sequence[str]) -> "_Placed":
        """A foot of a strip of a length [m], of a robot with these chambers."""
        first, last = foot.begin * length, foot.end * length
        if foot.begin == foot.end:
            first, last = first - _NEAR * length, last + _NEAR * length
        return cls(
            foot,
            first if foot.begin else -math.inf,
            last if foot.end < 1 else math.inf,
            (foot.end - foot.begin) * length,
            None if foot.chamber is None else chambers.index(foot.chamber),
        )


def resists_by_speed(robot: AnyRobot, ground: Ground) -> bool:
    """Tell whether the ground, or a foot, resists anywhere by how fast it slides."""
    feet = any(foot.damping for limb in limbs_of(robot) for foot in limb.strip.feet)
    return feet or depends_on_speed(ground)


def refuse_speed(robot: AnyRobot, ground: Ground) -> None:
    """Raise ValueError for ground or feet that resist by speed, where friction is by load."""
    if resists_by_speed(robot, ground):
        speedy = depends_on_speed(ground)
        what = f"surface {ground.name!r}" if speedy else "a foot with damping"
        raise ValueError(f"{what} resists by speed: friction must be constant, not coulomb")


def check_feet_in_space(robot: AnyRobot, ground: Ground) -> None:
    """Refuse ground on which feet with a direction are not known, in the plane.

    Raises:
        ValueError: it has a nap whose ahead is not the robot's, or a viscous film.
    """
    feet = [foot for limb in limbs_of(robot) for foot in limb.strip.feet]
    refuse_proud(feet, "a robot of limbs")
    if all(foot.is_round for foot in feet):
        return
    for foot in feet:
        if foot.damping:
            raise ValueError(
                "damping of a foot must be 0 where feet of limbs grip otherwise back or across "
                f"than ahead, got {foot.damping:g} N s/m"
            )
    for surface in surfaces_of(ground):
        if surface.viscosity or not (surface.is_round or surface.nap == "robot"):
            what = "viscosity" if surface.viscosity else "a nap of the ground's own"
            raise ValueError(
                f"feet of limbs that grip otherwise back or across than ahead are for ground "
                f"without {what}, got surface {surface.name!r}"
            )


def pressures_of(shapes: Any) -> Any:
    """Pressures of the chambers at the states of shapes, (S, B) [Pa], None if they have none."""
    pressures = getattr(shapes, "pressures", None)
    return None if pressures is None else pressures.T
