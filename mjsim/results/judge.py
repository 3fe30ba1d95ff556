"""Status of a recorded walk, by written criteria."""

import math
from dataclasses import replace

import numpy as np

from analytic.scene.feet import drops
from mjsim.results.status import END_HOPS, Status
from mjsim.results.trajectory import Trajectory

_ASIDE = 0.02  # a vertex this far off the plane, over L, has left it; chosen
_SLID = 0.02  # of the length that both ends went downhill at once: the whole slides; chosen


def judge(walk: Trajectory, stopped: bool = False, unsettled: bool = False) -> Trajectory:
    """The walk up to its failure, if it failed, with its status.

    Args:
        walk: as recorded.
        stopped: whether the stepping stopped early.
        unsettled: whether it began before the robot had come to rest.
    """
    if walk.scene.in_space:
        return replace(walk, status=_in_space(walk, stopped, unsettled))
    length = walk.scene.robot.length
    height = walk.line[..., 2]
    gap = height.copy()  # of an end on a foot that stands proud under that
    gap[:, [0, -1]] -= drops(walk.scene.strip.feet)
    ends, lowest = np.abs(gap[:, [0, -1]]).max(axis=1), gap.min(axis=1)
    hop = walk.numerics.hop * length
    fallen = np.flatnonzero(~((ends < END_HOPS * hop) & (lowest < hop)))
    if len(fallen) and not stopped:
        walk = walk.up_to(int(fallen[0]) + 1)
    return replace(walk, status=_status(walk, stopped or len(fallen) > 0, unsettled))


def _status(walk: Trajectory, stopped: bool, unsettled: bool) -> Status:
    length = walk.scene.robot.length
    if not np.abs(walk.line[-1, :, 2]).max() < length:
        return Status.DIVERGED
    if not np.abs(walk.line[..., 1]).max() < _ASIDE * length:
        return Status.TURNED
    if slid(walk) > _SLID * length:
        return Status.SLID  # also where it failed on the way down
    if stopped:
        return Status.TOPPLED
    return Status.UNSETTLED if unsettled else Status.OK


def _in_space(walk: Trajectory, stopped: bool, unsettled: bool) -> Status:
    """Status of a robot of limbs, which stops as its trunk tips over or leaves the ground."""
    if slid(walk) > _SLID * walk.scene.robot.length:
        return Status.SLID  # also where it failed on the way down
    if not stopped:
        return Status.UNSETTLED if unsettled else Status.OK
    high = abs(float(walk.line[-1, 0, 2])) < walk.scene.robot.length
    return Status.TOPPLED if high else Status.DIVERGED


def slid(walk: Trajectory, begin: int = 0) -> float:
    """Distance that all of a robot, or both ends of a strip, went downhill from a state on [m]."""
    scene = walk.scene
    if not scene.slope:
        return 0.0
    places = walk.position[begin:] if scene.in_space else walk.line[begin:, [0, -1]]
    downhill = np.array(scene.incline.downhill) / abs(math.sin(scene.slope))
    moves = np.diff(places[..., :2] @ downhill, axis=0).reshape(len(places) - 1, -1)
    return float(np.maximum(moves.min(axis=1), 0.0).sum())
