"""Contacts of a strip with the ground, from end to end, each a tip or a side.

Plain floats, since this is asked at every step of a simulation, and numpy is slow on a few numbers.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import ripple
from analytic.friction.flat_load import FlatLoad
from analytic.friction.laws import ROUGHNESS
from analytic.scene.feet import drops
from analytic.scene.payload import place_on_link
from analytic.scene.robot import Robot
from analytic.shapes import ContactShapes

Array = NDArray[np.float64]

POINT = 2  # nodes in a row that push in one point of contact, as it may fall between two


class StripContact(NamedTuple):
    """One contact of a strip.

    Attributes:
        nodes, share: of the strip that move with it and their parts in its motion: of an end the
            end itself, else those that push, by their force.
        length: of side contact, 0 for a tip [m].
        load: normal force [N].
        drag: bound of a tether, whatever the ground; None of a contact with it [N].
    """

    nodes: list[int]
    share: list[float]
    length: float
    load: float
    drag: float | None = None

    def extent(self, x: Array) -> tuple[float, float]:
        """Places where the contact begins and ends, from those of all nodes, (N,) [m].

        Of arclengths of the nodes the stretch of the strip that touches.
        """
        place = float(np.dot(self.share, x[self.nodes]))
        if self.nodes == [0]:
            return place, place + self.length
        if self.nodes == [len(x) - 1]:
            return place - self.length, place
        return place - 0.5 * self.length, place + 0.5 * self.length


def of_tether(robot: Robot, nodes: Array) -> list[StripContact]:
    """The contact that a strip's tether is, of a chain with nodes at arclengths (N,) [m]."""
    tether = robot.tether
    if tether is None or not tether.resists:
        return []
    link, part = place_on_link(nodes, tether.at * robot.length)
    share = {link: 1.0 - part, link + 1: part}
    on = {node: weight for node, weight in share.items() if weight}
    return [StripContact(list(on), list(on.values()), 0.0, 0.0, tether.drag)]


class ContactFinder:
    """Finds the contacts of one strip.

    Args:
        robot: the strip.
        nodes: arclength of its nodes, (N,) [m].
        roughness: of skin and ground, see analytic.friction.laws.Friction [m].
        press: of adhesive ground, see analytic.friction.contact_length [N/m].
    """

    def __init__(
        self, robot: Robot, nodes: Array, roughness: float = ROUGHNESS, press: float = 0.0
    ) -> None:
        self._load, self._roughness = FlatLoad(robot, press), roughness
        self._place: list[float] = nodes.tolist()
        self._lifted = ripple(robot, nodes)

    def find(
        self, force: Sequence[float], height: Sequence[float], lengths: tuple[float, float]
    ) -> list[StripContact]:
        """The contacts of one state, left first.

        Where nodes push with no gap between them above the roughness is one contact: a tip if it
        is one point, else a side whose length follows from its forces. An end is one too unless it
        curls up; pressure does not decide it, but how high it arches. Between the ends either half
        of a side carries its weight and a push. There an inflated part may lie flat, by the weight
        on both sides of it.

        Args:
            force: of the ground on the nodes, (N,) [N].
            height: of the nodes over where they touch, (N,) [m].
            lengths: of side contact of the two ends, see analytic.friction.contact_length: not 0
                for an end without pressure, whose side may be shorter than a link; used as they
                are where the strip lies flat as a whole [m].
        """
        pushing = [node for node, push in enumerate(force) if push > 0.0]
        if not pushing:
            return []
        runs = runs_without_gaps(pushing, height, lambda before, node: self._roughness)
        whole = len(runs) == 1  # the ends' contacts are its halves
        if whole:
            middle = len(force) // 2
            halves = ([n for n in pushing if n < middle], [n for n in pushing if n >= middle])
            runs = [half for half in halves if half]
        contacts = []
        for number, run in enumerate(runs):
            push = [force[node] for node in run]
            load = sum(push)
            end = 0 if number == 0 else len(force) - 1
            outermost = number == 0 or number == len(runs) - 1
            if outermost and height[end] <= self._lifted:
                length = lengths[1 if end else 0]
                if whole:
                    length = length or 0.5 * self._place[-1]
                elif length or len(run) > POINT:
                    length = self._side(run, push, self._place[end])
                contacts.append(StripContact([end], [1.0], length, load))
            else:
                share = [part / load for part in push]
                contacts.append(StripContact(run, share, self._length_between(run, push), load))
        return contacts

    def _side(self, run: list[int], push: list[float], end: float) -> float:
        """Length of a flat stretch that begins at an end, from what its nodes carry [m]."""
        moment = sum(p * abs(self._place[node] - end) for node, p in zip(run, push, strict=True))
        inwards = self._load.from_end if end else self._load.from_begin
        return inwards.length(sum(push), moment)

    def _length_between(self, run: list[int], push: list[float]) -> float:
        if run[-1] - run[0] < POINT:
            return 0.0
        return self._load.length_between([self._place[node] for node in run], push)


def runs_without_gaps(
    pushing: Sequence[int], height: Sequence[float], closed: Callable[[int, int], float]
) -> list[list[int]]:
    """Runs of nodes that push with no gap between them.

    Args:
        pushing: numbers of the nodes that push, ascending, at least one.
        height: of all nodes [m].
        closed: height up to which what lies between two of them is no gap [m].
    """
    runs = [[pushing[0]]]
    for node in pushing[1:]:
        before = runs[-1][-1]
        if node > before + 1 and max(height[before + 1 : node]) > closed(before, node):
            runs.append([])
        runs[-1].append(node)
    return runs


def contacts_of(
    shapes: ContactShapes, height: Array, state: int, roughness: float = ROUGHNESS
) -> list[StripContact]:
    """The contacts of one of several states, its nodes at heights of shape (B, N) [m]."""
    lengths = float(shapes.contact_left[state]), float(shapes.contact_right[state])
    finder = ContactFinder(shapes.robot, shapes.nodes, roughness)
    gap = height[state].copy()
    gap[[0, -1]] -= drops(shapes.robot.feet)
    return finder.find(shapes.force[state].tolist(), gap.tolist(), lengths)
