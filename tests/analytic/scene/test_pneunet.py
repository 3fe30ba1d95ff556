"""The pneu-net laws follow from the paper's energies, by finite differences of those energies."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import robots

from analytic import Robot
from analytic.scene import pneunet
from analytic.scene.robot import GRAVITY

pressures = st.floats(1e3, 1e5)


def open_energy(robot: Robot, pressure: float, curvature: float) -> float:
    """(1) with (2), written from the geometry: a ring sector of radii R and R + H."""
    radius = 1 / curvature
    angle = robot.chamber_fraction * curvature  # for x = 1
    volume = 0.5 * angle * ((radius + robot.chamber_height) ** 2 - radius**2) * robot.width
    stiff = robot.modulus * robot.width * robot.thickness**3 / 12
    return 0.5 * stiff * curvature**2 - pressure * volume


def slope(function, x, step):
    """Fourth-order central difference."""
    return (8 * (function(x + step) - function(x - step))
            - (function(x + 2 * step) - function(x - 2 * step))) / (12 * step)  # fmt: skip


@given(robots, pressures)
def test_natural_curvature_3_makes_energy_1_stationary(robot, pressure):
    kappa = float(pneunet.natural_curvature(robot, pressure))
    scale = pneunet.base_rigidity(robot) * kappa
    assert abs(slope(lambda k: open_energy(robot, pressure, k), kappa, 1e-2 * kappa)) < 1e-6 * scale


@given(robots, pressures)
def test_filled_volume_5_is_the_ring_sector_at_the_natural_curvature(robot, pressure):
    kappa = float(pneunet.natural_curvature(robot, pressure))
    sector = 0.5 * robot.chamber_fraction * kappa * robot.width
    sector *= (1 / kappa + robot.chamber_height) ** 2 - 1 / kappa**2
    # the two squares cancel to H / (2 R), hence not closer
    assert float(pneunet.filled_volume(robot, pressure)) == pytest.approx(sector, rel=1e-7)


@given(robots, pressures, st.floats(0.3, 2.0))
def test_sealed_moment_is_the_slope_of_energy_6(robot, pressure, part):
    kappa = float(pneunet.natural_curvature(robot, pressure))
    at = part * kappa
    moment = slope(lambda k: float(pneunet.sealed_energy(robot, pressure, k)), at, 1e-2 * kappa)
    expected = float(pneunet.sealed_moment(robot, pressure, at))
    assert moment == pytest.approx(expected, abs=1e-7 * pneunet.base_rigidity(robot) * kappa)


@given(robots, pressures)
def test_tangent_rigidity_8_is_the_curvature_of_energy_6_at_no_moment(robot, pressure):
    kappa = float(pneunet.natural_curvature(robot, pressure))
    step = 2e-3 * kappa
    energy = [float(pneunet.sealed_energy(robot, pressure, kappa + i * step)) for i in range(-2, 3)]
    second = (-energy[0] + 16 * energy[1] - 30 * energy[2] + 16 * energy[3] - energy[4]) / 12
    assert second / step**2 == pytest.approx(
        float(pneunet.tangent_rigidity(robot, pressure)), rel=1e-5
    )


@given(robots, pressures, st.floats(0.3, 2.0))
def test_sealed_rigidity_is_the_slope_of_the_sealed_moment(robot, pressure, part):
    kappa = float(pneunet.natural_curvature(robot, pressure))
    stiffness = slope(
        lambda k: float(pneunet.sealed_moment(robot, pressure, k)), part * kappa, 1e-2 * kappa
    )
    assert stiffness == pytest.approx(
        float(pneunet.sealed_rigidity(robot, pressure, part * kappa)), rel=1e-6
    )


@given(robots)
def test_affine_rigidity_9_differs_from_8_at_second_order_in_pressure(robot):
    p = robot.peak_pressure * np.array([1e-2, 5e-3])
    gap = np.abs(pneunet.tangent_rigidity(robot, p) - pneunet.rigidity(robot, p))
    assert gap[0] / gap[1] == pytest.approx(4.0, rel=0.05)
    assert gap[0] < 1e-3 * pneunet.base_rigidity(robot)


@given(robots, pressures, st.floats(-0.5, 0.5))
def test_sealed_curvature_7_inverts_the_sealed_moment(robot, pressure, part):
    moment = part * pneunet.base_rigidity(robot) / robot.length
    kappa = pneunet.sealed_curvature(robot, pressure, moment)
    assert float(kappa) > -2 / robot.chamber_height
    assert float(pneunet.sealed_moment(robot, pressure, kappa)) == pytest.approx(
        moment, abs=1e-9 * pneunet.base_rigidity(robot) / robot.length
    )


@given(robots, pressures)
def test_sealed_curvature_expands_as_7(robot, pressure):
    small = 1e-5 * pneunet.base_rigidity(robot) / robot.length
    rise = [float(pneunet.sealed_curvature(robot, pressure, s * small)) for s in (1, -1)]
    layer = robot.modulus * robot.thickness**3
    chamber = 6 * robot.chamber_fraction * robot.chamber_height**3 * pressure
    expected = 6 * (2 * small) / robot.width * (1 / layer + 1 / (chamber + layer))
    assert rise[0] - rise[1] == pytest.approx(expected, rel=1e-5)


def test_what_was_measured_may_stand_for_what_it_follows_from():
    """Mass for weight, rigidity for modulus, the two slopes for the chambers' geometry."""
    usual = Robot()
    d0, alpha = pneunet.base_rigidity(usual), pneunet.curvature_per_pressure(usual)
    eta = pneunet.rigidity_per_pressure(usual)
    told = Robot(
        mass=usual.weight / GRAVITY, rigidity=d0, curvature_per_pressure=alpha,
        rigidity_per_pressure=eta, chamber_height=1.0,
    )  # fmt: skip
    assert told.weight_per_length == pytest.approx(usual.weight_per_length)
    assert told.modulus == pytest.approx(usual.modulus)
    assert told.mass is None
    p = usual.peak_pressure
    assert pneunet.natural_curvature(told, p) == pytest.approx(pneunet.natural_curvature(usual, p))
    assert pneunet.rigidity(told, p) == pytest.approx(pneunet.rigidity(usual, p))


@pytest.mark.parametrize(
    "both", [{"mass": 0.02, "weight_per_length": 2.0}, {"rigidity": 1e-4, "modulus": 2e6}]
)
def test_one_quantity_in_two_ways_is_refused(both):
    with pytest.raises(ValueError, match="not both"):
        Robot(**both)
