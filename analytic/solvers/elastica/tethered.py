"""Tether of a chain: one more contact, and a spring back to where it began."""

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contacts import StripContact, of_tether
from analytic.solvers.elastica.newton import Chain

Array = NDArray[np.float64]


class TetherPull:
    """Spring of a tether on one chain, which lies flat from x = 0 on where it is at rest.

    Args:
        chain: of the strip.
        nodes: arclength of its nodes [m].
        unit: of forces, times the part of friction that bends the strip [1/N].

    Attributes:
        contacts: the tether, if it resists.
        stiffness: of its spring [D0 / L^3].
    """

    def __init__(self, chain: Chain, nodes: Array, unit: float) -> None:
        robot = chain.robot
        self.contacts: list[StripContact] = of_tether(robot, nodes)
        self._chain, self._hanging = chain, chain.hanging
        self.stiffness = robot.tether.stiffness * robot.length * unit if robot.tether else 0.0
        self._at = robot.tether.at if robot.tether else 0.0
        share = np.zeros(len(nodes))
        for contact in self.contacts:
            share[contact.nodes] = contact.share
        self._share, self._beyond = share, np.cumsum(share)[:-1]

    def springs(self, contacts: list[StripContact]) -> Array:
        """Stiffness of the spring on each contact, (C,) [D0 / L^3]."""
        return np.array([0.0 if c.drag is None else self.stiffness for c in contacts])

    def pull(self, places: Array) -> float:
        """Pull towards -x at places of the nodes over L, which the chain carries [D0 / L^2]."""
        if not self.stiffness:
            return 0.0
        pull = self.stiffness * float(self._share @ places - self._at)
        self._chain.hanging = self._hanging + pull * self._beyond
        return pull
