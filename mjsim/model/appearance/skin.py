"""A smooth skin over the chain: a soft strip with the ribs of its pneu-net chambers."""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import link_lengths, node_positions
from analytic.scene.payload import place_on_link
from analytic.scene.robot import Robot
from mjsim.model.bodies.parts import ORIGIN, PALE, PREFIX
from mjsim.scene import Resolved

Array = NDArray[np.float64]

PALE_SKIN = (*PALE, 1.0)
CELLS = 6  # pneu-net chambers drawn per segment; chosen, the theory needs only their fraction
PER_CELL = 8  # stations along a cell
_CORNER = 5  # points round each upper corner
_POINT = 0.04  # of the length, of a foot or a payload that is a point; chosen
_RUST = (0.60, 0.28, 0.12, 1.0)  # colour of feet, unlike any pressure's
_STEEL = (0.45, 0.50, 0.58, 1.0)  # and of payloads
_RIM, _WIDER = 0.5, 1.04  # of feet, over the layer's thickness and width; chosen
_HIGH = 0.15  # of payloads, over the width; chosen
_TUBE, _TALL = 0.04, 0.4  # of tethers: radius and half of the height drawn, over the width; chosen


class Skin(NamedTuple):
    """Skin of one segment, in the frame of the flat strip (x along it, z up, left end at 0).

    Attributes:
        vertex: shape (V, 3) [m].
        face: counter-clockwise seen from outside, shape (F, 3).
        bones: for each link that moves a vertex, (link, vertex indices, weights).
    """

    vertex: Array
    face: NDArray[np.int_]
    bones: list[tuple[int, NDArray[np.int_], Array]]


def add_skins(spec: mujoco.MjSpec, robot: Robot, numerics: Resolved) -> None:
    """Give a planar strip on its ground one skin per segment."""
    names = [f"segment_{number + 1}" for number in range(len(robot.segments))]
    add_strip_skins(spec, robot, numerics, names, f"{PREFIX}link_")


def add_strip_skins(
    spec: mujoco.MjSpec, strip: Robot, numerics: Resolved, names: Sequence[str], bodies: str,
    origin: Sequence[float] = ORIGIN, angle: float = 0.0, per_cell: int = PER_CELL,
) -> None:  # fmt: skip
    """Give a flat strip its skins.

    Args:
        spec: the robot on its ground.
        strip, numerics: its shape, and its links.
        names: of the skins, one per segment.
        bodies: names of the links before their numbers.
        origin: of its left end in the world, (3,) [m].
        angle: from the world's x to it, about z [rad].
        per_cell: stations along a cell of it.
    """
    c, s = np.cos(angle), np.sin(angle)
    turned = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    starts = node_positions(strip, numerics.links)
    half = (np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2))
    for segment, name in enumerate(names):
        shape = segment_skin(strip, numerics.links, segment, numerics.pad_radius, per_cell)
        skin = spec.add_skin(name=name, rgba=PALE_SKIN)
        skin.vert, skin.face = (shape.vertex @ turned.T + origin).ravel(), shape.face.ravel()
        skin.bodyname = [f"{bodies}{link}" for link, _, _ in shape.bones]
        skin.bindpos = np.ravel(
            [turned @ (starts[link], 0.0, 0.0) + origin for link, _, _ in shape.bones]
        )
        skin.bindquat = np.ravel([half] * len(shape.bones))
        skin.vertid = [moved.tolist() for _, moved, _ in shape.bones]
        skin.vertweight = [weight.tolist() for _, _, weight in shape.bones]
    for foot in strip.feet:
        heights = -numerics.pad_radius - foot.drop, _RIM * strip.thickness
        _add_blocks(spec, strip, starts.tolist(), bodies, (foot.begin, foot.end), heights, _RUST)
    top = strip.flat_height
    for payload in strip.payload:
        heights = top, top + _HIGH * strip.width
        _add_blocks(spec, strip, starts.tolist(), bodies, payload.stretch, heights, _STEEL)
    if strip.tether:
        link, part = place_on_link(starts, strip.tether.at * strip.length)
        tube = spec.body(f"{bodies}{link}").add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER)
        tall = _TALL * strip.width
        tube.pos = (part * float(starts[link + 1] - starts[link]), 0.0, top + tall)
        tube.size[:2] = _TUBE * strip.width, tall
        tube.contype = tube.conaffinity = 0
        tube.mass, tube.rgba = 0.0, _STEEL


def _add_blocks(
    spec: mujoco.MjSpec, strip: Robot, starts: list[float], bodies: str,
    stretch: tuple[float, float], heights: tuple[float, float], colour: Sequence[float],
) -> None:  # fmt: skip
    """Draw a foot or a payload as a block on every link that it is on; points a little longer.

    Args:
        spec, strip, bodies: see add_strip_skins.
        starts: arclength of the links' ends, from the left, (N + 2,) [m].
        stretch: where it begins and ends, over the length [1].
        heights: of its lower and upper side over the neutral line [m].
        colour: of it.
    """
    begin, end = (part * strip.length for part in stretch)
    if begin == end:
        half = 0.5 * _POINT * strip.length
        begin, end = begin - half, end + half
    for link, (start, stop) in enumerate(pairwise(starts)):
        near, far = max(begin, start), min(end, stop)
        if far <= near:
            continue
        block = spec.body(f"{bodies}{link}").add_geom(type=mujoco.mjtGeom.mjGEOM_BOX)
        low, high = heights
        block.pos = (0.5 * (near + far) - start, 0.0, 0.5 * (low + high))
        block.size = (0.5 * (far - near), _WIDER * 0.5 * strip.width, 0.5 * (high - low))
        block.contype = block.conaffinity = 0
        block.mass, block.rgba = 0.0, colour


def segment_skin(
    robot: Robot, links: int, segment: int, below: float, per_cell: int = PER_CELL
) -> Skin:
    """Skin of a segment (0 is the left one) whose underside lies `below` the neutral line [m]."""
    count = CELLS * per_cell + 1
    begin, end = (robot.length * border for border in robot.borders[segment : segment + 2])
    s = np.linspace(begin, end, count)
    rib = np.cos(2 * np.pi * CELLS * (s - begin) / (end - begin))
    # chambers take the fraction c/x of the length; the walls between them are narrow grooves
    groove = np.clip((rib - np.cos(np.pi * (1 - robot.chamber_fraction))) * 3, 0, 1)
    top = robot.thickness + robot.chamber_height * (1 - 0.35 * groove)
    outline = np.stack([_cross_section(robot.width, -below, height) for height in top])
    around = outline.shape[1]
    vertex = np.empty((count * around + 2, 3))
    vertex[:-2, 0] = np.repeat(s, around)
    vertex[:-2, 1:] = outline.reshape(-1, 2)
    vertex[-2] = (s[0], 0.0, 0.5 * (top[0] - below))
    vertex[-1] = (s[-1], 0.0, 0.5 * (top[-1] - below))
    return Skin(vertex, _faces(count, around), _bones(robot, links, vertex[:, 0]))


def _cross_section(width: float, low: float, high: float) -> Array:
    """Closed outline in (y, z), clockwise seen along +x, flat below and rounded above."""
    radius = 0.6 * (high - low)
    turn = np.linspace(0.0, 0.5 * np.pi, _CORNER)
    right = np.stack([0.5 * width - radius * (1 - np.cos(turn)),
                      high - radius * (1 - np.sin(turn))], axis=1)  # fmt: skip
    left = right[::-1] * (-1, 1)
    under = np.linspace(-0.5 * width, 0.5 * width, 5)
    bottom = np.stack([under, np.full_like(under, low)], axis=1)
    return np.concatenate([right, left, bottom])


def _faces(count: int, around: int) -> NDArray[np.int_]:
    i, j = np.meshgrid(np.arange(count - 1), np.arange(around), indexing="ij")
    a = (i * around + j).ravel()
    b = (i * around + (j + 1) % around).ravel()
    c, d = a + around, b + around
    wall = np.concatenate([np.stack([a, b, c], axis=1), np.stack([b, d, c], axis=1)])
    ring = np.arange(around)
    following = (ring + 1) % around
    near, far = count * around, count * around + 1
    last_ring = (count - 1) * around
    caps = [
        np.stack([np.full(around, near), following, ring], axis=1),
        np.stack([np.full(around, far), last_ring + ring, last_ring + following], axis=1),
    ]
    return np.concatenate([wall, *caps])


def _bones(robot: Robot, links: int, x: Array) -> list[tuple[int, NDArray[np.int_], Array]]:
    """Blend each vertex between the two links whose centres enclose it."""
    nodes = node_positions(robot, links)
    centre = nodes[:-1] + 0.5 * link_lengths(robot, links)
    after = np.clip(np.searchsorted(centre, x), 1, links)
    weight = np.clip((x - centre[after - 1]) / (centre[after] - centre[after - 1]), 0.0, 1.0)
    bones = []
    for link in range(links + 1):
        share = np.where(after == link, weight, 0.0) + np.where(after == link + 1, 1 - weight, 0.0)
        moved = np.flatnonzero(share > 0)
        if len(moved):
            bones.append((link, moved, share[moved]))
    return bones
