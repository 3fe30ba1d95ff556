"""Numbers of one walk: how far, which way, how high, how straight, and what is unexplained."""

import math
from typing import NamedTuple

import numpy as np

from analytic.ground import depends_on_speed
from analytic.locomotion import Direction, direction
from mjsim.simulation.judge import slid
from mjsim.simulation.status import Status
from mjsim.simulation.trajectory import Trajectory


class Measures(NamedTuple):
    """Numbers of a walk, lengths over L.

    Attributes:
        displacement: of the left end per cycle.
        direction: of it.
        amplitude: greatest height.
        unexplained: displacement per cycle that the anchor rule does not account for; NaN where
            more than the two ends are held or the ground resists by speed.
        heading: the angle it turned by to the left [rad].
        sideways: how far any of it ever was beside its plane.
    """

    displacement: float
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
    begin = walk.start
    length, cycles = walk.scene.robot.length, walk.scene.cycles
    left = x[begin:, 0]
    change = np.diff(x[begin:, -1] - left)
    ruled = -float(walk.left_slip_fraction[begin + 1 :] @ change)
    if depends_on_speed(walk.scene.ground):
        ruled = math.nan  # both ends slide, by their viscous resistance
    travel = float(left[-1] - left[0])
    along, aside, _ = walk.position[-1, -1] - walk.position[-1, 0]
    return Measures(
        displacement=travel / (cycles * length),
        direction=direction(travel / cycles, length),
        amplitude=float(z[begin:].max()) / length,
        unexplained=(travel - ruled) / (cycles * length),
        heading=math.atan2(aside, along),
        sideways=float(np.abs(walk.position[..., 1]).max()) / length,
    )


def slid_over_length(walk: Trajectory) -> float:
    """How far both ends went downhill together, over L."""
    return slid(walk) / walk.scene.robot.length
