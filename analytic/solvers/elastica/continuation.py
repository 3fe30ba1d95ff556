"""From one equilibrium to the next by way of those between."""

from collections.abc import Callable

from analytic.solvers.elastica.state import ChainState


def follow(
    start: ChainState,
    solve: Callable[[float, ChainState], ChainState | None],
    first: float,
    shrink: float,
    least: float,
) -> ChainState | None:
    """The equilibrium at the end of a way; None if the branch ends on it.

    Steps double where they succeed and shrink where they fail.

    Args:
        start: the equilibrium where the way begins.
        solve: the equilibrium a part of the way along, in (0, 1], from one near it; None if none.
        first: step to begin with, as a part of the way.
        shrink: factor on a step that failed.
        least: step below which the branch is taken to end.
    """
    done, step, state = 0.0, first, start
    while done < 1.0:
        step = min(step, 1.0 - done)
        candidate = solve(done + step, state)
        if candidate is None:
            step *= shrink
            if step < least:
                return None
        else:
            state, done, step = candidate, done + step, 2 * step
    return state
