"""One limb as the search for its contacts needs it, see analytic.solvers.limbs.contact_search."""

from typing import NamedTuple

import numpy as np

from analytic.friction.contact_length import ripple as strip_ripple
from analytic.friction.flat_load import FlatLoad
from analytic.scene.limbs import Limb, LimbedRobot
from analytic.scene.robot import Robot
from analytic.solvers.limbs.kinematics import Tree

# of the width of a side, or of a tip: they resist turning as a line across does
ASIDE = (-0.25, 0.25)
_NEAR = 2  # elements from an end that count as there


class RestingLimb(NamedTuple):
    """A limb as the search for its contacts needs it.

    Attributes:
        length, width: of it [m].
        arclength, from_end: of its vertices, and how far they are from its end, that first [m].
        carrier, at: place of the limb that carries it, None for the trunk, and its end there.
        share: part of the width of all limbs that begin at the same place.
        free: ends that no limb begins at and that no limb carries.
        near: distance from an end that counts as there [m].
        ripple: height below which a vertex is on the ground [m].
        load: that presses a flat stretch on the ground, with adhesion.
        segments: how many it has.
        aside: how far to the left of its middle line a tip resists [m].
    """

    length: float
    width: float
    arclength: list[float]
    from_end: list[float]
    carrier: int | None
    at: str
    share: float
    free: tuple[str, ...]
    near: float
    ripple: float
    load: FlatLoad
    segments: int
    aside: tuple[float, ...]


def resting_limbs(tree: Tree) -> list[RestingLimb]:
    """The limbs of a tree, in its order."""
    robot = tree.robot
    widths: dict[tuple[str | None, str], float] = {}  # of all limbs that begin at one place
    for limb in robot.limbs:
        widths[limb.on, limb.at] = widths.get((limb.on, limb.at), 0.0) + limb.strip.width
    return [
        RestingLimb(
            limb.strip.length,
            limb.strip.width,
            tree.arclength[vertices].tolist(),
            (limb.strip.length - tree.arclength[vertices][::-1]).tolist(),
            None if limb.on is None else robot.place(limb.on),
            limb.at,
            limb.strip.width / widths[limb.on, limb.at],
            _free_ends(robot, limb),
            _NEAR * limb.strip.length / tree.elements,
            ripple(limb.strip, tree.elements),
            FlatLoad(limb.strip, press, tree.incline.normal),
            len(limb.strip.segments),
            tuple(limb.strip.width * part for part in ASIDE),
        )
        for limb, vertices, press in zip(
            robot.limbs, tree.vertices, tree.press.tolist(), strict=True
        )
    ]


def _free_ends(robot: LimbedRobot, limb: Limb) -> tuple[str, ...]:
    """Ends of a limb that no other limb is attached to."""
    taken = {carried.at for carried in robot.limbs if carried.on == limb.name}
    ends = ("begin", "end") if limb.on is None else ("end",)
    return tuple(end for end in ends if end not in taken)


def ripple(strip: Robot, elements: int) -> float:
    """Height to which a limb that lies flat ripples between its nodes [m]."""
    # wider links are four thirds of an element
    return 4 * strip_ripple(strip, np.array([0.0, strip.length / elements]))
