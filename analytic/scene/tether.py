"""Tether: a tube or cable that a strip or limb drags along."""

from dataclasses import dataclass, fields

from analytic.checks import is_number, not_negative
from analytic.fields import in_si


@dataclass(frozen=True)
class Tether:
    """Tube or cable that is attached to the middle line of a strip or limb.

    It resists motion of the place where it is attached by a constant force, as what lies on the
    ground does, and pulls back to where the robot started, as what hangs above it does: a tube of
    length l under a tension T by T / l.

    A number may be a text with its unit, as in drag="5 mN", and is in SI then.

    Raises:
        ValueError: a value is negative or not finite, or it does nothing.
    """

    at: float
    """where it is attached, over the length of the strip from its left, or of the limb from where
    that begins [1]"""
    drag: float = 0.0
    """force against any motion of that place, whatever the robot does [N]"""
    stiffness: float = 0.0
    """of the spring that pulls that place back along x to where the robot started [N/m]"""
    mass: float = 0.0
    """that the robot carries of it: half of what hangs between robot and support [kg]"""

    def __post_init__(self) -> None:
        in_si(self)
        if not (is_number(self.at) and 0 <= self.at <= 1):
            raise ValueError(f"at of a tether must lie in [0, 1], got {self.at!r}")
        for field in fields(self):
            value = getattr(self, field.name)
            not_negative(f"{field.name} of a tether", value)
            object.__setattr__(self, field.name, float(value))
        if not (self.drag or self.stiffness or self.mass):
            raise ValueError("a tether must have drag, stiffness or mass, got none of them")

    @property
    def resists(self) -> bool:
        """True if it does more than to weigh on the robot."""
        return bool(self.drag or self.stiffness)
