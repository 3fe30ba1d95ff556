"""Random robots, pressures, gaits and surfaces in the range where the theory has something to say.

Robots are drawn by their dimensionless groups: Gamma = w L^3 / D0, kappa L and eta p / D0.
"""

import numpy as np
from hypothesis import strategies as st

from analytic import Gait, Robot
from analytic.scene import pneunet
from analytic.scene.surface import from_ratios


def robot_from_groups(gamma: float, kappa_length: float, stiffening: float, length: float) -> Robot:
    """The robot with these groups at its peak pressure."""
    base = Robot()
    # alpha p L = kappa L and eta p / D0 = stiffening fix the chamber height; then modulus and load
    height = 2 * stiffening / (kappa_length / length)
    chamber = base.chamber_fraction * height**3 * base.width / 4
    rigidity = chamber * base.peak_pressure / stiffening
    modulus = 12 * rigidity / (base.width * base.thickness**3)
    return Robot(
        length=length,
        modulus=modulus,
        chamber_height=height,
        weight_per_length=gamma * rigidity / length**3,
    )


def groups(robot: Robot) -> tuple[float, float, float]:
    d0 = pneunet.base_rigidity(robot)
    p = robot.peak_pressure
    return (
        robot.weight_per_length * robot.length**3 / d0,
        float(pneunet.natural_curvature(robot, p)) * robot.length,
        pneunet.rigidity_per_pressure(robot) * p / d0,
    )


robots = st.builds(
    robot_from_groups,
    gamma=st.floats(2.0, 60.0),
    kappa_length=st.floats(0.5, 5.0),
    stiffening=st.floats(0.01, 0.3),
    length=st.floats(0.02, 0.5),
)
# steps of 1/64: a pressure of 1e-200 Pa is no case of interest
fractions = st.tuples(*[st.integers(0, 64).map(lambda i: i / 64)] * 3)
batches = st.lists(fractions, min_size=1, max_size=30).map(np.array)
resistances = st.integers(0, 64).map(lambda i: i / 32)
surfaces = st.builds(from_ratios, st.just("any"), tip=resistances, side=resistances)
gaits = st.lists(st.tuples(*[st.sampled_from([0.0, 0.5, 1.0])] * 3), min_size=1, max_size=5).map(
    lambda middle: Gait("any", ((0, 0, 0), *middle, (0, 0, 0)))
)
