"""Limbs on the ground as the search for their contacts sees them."""

from typing import NamedTuple

import numpy as np

from analytic.friction.contact_length import ripple as strip_ripple
from analytic.scene.limbs import Limb, LimbedRobot
from analytic.scene.robot import Robot


class LimbAtRest(NamedTuple):
    """A limb as the search for its contacts needs it.

    Attributes:
        strip: its geometry and weight.
        arclength: of its vertices [m].
        carrier, at: place of the limb that carries it, None for the trunk, and its end there.
        share: part of the width of all limbs that begin at the same place.
        free: ends that no limb begins at and that no limb carries.
        near: distance from an end that counts as there [m].
        ripple: height below which a vertex is on the ground [m].
        weight: that presses a flat stretch to the ground, with adhesion [N/m].
    """

    strip: Robot
    arclength: list[float]
    carrier: int | None
    at: str
    share: float
    free: tuple[str, ...]
    near: float
    ripple: float
    weight: float


class ContactState(NamedTuple):
    """Forces [N] and heights [m] of each limb's vertices, whether its ends may lie flat or curl up.

    Noted during the search: forces that limbs which lie flat pass on to ends of carriers, and ends
    of carriers where a limb is flat, or nearly.
    """

    force: list[list[float]]
    height: list[list[float]]
    may_lie: list[dict[str, bool]]
    curls: list[dict[str, bool]]
    passed: dict[tuple[int, str], float]
    reached: set[tuple[int, str]]


def free_ends(robot: LimbedRobot, limb: Limb) -> tuple[str, ...]:
    """Ends of a limb that no other limb is attached to."""
    taken = {carried.at for carried in robot.limbs if carried.on == limb.name}
    ends = ("begin", "end") if limb.on is None else ("end",)
    return tuple(end for end in ends if end not in taken)


def ripple(strip: Robot, elements: int) -> float:
    """Height to which a limb that lies flat ripples between its nodes [m]."""
    # wider links are four thirds of an element
    return 4 * strip_ripple(strip, np.array([0.0, strip.length / elements]))
