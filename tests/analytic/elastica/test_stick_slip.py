"""The elastica's options: sealed pneu-nets, friction that bends the strip, Coulomb's law."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from analytic import (
    GAITS,
    SURFACES,
    Friction,
    Robot,
    displacements,
    pneunet,
    solve_elastica,
    solve_modes,
)
from analytic.elastica.cantilever import solve_cantilever
from analytic.friction import friction_number
from analytic.surface import Surface

ROBOT = Robot()
PHI = friction_number(SURFACES["gelatin"], ROBOT, pneunet.base_rigidity(ROBOT))
PATH = GAITS["wave"].pressures(40) * ROBOT.peak_pressure


@pytest.fixture(scope="module")
def free():
    return solve_elastica(ROBOT, PATH)


def test_a_sealed_heavy_cantilever_is_the_boundary_value_problem_of_the_inverse_gas_law():
    p, length = ROBOT.peak_pressure, ROBOT.length
    weight = ROBOT.weight_per_length

    def slopes(s, u):  # direction and sagging moment; arching curvature is minus theta'
        return np.array([
            -pneunet.sealed_curvature(ROBOT, p, -u[1]),
            weight * (length - s) * np.cos(u[0]),
            np.cos(u[0]),
            np.sin(u[0]),
        ])  # fmt: skip

    s = np.linspace(0, length, 200)
    kappa = float(pneunet.natural_curvature(ROBOT, p))
    guess = np.array(
        [-kappa * s, 0 * s, np.sin(kappa * s) / kappa, (np.cos(kappa * s) - 1) / kappa]
    )
    exact = solve_bvp(slopes, lambda a, b: np.array([a[0], b[1], a[2], a[3]]), s, guess, tol=1e-9)
    assert exact.success
    errors = []
    for links in (24, 48, 96):
        x, y = solve_cantilever(ROBOT, [p] * 3, links, chamber="sealed")
        errors.append(np.hypot(x[-1] - exact.y[2, -1], y[-1] - exact.y[3, -1]) / length)
    assert errors[-1] < 1e-4
    assert errors[0] / errors[-1] > 12  # second order


def test_sealing_changes_little_at_moderate_pressure_and_nothing_at_none(free):
    sealed = solve_elastica(ROBOT, PATH, chamber="sealed")
    assert (sealed.status == 0).all()
    gap = np.abs(sealed.separation - free.separation) / ROBOT.length
    assert gap[0] < 1e-12
    assert 1e-5 < gap.max() < 0.01


def test_sealed_chambers_need_links_that_fit_segments():
    with pytest.raises(ValueError, match="every segment whole"):
        solve_elastica(ROBOT, PATH, links=10, chamber="sealed")


@pytest.mark.parametrize("surface", list(SURFACES))
def test_friction_that_bends_tends_to_the_paper_s_law_as_phi_goes_to_0(free, surface):
    ground = SURFACES[surface]
    limit = displacements(free, ground).per_cycle / ROBOT.length
    gaps, shifts = [], []
    for phi in (1.0, 0.1, 0.01):
        shapes = solve_elastica(
            ROBOT, PATH, ground=ground.scaled(phi / PHI), friction=Friction(tension=1.0)
        )
        assert (shapes.status == 0).all()
        assert shapes.residual.max() < 1e-9
        gaps.append(np.abs(shapes.separation - free.separation).max() / ROBOT.length)
        shifts.append(abs(displacements(shapes, ground).per_cycle / ROBOT.length - limit))
    assert max(shifts) < 0.002
    assert shifts[2] < 1e-4
    assert gaps[2] < 0.015 * max(gaps[0], 1e-7)  # the play goes as Phi, at first order
    if surface == "felt":  # a tip has no friction there, so nothing bends
        assert gaps[0] < 1e-8


def up_and_down(stage, ground):
    """Separation under friction and free of it, on the way to a stage and part of the way back."""
    part = np.concatenate([np.linspace(0, 1, 40), np.linspace(1, 0.6, 40)[1:]])
    path = part[:, None] * np.array(stage) * ROBOT.peak_pressure
    bent = solve_elastica(ROBOT, path, ground=ground, friction=Friction(tension=1.0))
    return bent.separation, solve_elastica(ROBOT, path).separation


def test_on_reversal_both_ends_stick_until_the_play_is_taken_up():
    """A tip on the left, a flat side on the right, which resists more."""
    bent, free = up_and_down((1.0, 0.0, 0.0), SURFACES["polyethylene"].scaled(4.0 / PHI))
    turn = 39
    assert bent[turn + 1] == pytest.approx(bent[turn], abs=1e-9)
    assert free[turn + 1] > free[turn] + 1e-5
    # on the way out friction holds the ends apart, on the way back together
    assert bent[turn] > free[turn]
    assert bent[-1] < free[-1]


def test_two_ends_that_resist_alike_slide_alike_and_pull_at_neither():
    """The paper's rule for ties, at any strength: the shapes are those free of friction."""
    bent, free = up_and_down((1.0, 1.0, 1.0), SURFACES["gelatin"].scaled(40.0 / PHI))
    assert bent == pytest.approx(free, abs=1e-9)


@pytest.mark.parametrize("tension", [-0.1, 1.5, float("nan")])
def test_the_tension_is_a_part_of_the_friction(tension):
    with pytest.raises(ValueError, match="tension"):
        Friction(tension=tension)


def test_coulomb_depends_on_the_ratio_of_coefficients_only(free):
    one = displacements(
        free, Surface("a", friction=0.4, tip_friction=0.2), friction=Friction("coulomb")
    ).per_cycle
    other = displacements(
        free, Surface("b", friction=4.0, tip_friction=2.0), friction=Friction("coulomb")
    ).per_cycle
    assert one == other


def test_under_coulomb_the_lighter_tip_slides(free):
    """Equal coefficients: with two segments inflated the arch leans on its steep end."""
    gelatin = SURFACES["gelatin"]
    coulomb = displacements(free, gelatin, friction=Friction("coulomb"))
    paper = displacements(free, gelatin)
    assert coulomb.per_cycle < 3 * paper.per_cycle  # much farther back
    assert np.allclose(coulomb.right - coulomb.left, paper.right - paper.left)


def test_coulomb_on_felt_is_the_paper_s_as_only_sides_hold(free):
    felt = SURFACES["felt"]
    coulomb, paper = (
        displacements(free, felt, friction=Friction(law)).per_cycle
        for law in ("coulomb", "constant")
    )
    # but for the first instant, when the strip lies wholly flat
    assert coulomb == pytest.approx(paper, rel=1e-4)


def test_coulomb_asks_for_contact_forces():
    with pytest.raises(ValueError, match="contact forces"):
        displacements(solve_modes(ROBOT, PATH), SURFACES["felt"], friction=Friction("coulomb"))
    with pytest.raises(ValueError, match="constant, coulomb"):
        displacements(solve_modes(ROBOT, PATH), SURFACES["felt"], friction=Friction("stick"))
