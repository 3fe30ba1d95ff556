"""Contacts of a strip with the ground, from end to end, each a tip or a side.

Plain floats, since this is asked at every step of a simulation, and numpy is slow on a few numbers.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import arches, flat_length, length_between, ripple
from analytic.scene.robot import Robot
from analytic.shapes import ContactShapes

Array = NDArray[np.float64]

POINT = 2  # nodes of a run that push in one point of contact, as it may fall between two


class StripContact(NamedTuple):
    """One contact of a strip.

    Attributes:
        nodes, share: of the strip that move with it and their parts in its motion: of an end the
            end itself, else those that push, by their force.
        length: of side contact, 0 for a tip [m].
        load: normal force [N].
    """

    nodes: list[int]
    share: list[float]
    length: float
    load: float

    def extent(self, x: Array) -> tuple[float, float]:
        """Places where the contact begins and ends, from those of all nodes, (N,) [m]."""
        place = float(np.dot(self.share, x[self.nodes]))
        if self.nodes == [0]:
            return place, place + self.length
        if self.nodes == [len(x) - 1]:
            return place - self.length, place
        return place - 0.5 * self.length, place + 0.5 * self.length


class ContactFinder:
    """Finds the contacts of one strip.

    Args:
        robot: the strip.
        nodes: arclength of its nodes, (N,) [m].
        press: of adhesive ground, see analytic.friction.contact_length [N/m].
    """

    def __init__(self, robot: Robot, nodes: Array, press: float = 0.0) -> None:
        self._weight = robot.weight_per_length + press
        self._place: list[float] = nodes.tolist()
        self._robot = robot
        self._half = 0.5 * robot.length
        self._spacing = float(np.diff(nodes).max())
        self._lifted = ripple(robot, nodes)

    def find(
        self,
        force: Sequence[float],
        height: Sequence[float],
        arches: tuple[bool, bool],
    ) -> list[StripContact]:
        """The contacts of one state, left first.

        A run of nodes on the ground is a tip if it is one point, else a side whose length follows
        from its forces: that of an end as in analytic.friction.contact_length, unless it curls up;
        of one between the ends either half carries its weight and a push. Pressure does not decide
        it: an inflated part may lie flat by the weight on both sides of it, and behind an end that
        hardly arches. But an end that is inflated arches within a link too: there a side that is
        shorter is a point, while without pressure it is as short as its forces say.

        Args:
            force: of the ground on the nodes, (N,) [N].
            height: of the nodes, (N,) [m].
            arches: whether the left and the right end do, see `arches`.
        """
        pushing = [node for node, push in enumerate(force) if push > 0.0]
        if not pushing:
            return []
        runs = _in_a_row(pushing)
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
                length = self._half if whole else self._side(run, push, self._place[end])
                if length < self._spacing and arches[1 if end else 0]:
                    length = 0.0
                contacts.append(StripContact([end], [1.0], length, load))
            else:
                share = [part / load for part in push]
                contacts.append(StripContact(run, share, self._length_between(run, push), load))
        return contacts

    def arches(self, pressures: Array) -> Any:
        """Tell whether the ends arch by more than a link, by pressures (..., S) [Pa]: (..., 2)."""
        return arches(self._robot, pressures[..., [0, -1]], self._spacing)

    def _side(self, run: list[int], push: list[float], end: float) -> float:
        """Length of a flat stretch that begins at an end, from what its nodes carry [m]."""
        moment = sum(p * abs(self._place[node] - end) for node, p in zip(run, push, strict=True))
        return float(flat_length(self._weight, sum(push), moment))

    def _length_between(self, run: list[int], push: list[float]) -> float:
        if len(run) <= POINT:
            return 0.0
        return length_between(self._weight, [self._place[node] for node in run], push)


def _in_a_row(pushing: list[int]) -> list[list[int]]:
    """Runs of nodes beside each other; between them is an arch, however low it is."""
    runs = [[pushing[0]]]
    for node in pushing[1:]:
        if node > runs[-1][-1] + 1:
            runs.append([])
        runs[-1].append(node)
    return runs


def contacts_of(shapes: ContactShapes, height: Array, state: int) -> list[StripContact]:
    """The contacts of one of several states, its nodes at heights of shape (B, N) [m]."""
    finder = ContactFinder(shapes.robot, shapes.nodes)
    arching = finder.arches(shapes.pressures[state]).tolist()
    return finder.find(shapes.force[state].tolist(), height[state].tolist(), arching)
