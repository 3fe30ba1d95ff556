"""The elastica's options: sealed pneu-nets, friction that bends the strip, Coulomb's law."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_bvp
from scipy.optimize import brentq, minimize

from analytic import (
    GAITS,
    SURFACES,
    Elastica,
    Flag,
    Friction,
    Gait,
    Patches,
    Robot,
    displacements,
    predict,
    solve_elastica,
    solve_modes,
)
from analytic.friction.laws import friction_number
from analytic.scene import pneunet
from analytic.scene.surface import Surface
from analytic.solvers.elastica.cantilever import solve_cantilever
from analytic.solvers.elastica.newton import Chain
from analytic.solvers.elastica.stick_slip import StickSlip

ROBOT = Robot()
PHI = friction_number(SURFACES["gelatin"], ROBOT, pneunet.base_rigidity(ROBOT))
BENT = Friction(tension=1.0)
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
    limit = predict(ROBOT, GAITS["wave"], ground).locomotion.per_cycle / ROBOT.length
    gaps, shifts = [], []
    for phi in (1.0, 0.1, 0.01):
        shapes = solve_elastica(
            ROBOT, PATH, ground=ground.scaled(phi / PHI), friction=Friction(tension=1.0)
        )
        assert (shapes.status == 0).all()
        assert shapes.residual.max() < 1e-9
        gaps.append(np.abs(shapes.separation - free.separation).max() / ROBOT.length)
        shifts.append(abs(shapes.left[-1] / ROBOT.length - limit))
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


def test_two_ends_that_resist_alike_slide_alike():
    path = np.linspace(0, 1, 40)[:, None] * np.ones(3) * ROBOT.peak_pressure
    bent = solve_elastica(ROBOT, path, ground=SURFACES["gelatin"], friction=Friction(tension=1.0))
    assert bent.left == pytest.approx(-0.5 * (bent.separation - ROBOT.length), abs=1e-8)
    free = solve_elastica(ROBOT, path)
    assert bent.separation[-1] > free.separation[-1]  # and pull at each other as they do


def separation(chain, state):
    return chain.length @ np.cos(state.theta)


def small_chain(links=6):
    chain = Chain(ROBOT, links)
    return chain, StickSlip(chain, SURFACES["polyethylene"].scaled(4.0 / PHI), BENT)


def by_optimiser(chain, before, bounds, start):
    """min energy + V |slip| over shapes above the ground, by sequential quadratic programming.

    Unknowns: directions, height and place of the left end, slip forth and back of either end.
    """
    n, l = chain.links + 1, chain.length  # noqa: E741

    def heights(u):
        return u[n] + np.concatenate([[0.0], np.cumsum(l * np.sin(u[:n]))])

    def cost(u):
        bend = 0.5 * chain.stiffness @ (np.diff(u[:n]) - chain.rest) ** 2
        return bend + chain.weight @ heights(u) + bounds @ (u[n + 2 : n + 4] + u[n + 4 :])

    def slips(u):
        ends = np.array([u[n + 1], u[n + 1] + l @ np.cos(u[:n])])
        return ends - before - u[n + 2 : n + 4] + u[n + 4 :]

    free = [(None, None)] * (n + 2) + [(0.0, None)] * 4
    return minimize(
        cost, start, method="SLSQP", bounds=free, options={"ftol": 1e-15, "maxiter": 1000},
        constraints=[{"type": "ineq", "fun": heights}, {"type": "eq", "fun": slips}],
    )  # fmt: skip


def test_an_increment_is_the_least_energy_and_dissipation_that_an_optimiser_finds():
    chain, grip = small_chain()
    state = chain.flat()
    for part in np.linspace(0, 1, 20):
        chain.load_at(part * np.array([1.0, 0.0, 0.0]) * ROBOT.peak_pressure)
        grip.begin(state)
        state = chain.equilibrium(state, grip)
    for stage in ([0.9, 0.0, 0.0], [1.0, 0.1, 0.0], [1.0, 0.3, 0.0]):
        chain.load_at(np.array(stage) * ROBOT.peak_pressure)
        grip.begin(state)
        equilibrium = chain.equilibrium(state, grip)
        ends = np.array([state.left, state.left + separation(chain, state)])
        bounds = grip.bounds
        start = np.concatenate([state.theta, [state.y[0], state.left], np.zeros(4)])
        best = by_optimiser(chain, ends, bounds, start)
        assert best.x[: chain.links + 1] == pytest.approx(equilibrium.theta, abs=1e-7)
        if bounds[0] != bounds[1]:  # a tie is decided by less than energy
            assert best.x[chain.links + 2] == pytest.approx(equilibrium.left, abs=1e-7)
        state = equilibrium


def test_between_two_anchors_the_thrust_is_that_of_the_shallow_arch():
    """Without weight: y = kappa / k^2 (cos k(s - L/2) / cos kL/2 - 1), k^2 = -H / D.

    The ends stay as far apart as they were at less curvature, which takes a tension H.
    """
    robot = replace(ROBOT, weight_per_length=2e-3, rigidity_per_pressure=1e-12)
    chain = Chain(robot, 24)
    grip = StickSlip(chain, SURFACES["gelatin"].scaled(1e6), BENT)
    state = chain.flat()
    for part in np.linspace(0.0, 0.05, 20):
        chain.load_at(part * np.ones(3) * robot.peak_pressure)
        state = chain.equilibrium(state)
    for part in np.linspace(0.05, 0.1, 10):
        chain.load_at(part * np.ones(3) * robot.peak_pressure)
        grip.begin(state)
        state = chain.equilibrium(state, grip)
    tension = state.tension[0]
    kappa = float(pneunet.natural_curvature(robot, 0.1 * robot.peak_pressure)) * robot.length

    def shortening(h):  # over L, H > 0: cosh for cos
        k = np.sqrt(h)
        s = np.linspace(-0.5, 0.5, 4001)
        slope = kappa / k * np.sinh(k * s) / np.cosh(k / 2)
        return 0.5 * np.trapezoid(slope**2, s)

    exact = brentq(lambda h: shortening(h) - (0.5 * kappa) ** 2 / 24, 1e-3, 100.0)
    assert tension == pytest.approx(exact, rel=0.01)


TIPS = ((0.5, 0.5, 0.5), (1, 0.5, 0.5), (1, 1, 0.5), (0.5, 1, 1), (0.5, 0.5, 1), (0.5, 0.5, 0.5))


def energy_balance(ground, per_ramp):
    """Work of the pressure and dissipation of a second cycle, and the sum of its work's sizes."""
    rise = np.linspace(0, 1, per_ramp)[:, None] * np.array(TIPS[0])
    walk = Gait("tips", TIPS).pressures(per_ramp, cycles=2)[1:]
    path = np.concatenate([rise, walk]) * ROBOT.peak_pressure
    chain = Chain(ROBOT, 60)
    grip = StickSlip(chain, ground, BENT)
    state, rows = chain.flat(), []

    def energy(state):
        return 0.5 * chain.stiffness @ (np.diff(state.theta) - chain.rest) ** 2

    for before, after in pairwise(path):
        ends = np.array([state.left, state.left + separation(chain, state)])
        chain.load_at(before)
        old = energy(state)
        chain.load_at(after)
        done = energy(state) - old  # pressure changes the springs before the shape
        grip.begin(state)
        new = chain.equilibrium(state, grip)
        chain.load_at(before)
        there = energy(new)
        chain.load_at(after)
        done = 0.5 * (done + energy(new) - there)
        slips = np.array([new.left, new.left + separation(chain, new)]) - ends
        rows.append((done, float(grip.bounds @ np.abs(slips))))
        state = new
    work, lost = np.array(rows[-5 * per_ramp :]).T
    return work.sum(), lost.sum(), np.abs(work).sum()


@pytest.mark.slow
def test_the_work_of_the_pressure_in_a_cycle_is_what_friction_dissipates():
    """Both ends stay tips, so that no bound jumps: then energy is lost besides, at once."""
    grippier_left = Patches("halves", (0.05,), (SURFACES["gelatin"].scaled(4 / PHI),
                                                SURFACES["gelatin"].scaled(2 / PHI)))  # fmt: skip
    gaps = []
    for per_ramp in (25, 50, 100, 200):
        work, lost, gross = energy_balance(grippier_left, per_ramp)
        gaps.append(abs(work - lost) / gross)
        assert lost > 0.01 * gross
    assert gaps[-1] < 1e-5
    assert gaps[0] / gaps[-1] > 8  # it falls at first order at least


@pytest.mark.parametrize("surface", ["polyethylene", "gelatin"])
@pytest.mark.parametrize("phi", [0.0, 5.0, 20.0, 50.0, 100.0])
@pytest.mark.slow
def test_every_strength_has_an_answer_or_says_so(surface, phi):
    ground = SURFACES[surface].scaled(max(phi, 1e-6) / PHI)
    walked = predict(ROBOT, GAITS["wave"], ground, Elastica(18), 12, BENT)
    assert np.isfinite(walked.locomotion.per_cycle) or Flag.BRANCH_END in walked.flags
    if phi <= 15:
        assert not walked.flags


@pytest.mark.slow
def test_a_robot_described_by_twice_the_segments_goes_as_far():
    six = replace(ROBOT, segments=(1.0,) * 6)
    doubled = Gait("doubled", tuple(tuple(np.repeat(s, 2)) for s in GAITS["wave"].stages))
    everywhere = Friction(tension=1.0, contacts="all")
    for surface in SURFACES.values():
        far = [predict(robot, gait, surface, friction=everywhere).locomotion.per_cycle
               for robot, gait in ((ROBOT, GAITS["wave"]), (six, doubled))]  # fmt: skip
        assert far[0] == pytest.approx(far[1], abs=1e-9)


def test_patches_bend_the_strip_as_the_ground_they_are_all_of():
    gelatin = SURFACES["gelatin"]
    same = Patches("same", (0.05,), (gelatin, gelatin))
    shapes = [solve_elastica(ROBOT, PATH, 60, ground=g, friction=BENT) for g in (gelatin, same)]
    assert shapes[0].left == pytest.approx(shapes[1].left, abs=1e-12)


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
