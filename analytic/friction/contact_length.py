"""Contact lengths that follow from the contact forces on nodes, for one or many states."""

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.scene import pneunet
from analytic.scene.robot import Robot
from analytic.scene.surface import Surface

Array = NDArray[np.float64]

PASSIVE = 0.01  # of the peak pressure: an end with less may lie on its side, if it does; chosen
_PEELS = 128 / 9  # D kappa^2 over gamma q, see flat_up_to
_RIPPLE = 0.2  # of w L h^3 / D0: how high a flat stretch ripples between nodes, bounded; measured


def side_contact(
    robot: Robot, nodes: Array, force: Array, height: Array, pressures: Array,
    surface: Surface | None = None,
) -> tuple[Array, Array]:  # fmt: skip
    """Length of side contact at the left and the right end.

    An end whose segment is inflated is a tip: to lie flat it would need the moment D kappa, and an
    end has none. Else (or with next to no pressure) the ground carries the weight of a flat
    stretch, w per length, and where the strip lifts off a concentrated force R besides. So the
    length follows from the sum and the moment of the forces on an end's nodes (see `flat_length`):
    finer than the distance of the nodes, and exactly 0 if the end alone touches. An end's nodes
    reach to the next that is in the air, higher than a flat stretch ripples between the nodes that
    push it.

    Args:
        nodes: arclength of the nodes, shape (S,) [m].
        force: of the ground on each, 0 where it does not touch, shape (B, S) [N].
        height: of each, shape (B, S) [m].
        pressures: of the segments, shape (B, S) [Pa].
        surface: whose adhesion pulls at a flat stretch, besides its weight, and may keep an
            inflated end flat too.

    Returns:
        Two arrays of shape (B,) [m]; half the length each where no node is in the air, NaN where
        a force is.
    """
    lifted = ripple(robot, nodes)
    lengths = [
        [end_contact(robot, nodes[::order], f[::order], y[::order] > lifted, p[::order][0],
                     surface)
         for f, y, p in zip(force, height, pressures, strict=True)]
        for order in (1, -1)
    ]  # fmt: skip
    return np.array(lengths[0]), np.array(lengths[1])


def end_contact(
    robot: Robot, nodes: Array, push: Array, air: NDArray[np.bool_], pressure: float,
    surface: Surface | None,
) -> float:  # fmt: skip
    """Length of side contact at the end that comes first, of one state; see side_contact [m].

    Args:
        robot: the strip.
        nodes: arclength, from that end or towards it, (S,) [m].
        push: force on each, (S,) [N].
        air: whether it is higher than a flat stretch ripples, (S,).
        pressure: of the segment at that end [Pa].
        surface: whose adhesion pulls, see side_contact.
    """
    if not np.isfinite(push[0]):
        return np.nan
    if abs(pressure) > flat_up_to(robot, robot.peak_pressure, surface):
        return 0.0
    first = int((push > 0).argmax())  # the outermost node may hover by a rounding of h
    end = first + int(air[first:].argmax())
    if not air[end]:
        if not air.any():
            return 0.5 * robot.length
        end = len(push)
    push = push[:end]
    moment = float(push @ np.abs(nodes[:end] - nodes[0]))
    press = surface.press(robot.width) if surface else 0.0
    return float(flat_length(robot.weight_per_length + press, float(push.sum()), moment))


def ripple(robot: Robot, nodes: Array) -> float:
    """Bound of the height to which a flat stretch ripples between nodes that push it [m]."""
    spacing = float(np.diff(nodes).max())
    unit = robot.weight_per_length * robot.length * spacing**3 / pneunet.base_rigidity(robot)
    return _RIPPLE * unit


def flat_length(weight: Any, total: Any, moment: Any) -> Any:
    """xi of a flat end that carries F = w xi + R with the moment M = w xi^2 / 2 + R xi [m].

    Args:
        weight: w [N/m], a float or an array.
        total: F [N], a float or an array.
        moment: M about the end [N m], of the shape of F.
    """
    square = total * total - 2.0 * weight * moment
    return (total - (0.5 * (square + abs(square))) ** 0.5) / weight


def length_between(weight: float, places: Sequence[float], push: Sequence[float]) -> float:
    """Length of a flat stretch between the ends, either half of which carries its weight [m].

    Args:
        weight: per length [N/m].
        places: of the nodes that push there, ascending [m].
        push: of each [N].
    """
    middle, length = 0.5 * (places[0] + places[-1]), 0.0
    for sign in (-1.0, 1.0):
        total = moment = 0.0
        for place, part in zip(places, push, strict=True):
            reach = sign * (place - middle)
            if reach >= 0:
                total += part if reach else 0.5 * part
                moment += part * reach
        length += float(flat_length(weight, total, moment))
    return length


def may_lie_flat(pressure: Any, peak_pressure: Any) -> Any:
    """Tell whether an end segment at this pressure [Pa] may lie on its side: with next to none."""
    return abs(pressure) <= PASSIVE * peak_pressure


def flat_up_to(robot: Robot, peak_pressure: float, surface: Surface | None) -> float:
    """Greatest pressure of an end segment at which it may lie on its side [Pa].

    Next to none, or what adhesion can hold: under a constant pull w' an inflated end arches to a
    height of 9/128 D kappa^2 / w', and peels where that is the reach, D kappa^2 = 128/9 gamma q.
    """
    passive = PASSIVE * peak_pressure
    if surface is None or not surface.adhesion:
        return passive
    return max(passive, _peeling_pressure(robot, surface.adhesion))


@cache
def _peeling_pressure(robot: Robot, adhesion: float) -> float:
    """Root of (D0 + eta p) (alpha p)^2 = 128/9 gamma q, by (9) and (3) [Pa]."""
    stiffening, stiffness = pneunet.rigidity_per_pressure(robot), pneunet.base_rigidity(robot)
    work = _PEELS * adhesion * robot.width / pneunet.curvature_per_pressure(robot) ** 2
    roots = np.roots([stiffening, stiffness, 0.0, -work])
    return float(roots[np.isreal(roots)].real.max())


def end_loads(force: Array, height: Array) -> tuple[Array, Array]:
    """Normal force on the left and the right part of the strip, either side of its highest node.

    Args:
        force: of the ground on each node, (B, S) [N].
        height: of each, (B, S) [m].

    Returns:
        Two arrays of shape (B,) [N].
    """
    first = np.arange(force.shape[1]) <= np.argmax(np.nan_to_num(height), axis=1)[:, None]
    left, right = (np.where(side, force, 0.0).sum(axis=1) for side in (first, ~first))
    # an end that carries less by rounding only carries no less
    return left, np.where(np.isclose(left, right, rtol=1e-9, atol=0), left, right)
