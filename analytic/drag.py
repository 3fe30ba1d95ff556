"""Friction that bends the strip: the incremental law at a finite friction number.

Only the ends carry shear, and it balances, so the strip is under one tension H. An increment of
pressure first leaves both ends where they are, which takes some H; the end that resists less slides
as soon as |H| reaches its resistance, and then H stays there. So the separation follows the free
one with a play, and as Phi = V0 L^2 / D0 goes to 0 the play closes: the paper's law (section 2.2).
"""

import numpy as np
from scipy.optimize import brentq

from analytic.chain import node_positions
from analytic.equilibrium import Chain, ChainState
from analytic.friction import LAWS, Surface, coulomb_resistance, sliding_resistance
from analytic.touching import side_contact

_STUCK = 1e-9  # separation over L that counts as unchanged


class Drag:
    """The law on one chain.

    Args:
        chain: it; its tension is set here.
        surface: the ground.
        friction_number: Phi [1].
        law: of what an end resists by; under "coulomb" V0 is that of a load of half the weight.
    """

    def __init__(
        self, chain: Chain, surface: Surface, friction_number: float, law: str = "paper"
    ) -> None:
        if not (np.isfinite(friction_number) and friction_number > 0):
            raise ValueError(
                f"friction_number must be a positive finite number, got {friction_number!r}"
            )
        if law not in LAWS:
            raise ValueError(f"law must be one of {', '.join(LAWS)}; got {law!r}")
        self._law = law
        self._chain, self._surface, self._number = chain, surface, friction_number
        self._nodes = node_positions(chain.robot, chain.links)

    def apply(self, before: ChainState, found: ChainState) -> ChainState | None:
        """The equilibrium under friction, from the last one and one at the last tension.

        None if the branch ends on the way.
        """
        bound = self._bound(found)
        if bound == 0:
            return self._pulled(found, 0.0)
        held = self._chain.separation(before)
        low, high = self._pulled(found, -bound), self._pulled(found, bound)
        if low is None or high is None:
            return None
        if held >= self._chain.separation(high):
            return high
        if held <= self._chain.separation(low):
            return self._pulled(low, -bound)

        def gap(tension: float) -> float:
            state = self._pulled(found, tension)
            return np.nan if state is None else self._chain.separation(state) - held

        tension = brentq(gap, -bound, bound, xtol=_STUCK * bound)
        return self._pulled(found, float(tension))

    def _pulled(self, guess: ChainState, tension: float) -> ChainState | None:
        self._chain.tension = tension
        return self._chain.equilibrium(guess)

    def _bound(self, state: ChainState) -> float:
        """Resistance of the weaker end over D0 / L^2."""
        chain = self._chain
        robot = chain.robot
        force = chain.ground_force(state)[None, :] * chain.force_unit
        height = state.y[None, :] * robot.length
        ends = side_contact(robot, self._nodes, force, height, chain.pressure[None, :])
        if self._law == "coulomb":
            hold = coulomb_resistance(robot, self._surface, ends, force, height)
        else:
            hold = tuple(sliding_resistance(robot, self._surface, end) for end in ends)  # type: ignore[assignment]
        return self._number * min(float(resistance[0]) for resistance in hold)
