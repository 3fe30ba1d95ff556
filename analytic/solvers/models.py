"""Quasi-static solvers by name, each with its options and what it can do."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from analytic.friction.laws import Friction
from analytic.scene.ground import surfaces_of
from analytic.scene.robot import Robot
from analytic.scene.surface import Ground
from analytic.shapes import Shapes

Array = NDArray[np.float64]


class Solver(Protocol):
    """Finds equilibria along a path of pressures; its options are its fields.

    Attributes:
        name: how commands call it.
    """

    name: ClassVar[str]

    def solve(
        self,
        robot: Robot,
        pressures: Array,
        ground: Ground,
        friction: Friction,
        times: Array | None,
    ) -> Shapes:
        """Equilibria at pressures of shape (B, S) [Pa] at times (B,) [s].

        Raises:
            ValueError: the solver cannot do what the scene asks for.
        """
        ...


class _Unbent(ABC):
    """A solver whose shapes no friction bends: its `shapes` depend on pressures alone."""

    name: ClassVar[str]

    def solve(
        self,
        robot: Robot,
        pressures: Array,
        ground: Ground,
        friction: Friction,
        times: Array | None,
    ) -> Shapes:
        """See Solver.solve."""
        if any(surface.adhesion for surface in surfaces_of(ground)):
            raise ValueError(f"{REFERENCE} alone knows adhesive ground, got solver {self.name!r}")
        if friction.tension:
            raise ValueError(
                f"{REFERENCE} alone lets friction bend the strip, got solver {self.name!r}"
            )
        return self.shapes(robot, pressures)

    @abstractmethod
    def shapes(self, robot: Robot, pressures: Array) -> Shapes:
        """Equilibria at pressures of shape (B, S) [Pa]."""


@dataclass(frozen=True)
class Modes(_Unbent):
    """The contact modes of [Majidi13], Appendix A: small slopes, one flat end, closed form."""

    name: ClassVar[str] = "modes"

    def shapes(self, robot: Robot, pressures: Array) -> Shapes:
        """Equilibria at pressures of shape (B, S) [Pa]."""
        from analytic.solvers.modes import solve_modes

        return solve_modes(robot, pressures)


@dataclass(frozen=True)
class Lifted(_Unbent):
    """The contact modes with finite rotations: one flat end or none, robots of any segments."""

    name: ClassVar[str] = "lifted"

    def shapes(self, robot: Robot, pressures: Array) -> Shapes:
        """Equilibria at pressures of shape (B, S) [Pa]."""
        from analytic.solvers.lifted import solve_lifted

        return solve_lifted(robot, pressures)


@dataclass(frozen=True)
class Obstacle(_Unbent):
    """Small slopes, exact contact."""

    name: ClassVar[str] = "obstacle"
    elements: int = 60

    def shapes(self, robot: Robot, pressures: Array) -> Shapes:
        """Equilibria at pressures of shape (B, S) [Pa]."""
        from analytic.solvers.obstacle import solve_obstacle

        return solve_obstacle(robot, pressures, self.elements)


@dataclass(frozen=True)
class Elastica:
    """Finite rotations, exact contact: the reference.

    Args:
        links: of the chain.
        chamber: law of the chambers, see analytic.scene.chain.
    """

    name: ClassVar[str] = "elastica"
    links: int = 60
    chamber: str = "linearized"

    def solve(
        self,
        robot: Robot,
        pressures: Array,
        ground: Ground,
        friction: Friction,
        times: Array | None,
    ) -> Shapes:
        """See Solver.solve."""
        from analytic.solvers.elastica import solve_elastica

        return solve_elastica(
            robot, pressures, self.links, self.chamber, ground, friction, times, added=True
        )


SOLVERS: dict[str, type[Solver]] = {kind.name: kind for kind in (Modes, Lifted, Obstacle, Elastica)}
REFERENCE = Elastica.name
