"""The strip with finite rotations, followed quasi-statically: the reference."""

from analytic.solvers.elastica.solver import LINKS, solve_elastica

__all__ = ["LINKS", "solve_elastica"]
