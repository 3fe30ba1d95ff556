"""The strip as a chain of rigid links: lengths, and joint springs from the pneu-net laws.

A strip of N links has N hinges. Hinge j stands for element j of N, so that the link after it has
the direction of the strip at the element's end exactly, and the first and last link have those of
the two ends: what decides between tip and side contact.

The lengths of the links are then the weights of a quadrature of (cos, sin) of that direction over
s. Equal links with half links at both ends are the trapezoidal rule, and shorten a circular arc's
chord by h^2 kappa^2 / 12 too much; Simpson's weights h/3, 4h/3, 2h/3, ..., h/3 place the hinges at
1/6 and 5/6 of each pair of elements and are exact to fourth order. Curvature jumps where segments
meet: so each segment has elements of its own length h, an even number of them.

In space a chain may twist too: by T lumps, each in the link in the middle of one of T equal parts.
A lump turns what follows its link about that link, just before the hinge there.
"""

from functools import cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from analytic.checks import one_of, whole
from analytic.scene import pneunet
from analytic.scene.payload import mass_moments, mass_on_nodes
from analytic.scene.robot import GRAVITY, Robot

Array = NDArray[np.float64]

_UNLIKE = 0.15  # by which the number of a segment's elements may be off; chosen
_FITS = 1e-9

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
    if not whole_elements(robot, links):
        raise ValueError(
            f"links must make every segment whole elements for sealed chambers, got {links}"
        )
    if robot.curvature_per_pressure or robot.rigidity_per_pressure or robot.actuator:
        raise ValueError(
            "sealed chambers must be given by chamber_height and chamber_fraction, "
            "not by curvature_per_pressure, rigidity_per_pressure or actuator"
        )


def link_lengths(robot: Robot, links: int) -> Array:
    """Lengths of the N + 1 rigid links of a strip, shape (N + 1,) [m]; they sum to its length."""
    weights = np.ones(links + 1)
    if segments_fit(robot, links / 2):
        weights[1:-1:2], weights[2:-1:2] = 4, 2
    elif _elements(robot.borders, links):  # each pair of elements is of one length
        pair = np.diff(element_edges(robot.borders, links)[::2])
        weights[0], weights[1::2], weights[-1] = pair[0], 4 * pair, pair[-1]
        weights[2:-1:2] = pair[:-1] + pair[1:]
    else:
        weights[1:-1] = 2
    return robot.length * weights / weights.sum()


def node_positions(robot: Robot, links: int) -> Array:
    """Arclength of the chain's vertices: left end, hinges, right end, shape (N + 2,) [m]."""
    return np.concatenate([[0.0], np.cumsum(link_lengths(robot, links))])


def payload_moments(robot: Robot, links: int) -> Array:
    """Mass of a strip's payloads in its links, see analytic.scene.payload, (N + 1, 3) [kg]."""
    return mass_moments(robot.carried, robot.length, node_positions(robot, links))


def payload_on_nodes(robot: Robot, links: int) -> Array:
    """Weight of a strip's payloads on the chain's vertices, (N + 2,) [N]."""
    return GRAVITY * mass_on_nodes(payload_moments(robot, links))


def segments_fit(robot: Robot, parts: float) -> bool:
    """Tell whether every segment ends where one of so many equal parts of the strip does."""
    at = np.array(robot.borders) * parts
    return bool(np.abs(at - np.round(at)).max() < 1e-9)


@cache
def _elements(borders: tuple[float, ...], links: int) -> tuple[int, ...]:
    """Even numbers of elements of segments; none if they would be far from their lengths.

    None too if segments of one length would have unlike numbers.
    """
    pairs = np.diff(borders) * (links / 2)
    counts = np.maximum(np.floor(pairs + _FITS), 1.0)
    for _ in range(len(pairs)):
        counts[np.argmax(pairs - counts)] += counts.sum() < links / 2
    alike = np.abs(counts / pairs - 1).max() <= _UNLIKE and counts.sum() == links / 2
    equal = np.abs(pairs[:, None] - pairs) < _FITS
    alike &= bool((counts[:, None] == counts)[equal].all())
    return tuple(2 * int(n) for n in counts) if alike else ()


@cache
def element_edges(borders: tuple[float, ...], links: int) -> Array:
    """Ends of the elements that hinges stand for, over the strip's length, (N + 1,), read-only.

    Elements of a segment are alike, an even number of them; where that would make those of two
    segments unlike, all elements are.
    """
    counts = _elements(borders, links)
    edges = np.linspace(0.0, 1.0, links + 1)
    if counts and np.abs(edges[np.cumsum(counts)] - borders[1:]).max() > _FITS:
        spans = zip(pairwise(borders), counts, strict=True)
        parts = [np.linspace(*span, count, endpoint=False) for span, count in spans]
        edges = np.append(np.concatenate(parts), 1.0)
    edges.flags.writeable = False
    return edges


def whole_elements(robot: Robot, links: int) -> bool:
    """Tell whether every hinge stands for an element of one segment."""
    return bool((segment_overlap(robot.borders, links).max(axis=1) == 1.0).all())


@cache
def segment_overlap(borders: tuple[float, ...], links: int) -> Array:
    """Part of each hinge's element that lies in each of S segments, shape (N, S); rows sum to 1.

    Computed once for each robot and N, and read-only.
    """
    overlap = overlaps(element_edges(borders, links), borders)
    overlap.flags.writeable = False
    return overlap


def overlaps(edges: Array, borders: tuple[float, ...]) -> Array:
    """Part of each element between edges (N + 1,) that lies in each of S segments, (N, S)."""
    border = np.array(borders)
    low = np.maximum(edges[:-1, None], border[None, :-1])
    high = np.minimum(edges[1:, None], border[None, 1:])
    overlap = np.maximum(high - low, 0.0) / np.diff(edges)[:, None]
    return np.asarray(np.round(overlap, 12))  # whole elements are whole


def twisting_links(links: int, twists: int) -> tuple[int, ...]:
    """Links in the middles of T equal parts of a chain, which twist, by their numbers from 0, (T,).

    Raises:
        ValueError: there are more than pairs of elements, so that two might be in one link.
    """
    whole("twists", twists, 0, links // 2)
    hinges = np.arange(links) + np.where(np.arange(links) % 2, 2 / 3, 1 / 3)  # in elements
    middles = links * (np.arange(twists) + 0.5) / max(twists, 1)
    return tuple(np.searchsorted(hinges, middles).tolist())


def joint_places(links: int, twists: int) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
    """Places of the hinges (N,) and of the twists (T,) among a chain's joints."""
    at = np.array(twisting_links(links, twists), dtype=int) + np.arange(twists)
    return np.delete(np.arange(links + twists), at), at


def torsion_stiffness(robot: Robot, twists: int) -> float:
    """Stiffness of each of T twists [N m/rad], each GJ over its part of the length."""
    return pneunet.torsional_rigidity(robot) * twists / robot.length


def element_lengths(robot: Robot, links: int) -> Array:
    """Lengths of the elements that hinges stand for, (N,) [m]."""
    if segments_fit(robot, links):
        return np.full(links, robot.length / links)
    return np.asarray(robot.length * np.diff(element_edges(robot.borders, links)))


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
    overlap = segment_overlap(robot.borders, links) * element_lengths(robot, links)[:, None]
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
    element = element_lengths(robot, links)
    curvature = -turn / element  # arching is positive
    moment = -pneunet.sealed_moment(robot, chambers, curvature)
    tangent = pneunet.sealed_rigidity(robot, chambers, curvature) / element
    return tangent, turn - moment / tangent
