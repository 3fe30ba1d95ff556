"""A heavy strip, clamped level at its left end, sags to rest; needs no MuJoCo.

The load is w L^3 / D = 32.96, for which tables of heavy cantilevers give the tip; here the boundary
value problem of the elastica gives it. One clamp for all: the direction of the strip at the wall is
that of the first link, which is centred on the wall or has half an element's length or less; a
whole link welded to the wall would be of first order. One damping for all: by strain rate, with the
time constant DAMPING.
"""

import math
from functools import cache

import numpy as np
from scipy.integrate import simpson, solve_bvp

from analytic import Robot
from analytic.scene import pneunet
from studies.accuracy.rows import Row, row
from studies.accuracy.setting import Setting
from studies.accuracy.timing import Timing

CASE, TIP = "cantilever", "tip"
LOAD = 32.96  # w L^3 / D0; chosen, a load for which tips are published
DAMPING = 0.2  # s; chosen, about critical for the lowest mode
DURATION = 6.0  # s, after which what still moves is below 1e-6 L; chosen


def strip() -> Robot:
    """The default robot without pressure, as heavy as LOAD asks."""
    return pneunet.with_load(Robot(), LOAD)


@cache
def exact() -> tuple[float, float]:
    """(x, y) of the tip over L: theta'' = -LOAD (1 - s) cos(theta), theta(0) = theta'(1) = 0.

    The elastica of a heavy strip, theta downwards: the weight w (L - s) of the rest bends it.
    """
    s = np.linspace(0, 1, 401)
    state = np.zeros((2, len(s)))
    for load in np.linspace(0, LOAD, 12)[1:]:
        solution = solve_bvp(
            lambda s, u, load=load: np.array([u[1], -load * (1 - s) * np.cos(u[0])]),
            lambda a, b: np.array([a[0], b[1]]),
            s, state, tol=1e-10, max_nodes=100_000,
        )  # fmt: skip
        state = solution.sol(s)
    fine = np.linspace(0, 1, 20_001)
    theta = solution.sol(fine)[0]  # downwards, so y is minus its sine
    return float(simpson(np.cos(theta), x=fine)), -float(simpson(np.sin(theta), x=fine))


def settled(setting: Setting, tip: tuple[float, float], timing: Timing, status: str) -> Row:
    """The row of a tip (x, y) over L."""
    return row(CASE, TIP, setting, math.dist(tip, exact()), 0.0, timing, status)
