"""Contact lengths that follow from the contact forces on nodes, for one or many states."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.scene import pneunet
from analytic.scene.actuator import Actuator
from analytic.scene.limbs import AnyRobot, limbs_of
from analytic.scene.robot import Robot

Array = NDArray[np.float64]

PASSIVE = 0.01  # of the peak pressure: an end with less may lie on its side, if it does; chosen
_ROBOTS = 256  # whose bending peaks are remembered; sweeps have many
_HALVINGS = 50  # of an interval that a pressure lies in; to rounding
_RIPPLE = 0.2  # of w L h^3 / D0: how high a flat stretch ripples between nodes, bounded; measured


def side_contact(
    robot: Robot, nodes: Array, force: Array, height: Array, pressures: Array, press: float = 0.0
) -> tuple[Array, Array]:
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
        press: pull of adhesion on a flat stretch, besides its weight; with any an inflated end may
            lie flat too [N/m].

    Returns:
        Two arrays of shape (B,) [m]; half the length each where no node is in the air, NaN where
        a force is.
    """
    lifted = ripple(robot, nodes)
    flat = may_lie_flat(pressures, bending_peaks(robot))
    lengths = [
        [end_contact(robot, nodes[::order], f[::order], y[::order] > lifted, lies[::order][0],
                     press)
         for f, y, lies in zip(force, height, flat, strict=True)]
        for order in (1, -1)
    ]  # fmt: skip
    return np.array(lengths[0]), np.array(lengths[1])


def end_contact(
    robot: Robot, nodes: Array, push: Array, air: NDArray[np.bool_], flat: bool, press: float
) -> float:
    """Length of side contact at the end that comes first, of one state; see side_contact [m].

    Args:
        robot: the strip.
        nodes: arclength, from that end or towards it, (S,) [m].
        push: force on each, (S,) [N].
        air: whether it is higher than a flat stretch ripples, (S,).
        flat: whether the segment at that end may lie flat, see may_lie_flat.
        press: pull of adhesion, see side_contact [N/m].
    """
    if not np.isfinite(push[0]):
        return np.nan
    if not press and not flat:
        return 0.0
    first = int((push > 0).argmax())  # the outermost node may hover by a rounding of h
    end = first + int(air[first:].argmax())
    if not air[end]:
        if not air.any():
            return 0.5 * robot.length
        end = len(push)
    push = push[:end]
    moment = float(push @ np.abs(nodes[:end] - nodes[0]))
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
    """Tell whether an end segment at this pressure [Pa] may lie on its side: with next to none.

    Args:
        pressure: that acts.
        peak_pressure: of the segment, see bending_peaks.
    """
    return abs(pressure) <= PASSIVE * peak_pressure


@lru_cache(_ROBOTS)
def bending_peaks(robot: AnyRobot) -> Array:
    """Pressures of which the part PASSIVE bends chambers by that part of the peak's curvature.

    They are the peak by the affine law (3), and more of a chamber that bends late, (S,) [Pa].
    """
    peak = robot.peak_pressure
    peaks = np.array([
        _onset(curve, peak) / PASSIVE if curve else peak
        for limb in limbs_of(robot) for curve in limb.strip.actuators
    ])  # fmt: skip
    peaks.flags.writeable = False
    return peaks


def _onset(actuator: Actuator, peak: float) -> float:
    """Pressure at which an actuator bends by the part PASSIVE of its curvature at the peak [Pa]."""
    goal, low, high = PASSIVE * float(actuator.curvature_at(peak)), 0.0, peak
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if actuator.curvature_at(middle) <= goal else (low, middle)
    return low


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
