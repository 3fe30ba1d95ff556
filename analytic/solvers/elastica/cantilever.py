"""The heavy strip clamped at its left end, without ground: the chain's exact test."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene.chain import link_lengths
from analytic.scene.pressures import check_pressures
from analytic.scene.robot import Robot
from analytic.solvers.elastica.continuation import follow
from analytic.solvers.elastica.newton import Chain
from analytic.solvers.elastica.state import ChainState

Array = NDArray[np.float64]

_FIRST, _LEAST = 0.05, 1e-6  # steps of weight and pressure on the way from the straight strip


def solve_cantilever(
    robot: Robot, pressure_pa: ArrayLike, links: int = 60, chamber: str = "linearized"
) -> tuple[Array, Array]:
    """Nodes (x, y) of the strip clamped horizontally at its left end, each (N + 2,) [m].

    Args:
        robot: the strip.
        pressure_pa: of the segments, shape (S,) [Pa].
        links: of the chain; the error falls with its square.
        chamber: the moment law of the pneu-nets, see analytic.scene.chain.

    Raises:
        ValueError: the pressure is bad.
        ArithmeticError: no stable equilibrium was found on the way from the straight strip.
    """
    (pressure,) = check_pressures(robot, pressure_pa, both_ways=chamber != "sealed")
    chain = Chain(robot, links, chamber, clamped=True)
    weight = chain.weight

    def solve(_: float, end: float, near: ChainState) -> ChainState | None:
        chain.weight = end * weight
        chain.load_at(end * pressure)
        return chain.equilibrium(near)

    part, state = follow(chain.flat(), solve, _FIRST, _LEAST)
    if part < 1.0:
        raise ArithmeticError(f"no stable equilibrium beyond {part:.2%} of the load")
    x = np.concatenate([[0.0], np.cumsum(link_lengths(robot, links) * np.cos(state.theta))])
    return x, robot.length * state.y
