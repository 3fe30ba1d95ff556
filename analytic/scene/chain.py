"""The strip as a chain of rigid links: lengths, and joint springs from the pneu-net laws.

A strip of N links has N hinges. Hinge j stands for the element of arclength [j h, (j+1) h],
h = L/N, so that the link after it has the direction of the strip at s = (j+1) h exactly, and the
first and last link have those of the two ends: what decides between tip and side contact.

The lengths of the links are then the weights of a quadrature of (cos, sin) of that direction over
s. Equal links with half links at both ends are the trapezoidal rule, and shorten a circular arc's
chord by h^2 kappa^2 / 12 too much; Simpson's weights h/3, 4h/3, 2h/3, ..., h/3 place the hinges at
1/6 and 5/6 of each pair of elements and are exact to fourth order. They need segments of even
numbers of elements, since curvature jumps where segments meet.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from analytic.checks import one_of
from analytic.scene import pneunet
from analytic.scene.robot import Robot

Array = NDArray[np.float64]

# what the air in a chamber does as the strip bends: (9); closed valves, the exact (6); or constant
# pressure, which adds no stiffness, the moment D0 (k - alpha p) of (2) and (3)
CHAMBER_LAWS = ("linearized", "sealed", "constant-pressure")


def check_chamber(robot: Robot, links: int, chamber: str) -> None:
    """Check that a chain can bend by a chamber law.

    Raises:
        ValueError: there is no such law; sealed chambers are no whole elements, or not known by
            their geometry.
    """
    one_of("chamber", chamber, CHAMBER_LAWS)
    if chamber != "sealed":
        return
    if not segments_fit(robot, links):
        raise ValueError(
            f"links must make every segment whole elements for sealed chambers, got {links}"
        )
    if robot.curvature_per_pressure or robot.rigidity_per_pressure:
        raise ValueError(
            "sealed chambers must be given by chamber_height and chamber_fraction, "
            "not by curvature_per_pressure or rigidity_per_pressure"
        )


def link_lengths(robot: Robot, links: int) -> Array:
    """Lengths of the N + 1 rigid links of a strip, shape (N + 1,) [m]; they sum to its length."""
    weights = np.ones(links + 1)
    if segments_fit(robot, links / 2):
        weights[1:-1:2], weights[2:-1:2] = 4, 2
    else:
        weights[1:-1] = 2
    return robot.length * weights / weights.sum()


def node_positions(robot: Robot, links: int) -> Array:
    """Arclength of the chain's vertices: left end, hinges, right end, shape (N + 2,) [m]."""
    return np.concatenate([[0.0], np.cumsum(link_lengths(robot, links))])


def segments_fit(robot: Robot, parts: float) -> bool:
    """Tell whether every segment ends where one of so many equal parts of the strip does."""
    at = np.array(robot.borders) * parts
    return bool(np.abs(at - np.round(at)).max() < 1e-9)


@cache
def segment_overlap(borders: tuple[float, ...], links: int) -> Array:
    """Part of each hinge's element that lies in each of S segments, shape (N, S); rows sum to 1.

    Computed once for each robot and N, and read-only.
    """
    edge = np.linspace(0.0, 1.0, links + 1)
    border = np.array(borders)
    low = np.maximum(edge[:-1, None], border[None, :-1])
    high = np.minimum(edge[1:, None], border[None, 1:])
    overlap = np.maximum(high - low, 0.0) * links
    overlap = np.round(overlap, 12)  # whole elements are whole
    overlap.flags.writeable = False
    return overlap


def joint_springs(
    robot: Robot, links: int, pressures_pa: Array, chamber: str = "linearized"
) -> tuple[Array, Array]:
    """Hinge springs at segment pressures of shape (T, S) [Pa].

    An element across a border is its parts in series: they carry one moment, so their compliances
    and their natural angles add.

    Args:
        robot, links: the chain.
        pressures_pa: of the segments.
        chamber: "linearized" or "constant-pressure"; for "sealed" see `sealed_springs`.

    Returns:
        stiffness (T, N) [N m/rad] and rest angle (T, N) [rad], negative where the strip arches.
    """
    overlap = segment_overlap(robot.borders, links) * (robot.length / links)
    stiffening = 0.0 if chamber == "constant-pressure" else 1.0
    compliance = (1.0 / pneunet.rigidity(robot, stiffening * pressures_pa)) @ overlap.T
    angle = pneunet.natural_curvature(robot, pressures_pa) @ overlap.T
    return 1.0 / compliance, -angle


def sealed_springs(
    robot: Robot, links: int, pressures_pa: Array, turn: Array
) -> tuple[Array, Array]:
    """Tangents to the moment of sealed chambers (6) where the hinges turn by `turn`.

    Segments must be whole elements.

    Args:
        robot, links: the chain.
        pressures_pa: at which the valves closed, of the segments, (S,) [Pa].
        turn: angles of the hinges, (N,) [rad].

    Returns:
        stiffness (N,) [N m/rad] and rest angle (N,) [rad] of springs that are alike to first order.
    """
    chambers = segment_overlap(robot.borders, links) @ pressures_pa
    element = robot.length / links
    curvature = -turn / element  # arching is positive
    moment = -pneunet.sealed_moment(robot, chambers, curvature)
    tangent = pneunet.sealed_rigidity(robot, chambers, curvature) / element
    return tangent, turn - moment / tangent
