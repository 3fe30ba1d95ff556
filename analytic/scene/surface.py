"""Ground in SI units: the surface at a place, whatever walks there."""

from dataclasses import dataclass, fields, replace
from typing import Any, Protocol

import numpy as np

from analytic.checks import file_word, not_negative
from analytic.fields import in_si

TIP_FORCE = 0.034  # V0 [N]; chosen: Phi = V0 L^2 / D0 = 1.5 on the default robot
REFERENCE_AREA = 0.040 * 0.130 / 3  # of one third of the default robot [m^2]
SHEAR_STRENGTH = TIP_FORCE / REFERENCE_AREA  # 19.6 Pa: half of it lies flat, half the tip force
FRICTION = 0.37  # chosen: a tip that carries half the default robot's weight resists by V0


@dataclass(frozen=True)
class Surface:
    """Uniform ground.

    Which of its numbers act is the friction law's matter, see analytic.friction.laws: constant
    bounds use tip_force and shear_strength, Coulomb friction the two coefficients.

    A number may be a text with its unit, as in tip_force="30 mN", and is in SI then.

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
    viscosity: float = 0.0
    """of a film under a side: resistance per area and speed, its viscosity over its thickness
    [Pa s/m]"""
    static_ratio: float = 1.0
    """friction at rest over that of fast sliding [1]"""
    stribeck_speed: float = 0.0
    """v_s, speed over which friction falls from the one to the other, as exp(-(v/v_s)^2) [m/s]"""
    adhesion: float = 0.0
    """work that peeling a side off takes per area [J/m^2]"""
    adhesion_reach: float = 1e-4
    """height up to which it pulls, with a constant force per area [m]; chosen"""

    def __post_init__(self) -> None:
        file_word("name of a surface", self.name)
        in_si(self)
        if self.tip_friction is None:
            object.__setattr__(self, "tip_friction", self.friction)
        for field in fields(self):
            if field.name != "name":
                not_negative(field.name, getattr(self, field.name))
                object.__setattr__(self, field.name, float(getattr(self, field.name)))
        if self.static_ratio < 1:
            raise ValueError(f"static_ratio must be at least 1, got {self.static_ratio!r}")
        if self.adhesion and not self.adhesion_reach:
            raise ValueError("adhesion_reach must be above 0 m where adhesion is, got 0.0")
        if self.static_ratio > 1 and not self.stribeck_speed:
            raise ValueError(
                "stribeck_speed must be above 0 m/s where static_ratio is above 1, got 0.0"
            )

    def at(self, x: float) -> "Surface":
        """Itself, as the surface at any place [m]."""
        return self

    @property
    def surfaces(self) -> tuple["Surface", ...]:
        """Itself, as the one surface of this ground."""
        return (self,)

    def scaled(self, factor: float) -> "Surface":
        """A surface so many times as resistant in every way."""
        return replace(self, **{name: factor * getattr(self, name) for name in RESISTANCES})

    @property
    def depends_on_speed(self) -> bool:
        """True if it resists differently at different speeds."""
        return self.viscosity > 0 or self.static_ratio > 1

    def at_speed(self, speed: Any) -> Any:
        """Dry friction at a speed [m/s] over that of fast sliding [1], a float or an array.

        The Stribeck curve of boundary lubrication: static_ratio at rest, 1 beyond stribeck_speed.
        """
        if self.static_ratio == 1:
            return 1.0 + 0.0 * speed
        return 1.0 + (self.static_ratio - 1.0) * np.exp(-((speed / self.stribeck_speed) ** 2))

    def press(self, width: float) -> float:
        """Force per length with which adhesion pulls a strip that is within its reach [N/m]."""
        return self.adhesion * width / self.adhesion_reach if self.adhesion else 0.0

    def drag(self, width: float, contact: Any) -> Any:
        """Viscous resistance of a side contact so long [m] over its speed [N s/m]; a tip has none.

        Newton's film: eta / d per area, lubrication theory of a thin layer that is sheared.
        """
        return self.viscosity * width * contact


RESISTANCES = ("tip_force", "shear_strength", "friction", "tip_friction", "viscosity")


class Ground(Protocol):
    """A field of surfaces along x."""

    @property
    def name(self) -> str:
        """Name in files and tables."""
        ...

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """All surfaces that can occur, which tell the laws and solvers that serve a ground.

        Of a field without steps, one of each kind: a wet one if it is wet anywhere, one that
        resists under the friction law.
        """
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
