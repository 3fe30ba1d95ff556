"""Ground in SI units: what resists at a place, whatever walks there."""

from dataclasses import dataclass, fields
from typing import Protocol

from analytic.checks import file_word, not_negative

TIP_FORCE = 0.034  # V0 [N]; chosen: Phi = V0 L^2 / D0 = 1.5 on the default robot
REFERENCE_AREA = 0.040 * 0.130 / 3  # of one third of the default robot [m^2]
SHEAR_STRENGTH = TIP_FORCE / REFERENCE_AREA  # 19.6 Pa: half of it lies flat, half the tip force
FRICTION = 0.37  # chosen: a tip that carries half the default robot's weight resists by V0


@dataclass(frozen=True)
class Surface:
    """Uniform ground.

    Which of its numbers act is the friction law's matter, see analytic.friction: constant bounds
    use tip_force and shear_strength, Coulomb friction the two coefficients.

    Raises:
        ValueError: a value is negative or not finite, or the name is no file name.
    """

    name: str = "custom"
    """how files and tables call it"""
    tip_force: float = 0.0
    """V_t, bound of the friction at an end in point contact [N] ([Majidi13], section 2.2)"""
    shear_strength: float = 0.0
    """tau, bound of the friction per area of side contact [Pa] ([Majidi13], section 2.2)"""
    friction: float = 0.0
    """coefficient of friction of a side contact [1]"""
    tip_friction: float | None = None
    """coefficient of friction of a tip [1]; that of a side if not given"""

    def __post_init__(self) -> None:
        file_word("name of a surface", self.name)
        if self.tip_friction is None:
            object.__setattr__(self, "tip_friction", self.friction)
        for field in fields(self):
            if field.name != "name":
                not_negative(field.name, getattr(self, field.name))
                object.__setattr__(self, field.name, float(getattr(self, field.name)))

    def at(self, x: float) -> "Surface":
        """What resists at a place: the same everywhere."""
        return self

    def scaled(self, factor: float) -> "Surface":
        """The same surface, so many times as resistant in every way."""
        return Surface(self.name, *(factor * getattr(self, item.name) for item in fields(self)[1:]))


class Ground(Protocol):
    """A field of surfaces along x.

    Attributes:
        name: how files and tables call it.
    """

    @property
    def name(self) -> str:
        """How files and tables call it."""
        ...

    def at(self, x: float) -> Surface:
        """The surface at a place [m]."""
        ...


def from_ratios(name: str, tip: float, side: float) -> Surface:
    """The surface {V_t, tau} of [Majidi13], section 2.2, in units of V0 and V0 over REFERENCE_AREA.

    Under Coulomb friction the two numbers scale FRICTION.
    """
    return Surface(name, tip * TIP_FORCE, side * SHEAR_STRENGTH, side * FRICTION, tip * FRICTION)


SURFACES: dict[str, Surface] = {
    surface.name: surface
    for surface in (
        from_ratios("felt", 0.0, 1.0),  # [Majidi13], section 2.2
        from_ratios("polyethylene", 0.5, 1.0),
        from_ratios("gelatin", 1.0, 0.0),
    )
}
