"""What the ends resist by, under the constant-bound law and under Coulomb's, and who slides.

The paper's (section 2.2): constant at a tip, by area on a side, whatever the load. Coulomb's: a
coefficient of friction of a tip or of a side, times the load.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic import pneunet
from analytic.robot import Robot

Array = NDArray[np.float64]

LAWS = ("constant", "coulomb")


@dataclass(frozen=True)
class Surface:
    """A ground as the pair {V_t, tau} of section 2.2, both in units of one force scale V0.

    Args:
        name: how commands and files call the surface.
        tip: V_t, sliding resistance of an end in point contact [V0].
        area: tau, sliding resistance of a side contact one segment long [V0]. The paper's area
            q lambda is thus normalised by q times a segment's length, so that its
            polyethylene (0.5, 1) has equal resistances where half a segment lies flat.

    Raises:
        ValueError: a resistance is negative or not finite.
    """

    name: str
    tip: float
    area: float

    def __post_init__(self) -> None:
        for key in ("tip", "area"):
            value = getattr(self, key)
            if not (math.isfinite(value) and value >= 0):
                raise ValueError(f"{key} must be a finite number, at least 0, got {value!r}")

    @property
    def tip_to_area_ratio(self) -> float:
        """V_t / (tau q L), the number that places a surface between gelatin (inf) and felt (0)."""
        return math.inf if self.area == 0 else self.tip / (3 * self.area)


@dataclass(frozen=True)
class Friction:
    """How the ends hold to a surface.

    Args:
        law: "constant", the paper's, or "coulomb".
        number: Phi = V0 L^2 / D0 [1], by which friction bends the strip; with 0 it decides who
            slides, but bends nothing, the limit of section 2.2. Under "coulomb" V0 is what an end
            resists by that carries half the weight, at a coefficient number of 1.
        slope: angle by which the ground rises towards +x [rad].

    Raises:
        ValueError: there is no such law, the number is negative or not finite, the slope is a right
            angle or more, or there is a slope and no friction number to stand on it by.
    """

    law: str = "constant"
    number: float = 0.0
    slope: float = 0.0

    def __post_init__(self) -> None:
        if self.law not in LAWS:
            raise ValueError(f"law must be one of {', '.join(LAWS)}; got {self.law!r}")
        if not (math.isfinite(self.number) and self.number >= 0):
            raise ValueError(f"number must be a finite number, at least 0, got {self.number!r}")
        if not abs(self.slope) < math.pi / 2:
            raise ValueError(f"slope must be less steep than a right angle, got {self.slope!r}")
        if self.slope and not self.number:
            raise ValueError(f"a slope of {self.slope:g} needs a number above 0 to stand on it by")

    def downhill(self, robot: Robot) -> float:
        """The weight's part along the slope, towards -x, in units of V0."""
        if not self.slope:
            return 0.0
        load = robot.weight_per_length * robot.length * math.sin(self.slope)
        return load * robot.length**2 / (self.number * pneunet.base_rigidity(robot))


SURFACES: dict[str, Surface] = {
    surface.name: surface
    for surface in (
        Surface("felt", tip=0.0, area=1.0),  # [Majidi13], section 2.2
        Surface("polyethylene", tip=0.5, area=1.0),  # [Majidi13], section 2.2
        Surface("gelatin", tip=1.0, area=0.0),  # [Majidi13], section 2.2
    )
}


def sliding_resistance(robot: Robot, surface: Surface, contact_length: ArrayLike) -> Array:
    """Greatest shear force that an end can carry, in units of V0: V_t or V_s = tau A.

    Args:
        contact_length: lambda, length of side contact at that end [m]; 0 is tip contact.

    Returns:
        Same shape as contact_length [V0].
    """
    length = np.asarray(contact_length, dtype=float)
    return np.where(length > 0, surface.area * length / robot.segment_length, surface.tip)


def coulomb_resistance(
    robot: Robot, surface: Surface, contacts: tuple[Array, Array], force: Array, height: Array
) -> tuple[Array, Array]:
    """Resistance mu N of the left and the right end, in units of V0 at half the weight.

    N is the ground's force on an end's part of the strip, either side of the highest node, and mu
    the surface's `tip` or `area` number, read as coefficients of friction of a tip and of a side.

    Args:
        robot, surface: the scene.
        contacts: lengths of side contact at the two ends, (B,) each [m].
        force: of the ground on each of S nodes, (B, S) [N].
        height: of each, (B, S) [m].

    Returns:
        Two arrays of shape (B,) [V0].
    """
    half_weight = 0.5 * robot.weight_per_length * robot.length
    first = np.arange(force.shape[1]) <= np.argmax(np.nan_to_num(height), axis=1)[:, None]
    loads = (np.where(side, force, 0.0).sum(axis=1) / half_weight for side in (first, ~first))
    left, right = (
        load * np.where(contact > 0, surface.area, surface.tip)
        for load, contact in zip(loads, contacts, strict=True)
    )
    # an end that carries less by rounding only is no weaker
    return left, np.where(np.isclose(left, right, rtol=1e-9, atol=0), left, right)


def left_slip_fraction(
    resistance_left: ArrayLike,
    resistance_right: ArrayLike,
    downhill: float = 0.0,
    growing: ArrayLike = True,
) -> Array:
    """Part of a change of separation that the left end takes up: 0, 1/2 or 1 (section 2.2).

    The end with the larger resistance stays anchored; where both resist alike, they share. On a
    slope the end that slides downhill has the weight's help: the left one where the separation
    grows, the right one where it shrinks.

    Args:
        resistance_left, resistance_right: of the ends [V0].
        downhill: the weight's part along the slope, towards -x [V0].
        growing: whether the separation grows.
    """
    left, right = np.asarray(resistance_left), np.asarray(resistance_right)
    if downhill:
        left = left + np.where(growing, 0.0, downhill)
        right = right + np.where(growing, downhill, 0.0)
    return np.where(left > right, 0.0, np.where(left < right, 1.0, 0.5))
