"""Ground in SI units: the surface at a place, whatever walks there."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache
from typing import Any, Literal, Protocol

import numpy as np

from analytic.checks import file_word, not_negative, one_of
from analytic.fields import in_si

TIP_FORCE = 0.034  # V0 [N]; chosen: Phi = V0 L^2 / D0 = 1.5 on the default robot
Way = Literal["ahead", "back", "across"]
Frame = Literal["robot", "ground"]
FRAMES: tuple[Frame, ...] = ("robot", "ground")
REFERENCE_AREA = 0.040 * 0.130 / 3  # of one third of the default robot [m^2]
SHEAR_STRENGTH = TIP_FORCE / REFERENCE_AREA  # 19.6 Pa: half of it lies flat, half the tip force
FRICTION = 0.37  # chosen: a tip that carries half the default robot's weight resists by V0


@dataclass(frozen=True)
class Surface:
    """Uniform ground.

    Which of its numbers act is the friction law's matter, see analytic.friction.laws: constant
    bounds use tip_force and shear_strength, Coulomb friction the two coefficients.

    A number may be a text with its unit, as in tip_force="30 mN", and is in SI then. Bristles,
    scales and naps resist otherwise back (towards -x) and across than ahead: each of the four
    numbers may be a table of three, as in friction={"ahead": 0.2, "back": 0.3}, and is three fields
    then.

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
    tip_force_back: float | None = None
    """V_t against motion back, towards -x; as ahead if not given [N]"""
    tip_force_across: float | None = None
    """V_t against motion across; the mean of ahead and back if not given [N]"""
    shear_strength_back: float | None = None
    """tau against motion back; as ahead if not given [Pa]"""
    shear_strength_across: float | None = None
    """tau against motion across; the mean of ahead and back if not given [Pa]"""
    friction_back: float | None = None
    """coefficient of a side against motion back; as ahead if not given [1]"""
    friction_across: float | None = None
    """coefficient of a side against motion across; the mean of ahead and back if not given [1]"""
    tip_friction_back: float | None = None
    """coefficient of a tip against motion back; as ahead if not given [1]"""
    tip_friction_across: float | None = None
    """coefficient of a tip against motion across; the mean of ahead and back if not given [1]"""
    nap: Frame = "robot"
    """whose ahead it is: the robot's, as of bristles at its feet, or the ground's +x, as of a cloth
    that was brushed"""

    def __post_init__(self) -> None:
        file_word("name of a surface", self.name)
        self._take_tables()
        in_si(self)
        one_of("nap", self.nap, FRAMES)
        if self.tip_friction is None:
            for way in ("", "_back", "_across"):
                if getattr(self, f"tip_friction{way}") is None:
                    object.__setattr__(self, f"tip_friction{way}", getattr(self, f"friction{way}"))
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name not in ("name", "nap") and not (value is None and field.default is None):
                not_negative(field.name, value)
                object.__setattr__(self, field.name, float(value))
        if self.static_ratio < 1:
            raise ValueError(f"static_ratio must be at least 1, got {self.static_ratio!r}")
        if self.adhesion and not self.adhesion_reach:
            raise ValueError("adhesion_reach must be above 0 m where adhesion is, got 0.0")
        if self.static_ratio > 1 and not self.stribeck_speed:
            raise ValueError(
                "stribeck_speed must be above 0 m/s where static_ratio is above 1, got 0.0"
            )

    def _take_tables(self) -> None:
        """Spread numbers that are tables of three directions."""
        given = {name: getattr(self, name) for name in RESISTANCES}
        for name, value in spread(given).items():
            object.__setattr__(self, name, value)

    @cached_property  # asked at every step
    def is_round(self) -> bool:
        """True if it resists alike in all directions."""
        return all(
            getattr(self, f"{name}_{way}") in (None, getattr(self, name))
            for name in DIRECTED for way in ("back", "across")
        )  # fmt: skip

    @property
    def ahead_is_the_robots(self) -> bool:
        """True unless it has a nap of its own; of round ground, on which feet may have one."""
        return self.nap == "robot" or self.is_round

    def against(self, way: Way) -> "Surface":
        """The surface that resists in all directions as this one does against motion one way."""
        return _against(self, way)

    def resistance(self, name: str) -> float:
        """Value of one of RESISTANCES, also where another stands for it."""
        value = getattr(self, name)
        if value is None:
            base, _, way = name.rpartition("_")
            value = getattr(_against(self, "back" if way == "back" else "across"), base)
        return float(value)

    def at(self, x: float) -> "Surface":
        """Itself, as the surface at any place [m]."""
        return self

    @property
    def surfaces(self) -> tuple["Surface", ...]:
        """Itself, as the one surface of this ground."""
        return (self,)

    def scaled(self, factor: float) -> "Surface":
        """A surface so many times as resistant in every way."""
        given = {name: getattr(self, name) for name in RESISTANCES}
        return replace(self, **{k: factor * v for k, v in given.items() if v is not None})

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


DIRECTED = ("tip_force", "shear_strength", "friction", "tip_friction")
RESISTANCES = (
    *DIRECTED, "viscosity", *(f"{name}_{way}" for name in DIRECTED for way in ("back", "across")),
)  # fmt: skip


def spread(table: Mapping[str, Any], where: str = "") -> dict[str, Any]:
    """Fields of a surface, with three in place of one that is a table {ahead, back, across}.

    Args:
        table: of fields.
        where: it stands, before a message.

    Raises:
        ValueError: a table has other keys, or no `ahead`; or a field is given twice.
    """
    result = dict(table)
    for name, value in table.items():
        if name not in DIRECTED or not isinstance(value, Mapping):
            continue
        for way in value:
            one_of(f"{where}{name}: direction", way, ("ahead", "back", "across"))
        if "ahead" not in value:
            raise ValueError(
                f"{where}{name} must say how it resists motion ahead, got {dict(value)!r}"
            )
        for way, number in value.items():
            key = name if way == "ahead" else f"{name}_{way}"
            if key != name and table.get(key) is not None:
                raise ValueError(f"{where}{key} is given twice, got {table[key]!r} and {number!r}")
            result[key] = number
    return result


def without_ways(table: Mapping[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    """Fields of a surface but for ways that other ones, laid over them, give; see spread."""
    tables = [name for name in DIRECTED if isinstance(over.get(name), Mapping)]
    hidden = {f"{name}_{way}" for name in tables for way in ("back", "across")}
    result = {key: value for key, value in table.items() if key not in hidden}
    for name in DIRECTED:
        if isinstance(result.get(name), Mapping):
            ways = result[name].items()
            result[name] = {way: value for way, value in ways if f"{name}_{way}" not in over}
    return result


def by_way(ahead: float, back: float | None, across: float | None) -> dict[Way, float]:
    """Values against motion each way: back as ahead, across their mean, where they are None."""
    back = ahead if back is None else back
    across = 0.5 * (ahead + back) if across is None else across
    return {"ahead": ahead, "back": back, "across": across}


@lru_cache(maxsize=256)
def _against(surface: Surface, way: Way) -> Surface:
    """See Surface.against."""
    values: dict[str, float | None] = {}
    for name in DIRECTED:
        ahead, back, across = (getattr(surface, f"{name}{w}") for w in ("", "_back", "_across"))
        values[name] = by_way(ahead, back, across)[way]
        values |= {f"{name}_back": None, f"{name}_across": None}
    return replace(surface, **values)  # type: ignore[arg-type]


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
