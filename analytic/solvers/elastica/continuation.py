"""Continuation: from one equilibrium to the next by way of those between."""

from collections.abc import Callable

from analytic.solvers.elastica.state import ChainState


def follow(
    state: ChainState,
    solve: Callable[[float, float, ChainState], ChainState | None],
    first: float,
    least: float,
) -> tuple[float, ChainState]:
    """Follow a branch of equilibria as far as it goes: the part of the way, and the state there.

    Steps double where they succeed and halve where they fail.

    Args:
        state: the equilibrium where the way begins.
        solve: the equilibrium at the end of a step, from where the step begins and ends, as parts
            of the way in [0, 1], and the equilibrium at its beginning; None if there is none.
        first: step to begin with, as a part of the way.
        least: step below which the branch is taken to end.
    """
    part, step = 0.0, first
    while part < 1.0 and step >= least:
        step = min(step, 1.0 - part)
        candidate = solve(part, part + step, state)
        if candidate is None:
            step *= 0.5
        else:
            state, part, step = candidate, part + step, 2 * step
    return part, state
