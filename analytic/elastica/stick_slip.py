"""Friction that bends the strip: stick-slip of the two ends at finite strength.

Only the ends carry shear, and it balances, so the strip is under one tension H. An increment of
pressure first leaves both ends where they are, which takes some H; the end whose bound is less
slides as soon as |H| reaches that bound, and then H stays there. So the separation follows the free
one with a play, and as the friction goes to 0 the play closes: section 2.2 of [Majidi13].
"""

import numpy as np

from analytic.chain import node_positions
from analytic.contact import end_loads, side_contact
from analytic.elastica.continuation import follow
from analytic.elastica.newton import Chain, ChainState
from analytic.friction import LAWS, Friction
from analytic.surface import Surface

_LEAST_STEP = 1e-3  # of the way between two tensions, below which the branch is taken to end
_FIRST_PULL, _LEAST_PULL = 0.5, 1e-3  # steps of tension [D0 / L^2]; chosen
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
        self._shares_ties = not (self._downhill or LAWS[friction.law].needs_load)

    def apply(self, before: ChainState, state: ChainState) -> ChainState | None:
        """The equilibrium under friction, from the last one and one at the last tension.

        None if the branch ends on the way, or the weight drags the strip down the slope.
        """
        left, right = self._bounds(state)
        if left == right and self._shares_ties:
            return self._pulled(state, 0.0)  # both slide alike, and neither pulls at the other
        push = min(left, right + self._downhill)  # beyond which an end slides outwards
        pull = min(right, left + self._downhill) - self._downhill  # and inwards
        if push + pull < 0:
            return None
        unit = self._friction.tension / self._chain.force_unit
        low, high = -push * unit, pull * unit
        separation = self._chain.separation(before)
        here = min(max(self._chain.tension, low), high)
        pulled = self._pulled(state, here)
        if pulled is None or low == high:
            return pulled
        gap = self._chain.separation(pulled) - separation
        if abs(gap) <= _STUCK:
            return pulled
        return self._stretched(pulled, here, separation, high if gap < 0 else low)

    def _stretched(
        self, state: ChainState, here: float, separation: float, goal: float
    ) -> ChainState | None:
        """Pull until the ends are as far apart as they were, or one slides at the goal."""
        step = _FIRST_PULL
        short = goal > here
        while here != goal:
            there = min(here + step, goal) if short else max(here - step, goal)
            pulled = self._pulled(state, there)
            if pulled is None:
                step *= 0.25
                if step < _LEAST_PULL:
                    return None
                continue
            if (self._chain.separation(pulled) < separation) != short:
                return self._between(state, here, there, separation)
            state, here, step = pulled, there, 2 * step
        return state

    def _between(
        self, state: ChainState, one: float, two: float, separation: float
    ) -> ChainState | None:
        """The state of a tension between two at which the ends are so far apart."""
        from scipy.optimize import brentq  # slow to import, and seldom needed

        def gap(tension: float) -> float:
            pulled = self._pulled(state, tension)
            return np.nan if pulled is None else self._chain.separation(pulled) - separation

        tension = brentq(gap, one, two, xtol=_STUCK * abs(two - one))
        return self._pulled(state, float(tension))

    def _pulled(self, guess: ChainState, tension: float) -> ChainState | None:
        """The equilibrium under a tension, by way of those between if it is far off."""
        begin = self._chain.tension

        def solve(part: float, near: ChainState) -> ChainState | None:
            self._chain.tension = begin + part * (tension - begin)
            return self._chain.equilibrium(near)

        return follow(guess, solve, first=1.0, shrink=0.25, least=_LEAST_STEP)

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
