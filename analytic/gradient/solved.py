"""States in balance, at a place on the ramp or where a condition is met."""

import numpy as np
from numpy.typing import NDArray

from analytic.gradient.bordered import solve_bordered
from analytic.gradient.equilibrium import Balance, Condition, Contacts

Array = NDArray[np.float64]

_CONVERGED, _ENOUGH = 1e-12, 1e-9  # change of unknowns in a step, and in the last; chosen
_STEPS = 12  # of Newton's method, at most; chosen


class UnclearError(Exception):
    """Failure to tell what ends a slide; the text says why there is no derivative."""


def solved(balance: Balance, u: Array, contacts: Contacts, place: Condition | None) -> Array:
    """Unknowns that balance, at the place of u or where a condition is met.

    Raises:
        UnclearError: Newton's method finds none.
    """
    for step_number in range(_STEPS):
        system, right = bordered(balance, u, contacts, place)
        try:
            step = solve_bordered(system, -right)
        except np.linalg.LinAlgError:
            break
        u = u + step
        size = np.abs(step / np.maximum(1.0, np.abs(u))).max()
        if not size < 10.0:
            break
        if size < _CONVERGED or (size < _ENOUGH and step_number == _STEPS - 1):
            return u
    raise UnclearError("a state where contacts change is not found")


def bordered(
    balance: Balance, u: Array, contacts: Contacts, place: Condition | None
) -> tuple[Array, Array]:
    """Jacobian (M, M) and residual (M,) of balance and place, which is fixed if None."""
    right = np.append(balance.residual(u, contacts), 0.0)
    row = np.eye(len(u))[-1]
    if place is not None:
        row = balance.slope(u, contacts, place)
        right[-1] = balance.condition(u, contacts, place)
    return np.vstack([balance.jacobian(u, contacts), row]), right
