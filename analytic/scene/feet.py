"""Feet: stretches of a strip or limb that resist otherwise than its skin does."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import Any

from analytic.checks import is_number, not_negative, one_of
from analytic.fields import in_si, records
from analytic.scene.surface import Way, by_way

_PLACE = ("begin", "end", "chamber")  # keys of a foot that tell where and when it acts


@dataclass(frozen=True)
class Foot:
    """Pad, bristles, claw or suction cup on the underside.

    It changes dry friction: a viscous film on the ground resists as without it. Dry friction that
    is stronger at rest is so under a foot too, its hold included. A soft pad may resist viscously
    besides.

    A number may be a text with its unit, as in hold="20 mN", and is in SI then.

    Raises:
        ValueError: a value is negative or not finite; it ends before it begins or beyond the strip;
            or it has no length and is not at an end.
    """

    begin: float
    """where it begins, over the length of the strip from its left, or of the limb from where that
    begins [1]"""
    end: float
    """where it ends [1]; a foot without length is a point at an end, 0 or 1"""
    grip: float = 1.0
    """its dry friction over that of the skin at its place [1]"""
    grip_back: float | None = None
    """the same against motion back; as ahead if not given [1]"""
    grip_across: float | None = None
    """the same against motion across; the mean of ahead and back if not given [1]"""
    hold: float = 0.0
    """bound by which it resists besides, in all directions: all of it where a tip stands on the
    foot, and of a side the part of the foot that it covers [N]"""
    damping: float = 0.0
    """viscous resistance over its speed besides, in all directions, of limbs: of a tip and of a
    side as hold is [N s/m]"""
    drop: float = 0.0
    """height by which a point at an end stands proud of the underside [m]"""
    chamber: str | None = None
    """name of a chamber that switches it on: by its pressure over the peak it is between bare skin
    and foot; always on if not given"""

    @classmethod
    def check_keys(cls, keys: Collection[str], where: str = "") -> None:
        """Raise ValueError for the keys of a table that names nothing that a foot does."""
        does = [field.name for field in fields(cls) if field.name not in _PLACE]
        if not set(does) & set(keys):
            raise ValueError(
                f"{where}a foot must say what it does: give {', '.join(does[:-1])} or {does[-1]}, "
                f"got {', '.join(keys)} alone"
            )

    def __post_init__(self) -> None:
        in_si(self)
        for name in ("begin", "end"):
            value = getattr(self, name)
            if not (is_number(value) and 0 <= value <= 1):
                raise ValueError(f"{name} of a foot must lie in [0, 1], got {value!r}")
        if self.end < self.begin:
            raise ValueError(
                f"end of a foot must not lie before its begin {self.begin!r}, got {self.end!r}"
            )
        if self.begin == self.end and self.begin not in (0, 1):
            raise ValueError(
                "end of a foot must lie beyond its begin, but of a point at an end, 0 or 1; got "
                f"{self.end!r}"
            )
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name != "chamber" and value is not None:
                not_negative(f"{field.name} of a foot", value)
                object.__setattr__(self, field.name, float(value))

        if self.drop and self.begin != self.end:
            raise ValueError(
                "drop must be 0 for a foot with a length, got "
                f"{self.drop:g} m: points at an end, 0 or 1, alone stand proud"
            )

    @property
    def is_round(self) -> bool:
        """True if its grip is alike in all directions."""
        return {self.grip_back, self.grip_across} <= {None, self.grip}

    def grip_against(self, way: Way) -> float:
        """Grip against motion one way [1]."""
        return by_way(self.grip, self.grip_back, self.grip_across)[way]


def in_order(feet: Iterable[Foot | Mapping[str, Any]]) -> tuple[Foot, ...]:
    """Feet of a strip, left first; each may be a table of a foot's fields.

    Raises:
        ValueError: one is no foot, two of them overlap, or a point is at the end of another.
    """
    ordered = tuple(sorted(records(Foot, "foot", feet), key=lambda foot: (foot.begin, foot.end)))
    for foot, after in pairwise(ordered):
        point = foot.begin == foot.end or after.begin == after.end
        if after.begin < foot.end or (point and after.begin == foot.end):
            raise ValueError(
                f"feet must not overlap, got one from {foot.begin:g} to {foot.end:g} and one from "
                f"{after.begin:g} to {after.end:g}"
            )
    return ordered


def drops(feet: Sequence[Foot]) -> tuple[float, float]:
    """Heights by which feet lift the left and the right end of a strip [m]."""
    left, right = (
        max((foot.drop for foot in feet if foot.begin == end), default=0.0) for end in (0.0, 1.0)
    )
    return left, right


def proud(feet: Sequence[Foot]) -> bool:
    """Tell whether any foot stands proud of the underside."""
    return bool(feet) and any(drops(feet))


def refuse_proud(feet: Sequence[Foot], what: str) -> None:
    """Raise ValueError for feet that stand proud where undersides must be flat."""
    if proud(feet):
        raise ValueError(
            f"drop of a foot must be 0 for {what}, got {max(drops(feet)):g} m: feet that stand "
            "proud are of strips under constant bounds at all contacts, by elastica and MuJoCo"
        )


def refuse_damping(feet: Sequence[Foot]) -> None:
    """Raise ValueError for feet of a strip that resist viscously."""
    for foot in feet:
        if foot.damping:
            raise ValueError(
                f"damping of a foot must be 0 for a strip, got {foot.damping:g} N s/m: feet that "
                "resist viscously are of robots of limbs"
            )


def check_chambers(feet: Sequence[Foot], chambers: Sequence[str]) -> None:
    """Raise ValueError for feet that are switched by a chamber which the robot does not have."""
    for foot in feet:
        if foot.chamber is not None:
            one_of("chamber of a foot", foot.chamber, chambers)
