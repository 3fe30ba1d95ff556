"""The strip as a chain of rigid links: lengths, and joint springs from the pneu-net laws.

A strip of N links has N hinges. Hinge j stands for the element of arclength [j h, (j+1) h],
h = L/N, so that the link after it has the direction of the strip at s = (j+1) h exactly, and the
first and last link have those of the two ends: what decides between tip and side contact.

The lengths of the links are then the weights of a quadrature of (cos, sin) of that direction over
s. Equal links with half links at both ends are the trapezoidal rule, and shorten a circular arc's
chord by h^2 kappa^2 / 12 too much; Simpson's weights h/3, 4h/3, 2h/3, ..., h/3 place the hinges at
1/6 and 5/6 of each pair of elements and are exact to fourth order. They need an even number of
elements in each segment, since curvature jumps where segments meet.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from analytic import pneunet
from analytic.robot import SEGMENTS, Robot

Array = NDArray[np.float64]


def link_lengths(length: float, links: int) -> Array:
    """Lengths of the N + 1 rigid links of a strip, shape (N + 1,) [m]; they sum to length."""
    weights = np.ones(links + 1)
    if links % (2 * SEGMENTS) == 0:
        weights[1:-1:2], weights[2:-1:2] = 4, 2
    else:
        weights[1:-1] = 2
    return length * weights / weights.sum()


def node_positions(length: float, links: int) -> Array:
    """Arclength of the chain's vertices: left end, hinges, right end, shape (N + 2,) [m]."""
    return np.concatenate([[0.0], np.cumsum(link_lengths(length, links))])


@cache
def segment_shares(links: int) -> Array:
    """Part of each hinge's element that lies in each segment, shape (N, 3); rows sum to 1.

    Computed once for each N, and read-only.
    """
    edge = np.linspace(0.0, 1.0, links + 1)
    border = np.linspace(0.0, 1.0, SEGMENTS + 1)
    low = np.maximum(edge[:-1, None], border[None, :-1])
    high = np.minimum(edge[1:, None], border[None, 1:])
    shares = np.maximum(high - low, 0.0) * links
    shares.flags.writeable = False
    return shares


def joint_springs(robot: Robot, links: int, pressures_pa: Array) -> tuple[Array, Array]:
    """Hinge springs at segment pressures of shape (T, 3) [Pa].

    An element across a border is its parts in series: they carry one moment, so their compliances
    and their natural angles add.

    Returns:
        stiffness (T, N) [N m/rad] and rest angle (T, N) [rad], negative where the strip arches.
    """
    shares = segment_shares(links) * (robot.length / links)
    compliance = (1.0 / pneunet.rigidity(robot, pressures_pa)) @ shares.T
    angle = pneunet.natural_curvature(robot, pressures_pa) @ shares.T
    return 1.0 / compliance, -angle
