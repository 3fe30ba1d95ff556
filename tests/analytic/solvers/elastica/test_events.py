import numpy as np
import pytest

from analytic.solvers.elastica.events import Event
from analytic.solvers.elastica.points import Point


def _point(row, place, slopes):
    """A state whose measure is 0 at a place of the path, by one slope before it and one after."""
    away = row - place
    return Point(row, None, None, measures=np.array([slopes[away > 0] * away]))


def _tries(event, state, is_after, width):
    """Number of rows that are tried until so many are left between what is before and after."""
    tries = 0
    while event.width > width:
        row = event.next(width)
        event.narrow(state(row), is_after(row))
        tries += 1
    return tries


@pytest.mark.parametrize("slopes", [(1.0, 1.0), (-1e-6, -3.0), (2.0, 1e-5)])
@pytest.mark.parametrize("place", [0.5, 0.0123, 0.98765])
def test_a_kink_is_located_in_a_few_states_where_bisection_takes_thirty(place, slopes):
    def state(row):
        return _point(row, place, slopes)

    event = Event([state(-1.0), state(0.0)], state(1.0))
    assert _tries(event, state, lambda row: row > place, 1e-9) <= 12
    assert event.before.row <= place <= event.after.row


def test_what_goes_through_nothing_is_located_by_bisection():
    event = Event([Point(0.0, None, None)], Point(1.0, None, None))
    tries = _tries(event, lambda row: Point(row, None, None), lambda row: row > 0.3, 1e-9)
    assert tries == 30  # 2**-30 is the first power below
    assert event.before.row <= 0.3 <= event.after.row
