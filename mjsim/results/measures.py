"""Numbers of one walk: how far, which way, how high, how straight, and what is unexplained."""

import math
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
        displacement: of the left end per cycle: in the last one on uniform ground, else their mean.
        speed: the same per time [m/s].
        by_cycle: the same in each cycle; the first may differ where a gait starts inflated.
        direction: of it, "none" below analytic.locomotion.STANDSTILL.
        amplitude: greatest height.
        unexplained: displacement per cycle that the anchor rule does not account for; NaN where
            the ground resists by speed.
        heading: the angle it turned by to the left [rad].
        sideways: how far any of it ever was beside its plane.
    """

    displacement: float
    speed: float
    by_cycle: tuple[float, ...]
    direction: Direction
    amplitude: float
    unexplained: float
    heading: float
    sideways: float


def measure(walk: Trajectory) -> Measures | None:
    """Measures of a walk that ended well; None of one that did not, as it has none.

    What the anchor rule does not explain is what inertia drags the anchored end along for want of
    friction. It vanishes as the gait slows, and is a lower bound on the error of the displacement
    at finite speed.
    """
    if walk.status is not Status.OK:
        return None
    x, z = walk.nodes()
    scene, begin = walk.scene, walk.start
    length = scene.robot.length
    ends = _ends_of_cycles(walk)
    by_cycle = np.diff(x[ends, 0]) / length
    uniform = isinstance(scene.ground, Surface)
    counted = 1 if uniform else scene.cycles  # how many cycles the displacement is the mean of
    first, last = ends[-1 - counted], ends[-1]
    travel = float(x[last, 0] - x[first, 0])
    steps = slice(first + 1, last + 1)
    change = np.diff(x[:, -1] - x[:, 0])[first:last]
    ruled = -float(walk.left_slip_fraction[steps] @ change)
    if math.isnan(ruled):
        ruled = travel - float(walk.drift[steps].sum()) * walk.numerics.timestep
    if depends_on_speed(scene.ground):
        ruled = math.nan  # both ends slide, by their viscous resistance
    shift = travel / (counted * length)
    along, aside, _ = walk.position[-1, -1] - walk.position[-1, 0]
    return Measures(
        displacement=shift,
        speed=shift * length / scene.gait.period,
        by_cycle=tuple(by_cycle.tolist()),
        direction=direction(shift, 1.0),
        amplitude=float(z[begin:].max()) / length,
        unexplained=shift - ruled / (counted * length),
        heading=math.atan2(aside, along),
        sideways=float(np.abs(walk.position[..., 1]).max()) / length,
    )


def _ends_of_cycles(walk: Trajectory) -> NDArray[np.int_]:
    """Rows in which cycles begin and end, (C + 1,)."""
    times = walk.scene.gait.period * np.arange(walk.scene.cycles + 1)
    rows = walk.start + np.rint(times / walk.numerics.timestep).astype(int)
    return np.minimum(rows, len(walk.time) - 1)


def slid_over_length(walk: Trajectory) -> float | None:
    """Distance that both ends went downhill together in the cycles, over L; None before them."""
    if walk.time[-1] <= 0:
        return None
    return slid(walk, walk.start) / walk.scene.robot.length
