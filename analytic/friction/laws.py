"""Friction laws: the bounds of contacts, and which end slides ([Majidi13], section 2.2).

Each rule serves floats and arrays alike, so that theory and simulation share it.
"""

import math
from dataclasses import dataclass
from typing import Any, Literal, Protocol

from analytic.checks import not_negative, one_of, slope
from analytic.registry import Registry
from analytic.scene.robot import Robot
from analytic.scene.surface import Surface

ROUGHNESS = 1e-7  # m; of silicone that is cast in a polished mould; chosen

Number = Any  # a float or an array of floats


class TractionLaw(Protocol):
    """Rule of how strongly a contact resists sliding.

    Attributes:
        name: how commands and files call it.
        needs_load: whether the bound depends on the normal force.
    """

    name: str
    needs_load: bool

    def bound(self, surface: Surface, width: float, contact: Number, load: Number) -> Number:
        """Greatest friction of an end [N].

        Args:
            surface: under it.
            width: of the strip [m].
            contact: length of side contact, 0 for a tip [m].
            load: normal force on the end's part of the strip [N].
        """
        ...

    def acts_on(self, surface: Surface) -> bool:
        """Tell whether any contact resists at all."""
        ...


class ConstantBounds:
    """Constant at a tip, by area on a side, whatever the load ([Majidi13], section 2.2)."""

    name, needs_load = "constant", False

    def bound(self, surface: Surface, width: float, contact: Number, load: Number) -> Number:
        """V_t or tau q lambda, see TractionLaw.bound."""
        on_side = 1.0 * (contact > 0)
        side = surface.shear_strength * (width * contact)
        return on_side * side + (1.0 - on_side) * surface.tip_force

    def acts_on(self, surface: Surface) -> bool:
        """See TractionLaw.acts_on."""
        return surface.tip_force > 0 or surface.shear_strength > 0


class Coulomb:
    """A coefficient of friction of a tip or of a side, times the load."""

    name, needs_load = "coulomb", True

    def bound(self, surface: Surface, width: float, contact: Number, load: Number) -> Number:
        """The coefficient times the load, see TractionLaw.bound."""
        on_side = 1.0 * (contact > 0)
        return load * (on_side * surface.friction + (1.0 - on_side) * surface.tip_friction)

    def acts_on(self, surface: Surface) -> bool:
        """See TractionLaw.acts_on."""
        return surface.friction > 0 or bool(surface.tip_friction)


LAWS: Registry[TractionLaw] = Registry(
    "undulator.laws",
    {law.name: f"{__name__}:{law.__name__}" for law in (ConstantBounds, Coulomb)},
)


def register(law: TractionLaw) -> None:
    """Make a law known by its name to theory and simulation."""
    LAWS[law.name] = law


@dataclass(frozen=True)
class Friction:
    """Friction between a robot and the ground, as quasi-static theory takes it.

    Args:
        law: a name of LAWS.
        tension: part of the friction that bends the strip [1]: 1 all of it; 0 none, the limit of
            friction weak beside stiffness ([Majidi13], section 2.2), where it only decides which
            contact slides.
        slope: angle by which the ground rises towards +x [rad].
        contacts: where friction acts: at the two "ends", as in [Majidi13], or at "all" places where
            the strip touches the ground, which is more between the ends of a long robot.
        roughness: of skin and ground: gaps that are not higher count as closed where friction acts
            at all places; without any an arch of a nanometre would make a tip of a side [m].

    Raises:
        ValueError: there is no such law, tension is not in [0, 1], the slope is a right angle or
            more, there is a slope and no tension that keeps the robot on it, or roughness is
            negative.
    """

    law: str = "constant"
    tension: float = 0.0
    slope: float = 0.0
    contacts: Literal["ends", "all"] = "ends"
    roughness: float = ROUGHNESS

    def __post_init__(self) -> None:
        one_of("law", self.law, LAWS)
        if not 0 <= self.tension <= 1:
            raise ValueError(f"tension must lie in [0, 1], got {self.tension!r}")
        slope(self.slope)
        one_of("contacts", self.contacts, ("ends", "all"))
        not_negative("roughness", self.roughness)
        if self.slope and not self.tension:
            raise ValueError("on a slope friction must bend the strip: tension must be above 0")

    def downhill(self, robot: Robot) -> float:
        """The weight's part along the slope, towards -x [N]."""
        return robot.weight * math.sin(self.slope) if self.slope else 0.0


def bounds_both_ways(
    law: TractionLaw, surface: Surface, width: float, contact: Number, load: Number
) -> tuple[Number, Number]:
    """Greatest friction against motion ahead and against motion back [N]; see TractionLaw.bound."""
    if surface.is_round:
        bound = law.bound(surface, width, contact, load)
        return bound, bound
    ahead, back = (
        law.bound(surface.against(way), width, contact, load) for way in ("ahead", "back")
    )
    return ahead, back


def slip_fraction(
    left: Number, right: Number, downhill: float = 0.0, growing: Number = True, near: float = 0.0
) -> Number:
    """Part of a change of separation that the left end takes up: 0, 1/2 or 1 (section 2.2).

    The end with the larger bound stays anchored; where both are alike, both slide alike. Where the
    separation grows the left end would slide back and the right one ahead, where it shrinks the
    other way round: the bounds are those against these motions. On a slope the end that slides
    downhill has the weight's help: the left one where the separation grows, the right one where it
    shrinks.

    Args:
        left, right: bounds of the ends, each against the way that it would slide [N].
        downhill: the weight's part along the slope, towards -x [N].
        growing: whether the separation grows.
        near: difference of bounds that is none [N].
    """
    if downhill:
        left = left + (1.0 - 1.0 * growing) * downhill
        right = right + (1.0 * growing) * downhill
    return 0.5 + 0.5 * (1.0 * (right - left > near) - 1.0 * (left - right > near))


def neutral_ratio(surface: Surface, robot: Robot) -> float:
    """V_t / (tau q L), which places a surface between felt (0) and gelatin (inf) [1]."""
    side = surface.shear_strength * robot.width * robot.length
    return math.inf if side == 0 else surface.tip_force / side


def friction_number(surface: Surface, robot: Robot, rigidity: float) -> float:
    """Phi = V L^2 / D0 of the strongest bound an end can have [1]; see [Majidi13], section 2.2.

    Args:
        surface, robot: the scene.
        rigidity: D0 [N m^2].
    """
    area = robot.width * robot.length / len(robot.segments)
    strongest = max(
        max(round_.tip_force, round_.shear_strength * area)
        for round_ in (surface.against("ahead"), surface.against("back"))
    )
    return strongest * robot.length**2 / rigidity
