"""Contact lengths that follow from the contact forces on nodes, for one or many states."""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.friction.flat_load import FlatLoad, LoadFrom, heaviest
from analytic.scene import pneunet
from analytic.scene.actuator import Actuator
from analytic.scene.feet import drops
from analytic.scene.limbs import AnyRobot, limbs_of
from analytic.scene.robot import Robot
from analytic.scene.surface import Surface

Array = NDArray[np.float64]

PASSIVE = 0.01  # of the peak pressure: an end with less may lie on its side, if it does; chosen
_ROBOTS = 256  # whose bending peaks are remembered; sweeps have many
_PEELS = 128 / 9  # D kappa^2 over gamma q, see flat_pressures
_MOST = 64.0  # times the peak pressure, that no adhesion holds against; chosen
_HALVINGS = 50  # of an interval that a pressure lies in; to rounding
_RIPPLE = 0.2  # of w L h^3 / D0: how high a flat stretch ripples between nodes, bounded; measured


def side_contact(
    robot: Robot, nodes: Array, force: Array, height: Array, pressures: Array,
    surface: Surface | None = None,
) -> tuple[Array, Array]:  # fmt: skip
    """Length of side contact at the left and the right end.

    An end whose segment is inflated is a tip: to lie flat it would need the moment D kappa, and an
    end has none. Else (or with next to no pressure) the ground carries the weight of a flat
    stretch, w per length, and where the strip lifts off a concentrated force R besides. So the
    length follows from the sum and the moment of the forces on an end's nodes (see FlatLoad):
    finer than the distance of the nodes, and exactly 0 if the end alone touches. An end's nodes
    reach to the next that is in the air, higher than a flat stretch ripples between the nodes that
    push it.

    Args:
        nodes: arclength of the nodes, shape (S,) [m].
        force: of the ground on each, 0 where it does not touch, shape (B, S) [N].
        height: of each over where it touches, shape (B, S) [m].
        pressures: of the segments, shape (B, S) [Pa].
        surface: whose adhesion pulls at a flat stretch, besides its weight, and may keep an
            inflated end flat too.

    Returns:
        Two arrays of shape (B,) [m]; half the length each where no node is in the air, NaN where
        a force is.
    """
    lifted = ripple(robot, nodes)
    flat = np.abs(pressures[:, [0, -1]]) <= end_flat_pressures(robot, surface)
    press = surface.press(robot.width) if surface else 0.0
    load = FlatLoad(robot, press)
    lengths = [
        [end_contact(inwards, nodes[::order], f[::order], y[::order] > lifted, lies[::order][0])
         for f, y, lies in zip(force, height, flat, strict=True)]
        for order, inwards in ((1, load.from_begin), (-1, load.from_end))
    ]  # fmt: skip
    return np.array(lengths[0]), np.array(lengths[1])


def end_contact(
    load: LoadFrom, nodes: Array, push: Array, air: NDArray[np.bool_], flat: bool
) -> float:
    """Length of side contact at the end that comes first, of one state; see side_contact [m].

    Args:
        load: of the strip from that end on.
        nodes: arclength, from that end or towards it, (S,) [m].
        push: force on each, (S,) [N].
        air: whether it is higher than a flat stretch ripples, (S,).
        flat: whether the segment at that end may lie flat, see flat_pressures.
    """
    if not np.isfinite(push[0]):
        return np.nan
    count = flat_nodes(push, air, flat)
    if count is None:
        return 0.5 * load.whole
    if not count:
        return 0.0
    carried = push[:count]
    moment = float(carried @ np.abs(nodes[:count] - nodes[0]))
    return load.length(float(carried.sum()), moment)


def flat_nodes(push: Array, air: NDArray[np.bool_], flat: bool) -> int | None:
    """Number of an end's nodes, 0 where it is a tip; None where no node of the strip is in the air.

    Args:
        push, air, flat: see end_contact.
    """
    if not flat:
        return 0
    first = int((push > 0).argmax())  # the outermost node may hover by a rounding of h
    end = first + int(air[first:].argmax())
    if air[end]:
        return end
    return len(push) if air.any() else None


def ripple(robot: Robot, nodes: Array) -> float:
    """Bound of the height to which a flat stretch ripples between nodes that push it [m]."""
    spacing = float(np.diff(nodes).max())
    unit = heaviest(robot) * robot.length * spacing**3 / pneunet.base_rigidity(robot)
    return _RIPPLE * unit


def end_flat_pressures(robot: Robot, surface: Surface | None = None) -> Array:
    """Greatest pressures at which the left and the right end may lie on their side, (2,) [Pa].

    Below 0 for an end on a foot that stands proud, which never does.
    """
    proud = np.array(drops(robot.feet)) > 0
    return np.where(proud, -1.0, flat_pressures(robot, surface)[[0, -1]])


@lru_cache(_ROBOTS)
def flat_pressures(robot: AnyRobot, surface: Surface | None = None) -> Array:
    """Greatest pressures of chambers at which their segments may lie on their side, (S,) [Pa].

    Next to none, or what adhesion can hold: under a constant pull w' an inflated end arches to a
    height of 9/128 D kappa^2 / w', and peels where that is the reach, D kappa^2 = 128/9 gamma q.
    """
    pressures = PASSIVE * bending_peaks(robot)
    if surface is not None and surface.adhesion:
        peels = [_peeling_pressures(limb.strip, surface.adhesion, robot.peak_pressure)
                 for limb in limbs_of(robot)]  # fmt: skip
        pressures = np.maximum(pressures, np.concatenate(peels))
    pressures.flags.writeable = False
    return pressures


def _peeling_pressures(strip: Robot, adhesion: float, peak: float) -> Array:
    """Roots of D kappa^2 = 128/9 gamma q of the segments of a strip, (S,) [Pa]."""
    held = _PEELS * adhesion * strip.width

    def holds(pressure: Array) -> Any:
        curvature = pneunet.natural_curvature(strip, pressure)
        return pneunet.rigidity(strip, pressure) * curvature**2 <= held

    return _greatest(holds, np.full(len(strip.segments), _MOST * peak))


def _greatest(holds: Callable[[Array], Any], most: Array) -> Array:
    """Greatest pressures up to which something holds that fails from there to `most` [Pa]."""
    low, high = np.zeros_like(most), most
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        held = holds(middle)
        low, high = np.where(held, middle, low), np.where(held, high, middle)
    return low


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
    goal = PASSIVE * float(actuator.curvature_at(peak))
    return float(_greatest(lambda p: actuator.curvature_at(p) <= goal, np.full(1, peak))[0])


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
