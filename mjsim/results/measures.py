"""Numbers of one walk: displacement, direction, height, turn and what is unexplained."""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.locomotion import Direction, direction
from analytic.scene.ground import depends_on_speed
from analytic.scene.surface import Surface
from mjsim.results.judge import slid
from mjsim.results.status import Status
from mjsim.results.trajectory import Trajectory


class Measures(NamedTuple):
    """Numbers of a walk, lengths over L, the speed in SI units.

    Attributes:
        displacement: ahead, of a strip's left end or the trunk's beginning, per cycle: in the last
            one on uniform ground, else their mean; see Trajectory.moved.
        aside: displacement to the left.
        turn: of the robot to the left in the last cycle [rad].
        speed: displacement per time [m/s].
        by_cycle: displacement in each cycle; the first may differ where a gait starts inflated.
        direction: of the displacement, "none" below analytic.locomotion.STANDSTILL.
        amplitude: greatest height of the strip, or of any limb.
        unexplained: displacement per cycle of a strip that the anchor rule does not account for;
            NaN where the ground resists by speed, and of a robot of limbs.
        heading: direction of the robot at the end, to the left of where it first pointed [rad].
        sideways: how far any of a strip ever was beside its plane; the trunk's beginning of limbs.
        radius: of the circle that equal cycles go round, infinite where they do not turn.
    """

    displacement: float
    aside: float
    turn: float
    speed: float
    by_cycle: tuple[float, ...]
    direction: Direction
    amplitude: float
    unexplained: float
    heading: float
    sideways: float
    radius: float


def measure(walk: Trajectory) -> Measures | None:
    """Measures of a walk that ended well; None of one that did not."""
    if walk.status is not Status.OK:
        return None
    scene, length = walk.scene, walk.scene.robot.length
    ends = walk.ends_of_cycles()
    moves = np.array([walk.moved(*pair) for pair in pairwise(ends.tolist())]) / length
    uniform = isinstance(scene.ground, Surface)
    counted = 1 if uniform else scene.cycles  # how many cycles the displacement is the mean of
    ahead, aside = moves[-counted:].mean(axis=0).tolist()
    turn = float(walk.heading[ends[-1]] - walk.heading[ends[-2]])
    half = math.sin(0.5 * turn)
    beside = walk.line[:, :1, 1] if scene.in_space else walk.line[..., 1]
    return Measures(
        displacement=ahead,
        aside=aside,
        turn=turn,
        speed=ahead * length / scene.gait.period,
        by_cycle=tuple(moves[:, 0].tolist()),
        direction=direction(ahead, 1.0),
        amplitude=float(walk.position[walk.start :, ..., 2].max()) / length,
        unexplained=ahead - _ruled(walk, ends[[-1 - counted, -1]]) / (counted * length),
        heading=float(walk.heading[-1]),
        sideways=float(np.abs(beside).max()) / length,
        radius=math.hypot(ahead, aside) / (2 * abs(half)) if half else math.inf,
    )


def _ruled(walk: Trajectory, rows: NDArray[np.int_]) -> float:
    """Displacement of a strip's left end between two states by the anchor rule [m], or NaN.

    What the rule does not explain is the motion of the anchored end by inertia, for want of
    friction. It vanishes as the gait slows, and is a lower bound on the error of the displacement
    at finite speed.
    """
    if walk.scene.in_space or depends_on_speed(walk.scene.ground):
        return math.nan  # all contacts may slide, by their viscous resistance
    begin, end = rows.tolist()
    steps = slice(begin + 1, end + 1)
    x, _ = walk.nodes()
    ruled = -float(walk.left_slip_fraction[steps] @ np.diff(x[:, -1] - x[:, 0])[begin:end])
    if math.isnan(ruled):
        travel = float(x[end, 0] - x[begin, 0])
        ruled = travel - float(walk.drift[steps].sum()) * walk.numerics.timestep
    return ruled


def slid_over_length(walk: Trajectory) -> float | None:
    """Distance that both ends went downhill together in the cycles, over L; None before them."""
    if walk.time[-1] <= 0:
        return None
    return slid(walk, walk.start) / walk.scene.robot.length
