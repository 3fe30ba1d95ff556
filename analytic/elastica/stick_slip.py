"""Friction that bends the strip: stick-slip of the two ends at finite strength.

Only the ends carry shear, and it balances, so the strip is under one tension H. An increment of
pressure first leaves both ends where they are, which takes some H; the end whose bound is less
slides as soon as |H| reaches that bound, and then H stays there. So the separation follows the free
one with a play, and as the friction goes to 0 the play closes: section 2.2 of [Majidi13].
"""

import numpy as np

from analytic.chain import node_positions
from analytic.contact import end_loads, side_contact
from analytic.elastica.newton import Chain, ChainState
from analytic.friction import LAWS, Friction
from analytic.surface import Surface

_STUCK = 1e-9  # separation over L that counts as unchanged


class StickSlip:
    """The law on one chain.

    Args:
        chain: it; its tension is set here.
        surface: the ground.
        friction: law, tension and slope.
    """

    def __init__(self, chain: Chain, surface: Surface, friction: Friction) -> None:
        self._chain, self._surface, self._friction = chain, surface, friction
        self._nodes = node_positions(chain.robot, chain.links)
        self._downhill = friction.downhill(chain.robot)

    def apply(self, before: ChainState, state: ChainState) -> ChainState | None:
        """The equilibrium under friction, from the last one and one at the last tension.

        None if the branch ends on the way, or the weight drags the strip down the slope.
        """
        left, right = self._bounds(state)
        push = min(left, right + self._downhill)  # beyond which an end slides outwards
        pull = min(right, left + self._downhill) - self._downhill  # and inwards
        if push + pull < 0:
            return None
        unit = self._friction.tension / self._chain.force_unit
        low_end, high_end = -push * unit, pull * unit
        if low_end == high_end:
            return self._pulled(state, low_end)
        separation = self._chain.separation(before)
        low, high = self._pulled(state, low_end), self._pulled(state, high_end)
        if low is None or high is None:
            return None
        if separation >= self._chain.separation(high):
            return high
        if separation <= self._chain.separation(low):
            return self._pulled(low, low_end)

        def gap(tension: float) -> float:
            pulled = self._pulled(state, tension)
            return np.nan if pulled is None else self._chain.separation(pulled) - separation

        from scipy.optimize import brentq  # slow to import, and seldom needed

        tension = brentq(gap, low_end, high_end, xtol=_STUCK * (high_end - low_end))
        return self._pulled(state, float(tension))

    def _pulled(self, guess: ChainState, tension: float) -> ChainState | None:
        self._chain.tension = tension
        return self._chain.equilibrium(guess)

    def _bounds(self, state: ChainState) -> tuple[float, float]:
        """Of the two ends [N]."""
        chain, robot, law = self._chain, self._chain.robot, LAWS[self._friction.law]
        force = chain.ground_force(state)[None, :] * chain.force_unit
        height = state.y[None, :] * robot.length
        contact = side_contact(robot, self._nodes, force, height, chain.pressure[None, :])
        load = end_loads(force, height)
        left, right = (
            law.bound(self._surface, robot.width, contact[end], load[end]) for end in (0, 1)
        )
        return float(left[0]), float(right[0])
