"""The two numbers of the paper's robot that it leaves open: `python -m studies.identification`.

[Majidi13] gives neither the weight nor the curvature of its robot, but states two things of it: on
polyethylene, {V_t, tau} = {0.5, 1}, the robot does not move, and it undulates at the amplitude that
it calls the best, a quarter of the length. With the default gait the elastica meets both at one
weight per length w and one chamber height H, the other numbers being as chosen; in dimensionless
terms Gamma = w L^3 / D0 and kappa L = alpha p L.
"""

import sys
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from analytic.prediction import predict
from analytic.scene import pneunet
from analytic.scene.gait import GAITS, Gait
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from analytic.solvers.models import Elastica
from studies import Array

AMPLITUDE = 0.25  # greatest height over L; [Majidi13], section 3
_walk = partial(predict, solver=Elastica(links=120), states_per_ramp=100)
_DIGITS = 4
_STEP = 1e-2  # relative, of the finite differences
_SCATTER = 3e-5  # of the statements over L, by where states and links happen to fall; measured


class Statements(NamedTuple):
    """Displacement on polyethylene and greatest height, over L."""

    displacement: float
    amplitude: float


def statements(robot: Robot, gait: Gait = GAITS["wave"]) -> Statements:
    """Both numbers of a robot."""
    walk = _walk(robot, gait, SURFACES["polyethylene"])
    lengths = walk.locomotion.per_cycle, float(walk.shapes.amplitude.max())
    return Statements(*(length / robot.length for length in lengths))


def identify(start: Robot, gait: Gait = GAITS["wave"]) -> Robot:
    """The robot of both statements, by its weight per length and its chamber height.

    Newton's method with finite differences; the numbers are rounded to as many digits as they have
    in the code.

    Args:
        start: a robot near it; its other numbers stay.
        gait: of both statements.

    Raises:
        ArithmeticError: no robot was found.
    """
    numbers = np.log([start.weight_per_length, start.chamber_height])
    for _ in range(12):
        misses = _misses(start, numbers, gait)
        if np.abs(misses).max() < _SCATTER:
            weight, height = (float(f"{x:.{_DIGITS}g}") for x in np.exp(numbers))
            return replace(start, weight_per_length=weight, chamber_height=height)
        slopes = [(_misses(start, numbers + step, gait) - misses) / _STEP
                  for step in _STEP * np.eye(2)]  # fmt: skip
        numbers = numbers - np.linalg.solve(np.transpose(slopes), misses)
    raise ArithmeticError(f"no robot meets both statements near {start!r}")


def _misses(start: Robot, numbers: Array, gait: Gait) -> Array:
    weight, height = np.exp(numbers).tolist()
    robot = replace(start, weight_per_length=weight, chamber_height=height)
    return np.array(statements(robot, gait)) - (0.0, AMPLITUDE)


def main() -> int:
    """Print what the two statements identify, beside what the code has."""
    robot = identify(Robot())
    print(f"w = {robot.weight_per_length} N/m, H = {robot.chamber_height} m "
          f"(in the code {Robot.weight_per_length} and {Robot.chamber_height})")  # fmt: skip
    print(f"Gamma = {pneunet.load_number(robot):.4f}, "
          f"kappa L = {pneunet.turn_number(robot):.4f}")  # fmt: skip
    print(f"greatest height {statements(robot).amplitude:.5f} L; displacement per cycle / L:")
    for name, surface in SURFACES.items():
        shift = _walk(robot, GAITS["wave"], surface).locomotion.per_cycle / robot.length
        print(f"  {name:<14}{shift:+.5f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
