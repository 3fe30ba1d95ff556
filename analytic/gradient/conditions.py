"""Conditions that may change the contacts of a state next."""

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import flat_nodes, flat_pressures, ripple
from analytic.gradient.equilibrium import Balance, Condition, Contacts
from analytic.solvers.elastica.state import Mask

Array = NDArray[np.float64]

_LENGTH = 1e-9  # over L, by which a length of contact changes where a node counts no more; chosen
_NEAR = 1e-4  # over L, so near to the height that counts as in the air; chosen
_LITTLE = 0.1  # of a node's weight, which a node that may lift off carries; chosen
_ENDS = ("left", "right")


def possible(balance: Balance, u: Array, contacts: Contacts) -> list[tuple[Condition, bool]]:
    """Conditions that may be met next, and whether a slide ends there."""
    conditions = []
    y = balance.split(u)[0]
    end_node = len(y) - 1
    pressure = np.abs(balance.pressure(float(u[-1])))
    robot = balance.inputs.robot
    flat = flat_pressures(robot, balance.inputs.surface)
    at_edge = {0: 1, 1: end_node - 1}[contacts.edge] if contacts.tension == "edge" else None
    for node in _near(balance, u, contacts):
        if node == at_edge:
            continue
        end = 0 if node == 1 else 1
        beside = node in (1, end_node - 1) and pressure[-end] <= flat[-end]
        kind = "force" if contacts.active[node] else "height"
        what = f"the {_ENDS[end]} end changes between a tip and a side"
        conditions.append((Condition(kind, node, what), beside))
    for end, name in enumerate(_ENDS):
        as_side = _as_side(balance, u, contacts, end)
        if contacts.sides[end] != 0 or as_side > 0:
            what = f"the pressure of the {name} end lets it lie flat or not"
            conditions.append((Condition("pressure", end, what), True))
    if contacts.slider != "both" and contacts.tension != "edge":
        conditions.append((Condition("bounds", 0, "both ends resist alike"), True))
    if contacts.tension == "edge":
        conditions += [(Condition("tip", 0, "an end is a tip again"), True),
                  (Condition("other", 0, "both ends resist alike"), True)]  # fmt: skip
    return conditions + [(Condition("ripple", node, "a flat stretch lifts off or comes down"), True)
                    for node in _that_count(balance, u, contacts)]  # fmt: skip


def _near(balance: Balance, u: Array, contacts: Contacts) -> list[int]:
    """Nodes on the ground and in the air beside such ones."""
    active = contacts.active
    beside = np.zeros_like(active)
    beside[1:] |= active[:-1]
    beside[:-1] |= active[1:]
    y = balance.split(u)[0]
    low = y < _NEAR
    border = np.zeros_like(active)
    border[1:] |= ~active[:-1]
    border[:-1] |= ~active[1:]
    force = balance.forces(u)
    few = active & (border | (force < _LITTLE * balance.chain.weight))
    return list(np.flatnonzero(few | (~active & (beside | low))))


def _as_side(balance: Balance, u: Array, contacts: Contacts, end: int) -> float:
    """Length of side contact that an end has if its pressure lets it lie flat [m]."""
    robot = balance.inputs.robot
    air = balance.split(u)[0] * robot.length > ripple(robot, balance.nodes)
    force = balance.forces(u) * contacts.active
    return _length(balance, u, contacts, force, air, end)


def _that_count(balance: Balance, u: Array, contacts: Contacts) -> list[int]:
    """Nodes as high as a flat stretch ripples whose height decides a length of contact.

    One of the stretch that rises, and the highest of those beside it that come down.
    """
    robot, y = balance.inputs.robot, balance.split(u)[0]
    level = ripple(robot, balance.nodes) / robot.length
    force, air = balance.forces(u) * contacts.active, y > level
    lies = np.abs(balance.pressure(float(u[-1]))) <= flat_pressures(robot, balance.inputs.surface)
    nodes = set()
    for end, order in enumerate((1, -1)):
        count = contacts.sides[end]
        if count == 0 and lies[-end]:  # a tip that may be part of a side
            count = flat_nodes(force[::order], air[::order], True)
        if not count:
            continue
        places = np.arange(len(y))[::order]
        beside = places[count:]
        beside = beside[: int((~air[beside]).argmax())]
        near = np.abs(y[places[:count]] - level) < _NEAR
        rising = [[node] for node in places[:count][near] if not contacts.active[node]]
        for group in [*rising, list(beside)]:
            turned = air.copy()
            turned[group] = ~air[group]
            lengths = [_length(balance, u, contacts, force, mask, end) for mask in (air, turned)]
            if group and abs(lengths[1] - lengths[0]) > _LENGTH * robot.length:
                nodes.add(int(max(group, key=lambda node: y[node])))
    return sorted(nodes)


def _length(
    balance: Balance, u: Array, contacts: Contacts, force: Array, air: Mask, end: int
) -> float:
    """Length of side contact of an end that may lie flat, with some nodes in the air [m]."""
    order = -1 if end else 1
    count = flat_nodes(force[::order], air[::order], True)
    return float(balance.side(u, contacts._replace(sides=(count, count)), end))
