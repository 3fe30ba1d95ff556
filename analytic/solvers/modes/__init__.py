"""The contact modes of [Majidi13], Appendix A: small slopes, closed form."""

from analytic.solvers.modes.solver import solve_modes

__all__ = ["solve_modes"]
