"""Who sticks and who slides on an elastic body, against optimisers that know nothing of contact."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import minimize

from analytic.friction.dissipation import least_dissipation
from analytic.solvers.elastica.tractions import tractions

eighths = st.integers(-16, 16).map(lambda i: i / 8)


@st.composite
def bodies(draw, most=5):
    """Gaps, compliance, bounds."""
    count = draw(st.integers(2, most))
    row = st.lists(eighths, min_size=count, max_size=count).map(np.array)
    factor = np.array([draw(row) for _ in range(count)])
    bounds = np.abs(draw(row))
    return draw(row), factor @ factor.T / count, bounds


@given(bodies())
def test_the_tractions_are_those_of_least_complementary_energy(body):
    """min t K t / 2 + g t over |t| <= V with sum t = 0, by sequential quadratic programming."""
    gaps, compliance, bounds = body
    solution = tractions(gaps, compliance, bounds, np.zeros(len(gaps)))

    def energy(t):
        return 0.5 * t @ compliance @ t + gaps @ t

    best = minimize(
        energy, np.zeros(len(gaps)), jac=lambda t: compliance @ t + gaps, method="SLSQP",
        bounds=[(-v, v) for v in bounds], options={"ftol": 1e-12, "maxiter": 500},
        constraints={"type": "eq", "fun": np.sum, "jac": lambda t: np.ones(len(t))},
    )  # fmt: skip
    assume(best.success)
    assert energy(solution.traction) == pytest.approx(best.fun, abs=1e-4)


@given(bodies())
def test_each_contact_sticks_below_its_bound_or_slides_against_it(body):
    gaps, compliance, bounds = body
    solution = tractions(gaps, compliance, bounds, np.zeros(len(gaps)))
    slips = gaps + solution.whole + compliance @ solution.traction
    assert abs(solution.traction.sum()) < 1e-9
    assert (np.abs(solution.traction) <= bounds + 1e-5).all()
    moving = np.abs(slips) > 1e-6
    held = solution.traction + np.sign(slips) * bounds
    assert np.abs(held[moving]).max(initial=0.0) < 1e-4


@given(st.lists(st.tuples(eighths, eighths), min_size=1, max_size=7).map(np.array))
def test_on_a_stiff_body_it_is_least_dissipation(drawn):
    moves, bounds = drawn[:, 0], np.abs(drawn[:, 1])
    count = len(moves)
    solution = tractions(moves, np.zeros((count, count)), bounds, np.zeros(count))
    assert solution.whole == pytest.approx(least_dissipation(bounds, moves), abs=1e-5)


def test_viscous_contacts_share_a_motion_by_their_resistance():
    moves, drag = np.array([0.0, 1.0]), np.array([1.0, 3.0])
    solution = tractions(moves, np.zeros((2, 2)), np.zeros(2), drag)
    assert solution.whole == pytest.approx(-0.75)
    assert solution.traction == pytest.approx([0.75, -0.75])


def test_a_pull_beyond_all_bounds_has_no_answer_and_a_viscous_one_a_speed():
    none, stiff = np.zeros(2), np.zeros((2, 2))
    assert tractions(none, stiff, np.array([1.0, 0.5]), none, pull=1.6) is None
    held = tractions(none, stiff, np.array([1.0, 0.5]), none, pull=1.4)
    assert held.traction.sum() == pytest.approx(1.4)
    slid = tractions(none, stiff, np.array([1.0, 0.5]), np.array([1.0, 1.0]), pull=1.7)
    assert slid.whole == pytest.approx(-0.1)
