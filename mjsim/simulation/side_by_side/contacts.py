"""Contacts of many strips at once, and the friction at all of them.

As `analytic.friction.contacts.ContactFinder`, `analytic.friction.dissipation.minimisers` and
`mjsim.friction.between_ends` do it, with arrays over the scenes, of which R are stepped, with K
contacts at most, on N nodes.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import ripple
from analytic.friction.contacts import POINT
from analytic.friction.dissipation import ALIKE
from analytic.friction.flat_load import flat_length
from analytic.scene.chain import node_positions
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]
Indices = NDArray[np.int_]
Flags = NDArray[np.bool_]


class ContactRows(NamedTuple):
    """Contacts of strips, left first; see analytic.friction.contacts.StripContact.

    Attributes:
        there: whether a strip has so many, (R, K).
        node: that moves with each, (R, K).
        length: of side contact, (R, K) [m].
    """

    there: Flags
    node: Indices
    length: Array


class StripRows(NamedTuple):
    """Strips whose contacts are looked for.

    Attributes:
        place: arclengths of their nodes, (R, N) [m].
        weight: per length, (R,) [N/m].
        roughness, lifted: heights from which there is a gap, and an end curls up, (R,) [m].
    """

    place: Array
    weight: Array
    roughness: Array
    lifted: Array


def strip_rows(scenes: Sequence[Scene], numerics: Resolved) -> StripRows:
    """The strips of scenes."""
    robots = [scene.strip for scene in scenes]
    places = [node_positions(robot, numerics.links) for robot in robots]
    lifted = [ripple(robot, place) for robot, place in zip(robots, places, strict=True)]
    return StripRows(
        np.array(places), np.array([robot.weight_per_length for robot in robots]),
        np.array([scene.roughness for scene in scenes]), np.array(lifted),
    )  # fmt: skip


def find(strips: StripRows, force: Array, height: Array, lengths: Array) -> ContactRows:
    """The contacts of one state of each strip; see ContactFinder.find.

    Args:
        strips: whose they are.
        force: of the ground on the nodes, (R, N) [N].
        height: of the nodes, (R, N) [m].
        lengths: of side contact of the two ends, (R, 2) [m].
    """
    place, count = strips.place, force.shape[1]
    member, many, whole = _runs(force > 0, height > strips.roughness[:, None])
    k = np.arange(member.shape[1])
    push = np.where(member, force[:, None], 0.0)
    load = push.sum(-1)
    heavy, weight = np.where(load > 0, load, 1.0), strips.weight[:, None]
    first = member.argmax(-1)
    last = count - 1 - member[..., ::-1].argmax(-1)

    end = np.where(k, count - 1, 0)  # of a strip that the outermost runs may be
    outermost = (k == 0) | (k == many[:, None] - 1)
    at_end = outermost & (height[:, end] <= strips.lifted[:, None])
    given = lengths[:, np.where(k, 1, 0)]
    moment = (push * np.abs(place[:, None] - place[:, end][..., None])).sum(-1)
    side = np.where(
        (given > 0) | (member.sum(-1) > POINT), flat_length(weight, load, moment), given
    )
    side = np.where(whole[:, None], np.where(given > 0, given, 0.5 * place[:, -1:]), side)

    ends = np.take_along_axis(place, first, 1), np.take_along_axis(place, last, 1)
    reach = place[:, None] - 0.5 * (ends[0] + ends[1])[..., None]
    between = np.zeros(load.shape)
    for sign in (-1.0, 1.0):
        half = np.where(reach == 0, 0.5 * push, push * (sign * reach > 0))
        between += flat_length(weight, half.sum(-1), (half * sign * reach).sum(-1))
    between = np.where(last - first < POINT, 0.0, between)

    nodes = np.arange(count)
    middle = (push * nodes).sum(-1) / heavy
    nearest = np.where(member, np.abs(nodes - middle[..., None]), np.inf).argmin(-1)
    return ContactRows(
        k < many[:, None], np.where(at_end, end, nearest), np.where(at_end, side, between)
    )


def _runs(pushing: Flags, high: Flags) -> tuple[Flags, Indices, Flags]:
    """Runs of nodes that push with no gap between them, (R, K, N), and how many there are, (R,).

    Of strips that lie flat as a whole, which the last array tells, their halves.
    """
    gaps = np.cumsum(high & ~pushing, axis=1)
    before = np.maximum.accumulate(np.where(pushing, gaps, -1), axis=1)
    begins = pushing & (gaps != np.pad(before, ((0, 0), (1, 0)), constant_values=-1)[:, :-1])
    run = np.cumsum(begins, axis=1) - 1
    many = run[:, -1] + 1
    whole = many == 1
    right = np.arange(pushing.shape[1]) >= pushing.shape[1] // 2
    on_left, on_right = (pushing & ~right).any(1), (pushing & right).any(1)
    run = np.where(whole[:, None], right & on_left[:, None], run)
    many = np.where(whole, on_left + 1 * on_right, many)
    k = np.arange(max(int(many.max()), 1))
    return pushing[:, None] & (run[:, None] == k[:, None]), many, whole


def minimisers(bounds: Array, moves: Array) -> tuple[Array, Array]:
    """Intervals of all dU that dissipate least, (R,) each; see analytic.friction.dissipation.

    Args:
        bounds, moves: of the contacts, (R, K); bounds are 0 where there is none.
    """
    order = np.argsort(-np.where(bounds > 0, moves, -np.inf), axis=1, kind="stable")
    places = -np.take_along_axis(moves, order, 1)
    below = np.take_along_axis(bounds, order, 1).cumsum(1)
    total = bounds.sum(1)
    near = ALIKE * total
    low, high = (
        np.take_along_axis(places, (below >= limit[:, None]).argmax(1)[:, None], 1)[:, 0]
        for limit in (0.5 * total - near, 0.5 * total + near)
    )
    return np.where(total > 0, low, -np.inf), np.where(total > 0, high, np.inf)


class AnchorRows:
    """Contacts that friction anchors; see mjsim.friction.between_ends.AnchoredContacts.

    Args:
        tendons: of the nodes, (N,).
        count: number of scenes.

    Attributes:
        anchored: nodes that are anchored in the coming step, (B, N).
        resisting: nodes of the contacts, (B, N).
        bounds: of these, (B, N) [N].
    """

    def __init__(self, tendons: Indices, count: int) -> None:
        shape = count, len(tendons)
        self.anchored, self.resisting = np.zeros(shape, bool), np.zeros(shape, bool)
        self.bounds, self._tendons = np.zeros(shape), tendons
        self._anchored_before, self._before = np.zeros(shape, bool), np.zeros(shape)

    def start(self, rows: Indices, places: Array) -> None:
        """Begin anew with the nodes at places, (R, T) by tendons [m]."""
        for flags in (self.anchored, self.resisting, self._anchored_before):
            flags[rows] = False
        self._before[rows] = places[:, self._tendons]

    def set(self, rows: Indices, contacts: ContactRows, bounds: Array, anchored: Flags) -> None:
        """Take the contacts of the coming step, their bounds [N] and which are anchored, (R, K)."""
        row, slot = np.nonzero(contacts.there)
        self.anchored[rows], self.resisting[rows] = False, False
        at = rows[row], contacts.node[row, slot]
        self.anchored[at], self.resisting[at] = anchored[row, slot], True
        self.bounds[at] = bounds[row, slot]

    def after_step(self, rows: Indices, dt: float, rates: Array, places: Array) -> Array:
        """Mean motion of the anchored nodes by the order of the step alone, (R,) [m]."""
        at, anchored = places[:, self._tendons], self._anchored_before[rows]
        moved = np.where(anchored, dt * rates[:, self._tendons] - at + self._before[rows], 0.0)
        excess = moved.sum(1) / np.maximum(anchored.sum(1), 1)
        self._before[rows], self._anchored_before[rows] = at - excess[:, None], self.anchored[rows]
        return np.asarray(excess)

    def drift(self, rows: Indices, rates: Array) -> Array:
        """Speed of the whole that least dissipation does not explain, (R,) [m/s]."""
        resisting, speeds = self.resisting[rows], rates[:, self._tendons]
        low, high = minimisers(np.where(resisting, self.bounds[rows], 0.0), speeds)
        many = resisting.sum(1)
        mean = np.where(resisting, speeds, 0.0).sum(1) / np.maximum(many, 1)
        return np.where(many > 0, np.minimum(np.maximum(mean, -high), -low), np.nan)
