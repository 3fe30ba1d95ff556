"""Friction that bends the strip: the incremental law at a finite friction number.

Only the ends carry shear, and it balances, so the strip is under one tension H. An increment of
pressure first leaves both ends where they are, which takes some H; the end that resists less slides
as soon as |H| reaches its resistance, and then H stays there. So the separation follows the free
one with a play, and as Phi = V0 L^2 / D0 goes to 0 the play closes: the constant-bound law (section 2.2).
"""

import numpy as np
from scipy.optimize import brentq

from analytic.chain import node_positions
from analytic.contact import side_contact
from analytic.elastica.newton import Chain, ChainState
from analytic.friction import Friction, Surface, coulomb_resistance, sliding_resistance

_STUCK = 1e-9  # separation over L that counts as unchanged


class StickSlip:
    """The law on one chain.

    Args:
        chain: it; its tension is set here.
        surface: the ground.
        friction: law, number and slope.
    """

    def __init__(self, chain: Chain, surface: Surface, friction: Friction) -> None:
        self._chain, self._surface, self._friction = chain, surface, friction
        self._nodes = node_positions(chain.robot, chain.links)
        self._downhill = friction.downhill(chain.robot)

    def apply(self, before: ChainState, found: ChainState) -> ChainState | None:
        """The equilibrium under friction, from the last one and one at the last tension.

        None if the branch ends on the way, or the weight drags the strip down the slope.
        """
        left, right = self._resistances(found)
        push = min(left, right + self._downhill)  # beyond which an end slides outwards
        pull = min(right, left + self._downhill) - self._downhill  # and inwards
        if push + pull < 0:
            return None
        unit = self._friction.number
        low_end, high_end = -push * unit, pull * unit
        if low_end == high_end:
            return self._pulled(found, low_end)
        held = self._chain.separation(before)
        low, high = self._pulled(found, low_end), self._pulled(found, high_end)
        if low is None or high is None:
            return None
        if held >= self._chain.separation(high):
            return high
        if held <= self._chain.separation(low):
            return self._pulled(low, low_end)

        def gap(tension: float) -> float:
            state = self._pulled(found, tension)
            return np.nan if state is None else self._chain.separation(state) - held

        tension = brentq(gap, low_end, high_end, xtol=_STUCK * (high_end - low_end))
        return self._pulled(found, float(tension))

    def _pulled(self, guess: ChainState, tension: float) -> ChainState | None:
        self._chain.tension = tension
        return self._chain.equilibrium(guess)

    def _resistances(self, state: ChainState) -> tuple[float, float]:
        """Of the two ends [V0]."""
        chain, surface = self._chain, self._surface
        robot = chain.robot
        force = chain.ground_force(state)[None, :] * chain.force_unit
        height = state.y[None, :] * robot.length
        ends = side_contact(robot, self._nodes, force, height, chain.pressure[None, :])
        if self._friction.law == "coulomb":
            left, right = coulomb_resistance(robot, surface, ends, force, height)
        else:
            left, right = (sliding_resistance(robot, surface, end) for end in ends)
        return float(left[0]), float(right[0])
