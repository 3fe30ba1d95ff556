"""Numbers of one walk: how far, which way, how high, how straight, and how much was slip."""

import math
from typing import NamedTuple

import numpy as np

from analytic import Direction, direction
from mjsim.simulation.status import Status
from mjsim.simulation.trajectory import Trajectory


class Measures(NamedTuple):
    """Attributes, lengths over L: displacement of the left end per cycle; its direction; greatest
    height; slip, the displacement per cycle that the anchor rule does not account for; the angle
    it turned by to the left [rad]; and how far any of it ever was beside its plane.
    """

    displacement: float
    direction: Direction
    amplitude: float
    slip: float
    heading: float
    sideways: float


def measure(walk: Trajectory) -> Measures | None:
    """Measures of a walk that ended well; None of one that did not, as it has none.

    Slip is what inertia drags the anchored end along for want of friction. It vanishes as the gait
    slows, and is a lower bound on the error of the displacement at finite speed.
    """
    if walk.status is not Status.OK:
        return None
    x, z = walk.nodes()
    begin = walk.start
    length, cycles = walk.scene.robot.length, walk.scene.cycles
    left = x[begin:, 0]
    change = np.diff(x[begin:, -1] - left)
    ruled = -float(walk.left_slip_fraction[begin + 1 :] @ change)
    travel = float(left[-1] - left[0])
    along, aside, _ = walk.position[-1, -1] - walk.position[-1, 0]
    return Measures(
        displacement=travel / (cycles * length),
        direction=direction(travel / cycles, length),
        amplitude=float(z[begin:].max()) / length,
        slip=(travel - ruled) / (cycles * length),
        heading=math.atan2(aside, along),
        sideways=float(np.abs(walk.position[..., 1]).max()) / length,
    )
