"""Where a strip touches the ground: its contacts from end to end, each a tip or a side."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.contact import flat_length, lifted_nodes, may_lie_flat
from analytic.equilibria import ContactShapes

Array = NDArray[np.float64]

_FLAT = 1e-3  # rad; less steep than this is flat, as in the simulation; chosen
_POINT = 2  # most nodes that push in a contact in one point, as it may fall between two


class Patch(NamedTuple):
    """One contact.

    Attributes:
        nodes, share: of the strip that move with it and their parts in its motion, shape (K,) each:
            of an end the end itself, else those that push, by their force.
        length: of side contact, 0 for a tip [m].
        load: normal force [N].
    """

    nodes: NDArray[np.int_]
    share: Array
    length: float
    load: float


def patches(shapes: ContactShapes, height: Array, state: int) -> list[Patch]:
    """The contacts of one state, left first.

    The two ends are tips or sides as in analytic.contact. Between them a run of nodes on the ground
    is a tip if it is one point or inflated, which could not lie flat, else a side whose length
    follows from its forces, as that of an end: either half of it carries its weight and a push.

    Args:
        shapes: equilibria with contact forces.
        height: of the nodes, (B, N) [m].
        state: which.
    """
    force, nodes = shapes.force[state], shapes.nodes
    pushing = np.flatnonzero(force > 0)
    if not len(pushing):
        return []
    borders = [
        i + 1
        for i, (one, two) in enumerate(pairwise(pushing))
        if _lifted_between(shapes, height[state], int(one), int(two))
    ]
    runs = np.split(pushing, borders)
    whole = len(runs) == 1  # the ends' contacts are its halves
    if whole:
        middle = len(nodes) // 2
        runs = [run for run in (pushing[pushing < middle], pushing[pushing >= middle]) if len(run)]
    contacts = []
    for number, run in enumerate(runs):
        load = float(force[run].sum())
        share, last = force[run] / load, number == len(runs) - 1
        if number == 0 or last:
            length = float((shapes.contact_right if last else shapes.contact_left)[state])
            if length and not whole:
                reach = nodes[-1] - nodes[run] if last else nodes[run]
                moment = float(force[run] @ reach)
                length = float(flat_length(shapes.robot.weight_per_length, load, moment))
            run, share = np.array([len(nodes) - 1 if last else 0]), np.ones(1)
        else:
            length = _length(shapes, shapes.pressures[state], run, force)
        contacts.append(Patch(run, share, length, load))
    return contacts


def _lifted_between(shapes: ContactShapes, height: Array, one: int, two: int) -> bool:
    """Whether the strip is in the air between two nodes that push, and not as good as flat."""
    between = height[one + 1 : two]
    if not len(between) or not lifted_nodes(shapes.robot, shapes.nodes, between).any():
        return False
    return float(between.max()) > _FLAT * float(shapes.nodes[two] - shapes.nodes[one])


def _length(shapes: ContactShapes, pressure: Array, run: NDArray[np.int_], force: Array) -> float:
    """Length of side contact of a patch between the ends [m]."""
    robot, place = shapes.robot, shapes.nodes[run]
    middle = float(np.mean(place[[0, -1]]))
    segment = int(np.searchsorted(robot.borders[1:-1], middle / robot.length, side="right"))
    if len(run) <= _POINT or not may_lie_flat(pressure[segment], robot.peak_pressure):
        return 0.0
    length = 0.0
    for side in (-1, 1):
        reach = side * (place - middle)
        part = np.where(reach > 0, 1.0, np.where(reach == 0, 0.5, 0.0)) * force[run]
        total, moment = float(part.sum()), float(part @ np.maximum(reach, 0.0))
        length += float(flat_length(robot.weight_per_length, total, moment))
    return length
