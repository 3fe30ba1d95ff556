import numpy as np
import pytest

from analytic.solvers.elastica.events import Event
from analytic.solvers.elastica.points import Point


def _point(row, place, slopes):
    """A state whose measure is 0 at a place of the path, by one slope before it and one after."""
    away = row - place
    return Point(row, None, None, measures=np.array([slopes[away > 0] * away]))


@pytest.mark.parametrize("slopes", [(1.0, 1.0), (-1e-6, -3.0), (2.0, 1e-5)])
@pytest.mark.parametrize("place", [0.5, 0.0123, 0.98765])
def test_a_kink_is_located_in_a_few_states_where_bisection_takes_thirty(place, slopes):
    event = Event(
        [_point(-1.0, place, slopes), _point(0.0, place, slopes)], _point(1.0, place, slopes)
    )
    for tried in range(30):
        if event.width <= 1e-9:
            break
        row = event.next(1e-9)
        event.narrow(_point(row, place, slopes), row > place)
    assert event.before.row <= place <= event.after.row
    assert event.width <= 1e-9 and tried <= 12


def test_what_gives_no_sign_is_located_by_bisection():
    event = Event([Point(0.0, None, None)], Point(1.0, None, None))
    for _ in range(30):
        row = event.next(1e-9)
        event.narrow(Point(row, None, None), row > 0.3)
    assert event.before.row <= 0.3 <= event.after.row and event.width <= 2 * 2.0**-30
