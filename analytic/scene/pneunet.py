"""Pneu-net laws: curvature and flexural rigidity by pressure ([Majidi13], section 2.1).

Pressures p and curvatures k may be scalars or arrays of any one shape; results have that shape.
Lengths along the strip enter only as the ratio c/x, so energies and volumes are given per unit
arclength: multiply by x for the paper's values of one chamber.

Of a robot whose segments have actuators of their own the last axis of p is that of the segments.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene.actuator import Actuator
from analytic.scene.robot import Robot

Array = NDArray[np.float64]


def base_rigidity(robot: Robot) -> float:
    """D0 = E w t^3 / 12, rigidity of the strain-limiting layer alone [N m^2] (under (1))."""
    return robot.modulus * robot.width * robot.thickness**3 / 12


def torsional_rigidity(robot: Robot) -> float:
    """GJ, moment per twist per length of the strain-limiting layer, without pressure [N m^2].

    G = E / 3, as silicone keeps its volume, and the torsion constant of a rectangle a by b, a <= b:
    J = (a^3 b / 3) (1 - (192 / pi^5) (a / b) sum tanh(n pi b / 2 a) / n^5) over odd n (Timoshenko
    and Goodier, Theory of Elasticity, 109). What (9) says of bending under pressure is not known of
    torsion: it stays.
    """
    if robot.torsion is not None:
        return robot.torsion
    a, b = sorted((robot.thickness, robot.width))
    n = np.arange(1, 10, 2)
    series = float(np.sum(np.tanh(0.5 * np.pi * n * b / a) / n**5))
    constant = a**3 * b / 3 * (1 - 192 / np.pi**5 * a / b * series)
    return robot.modulus / 3 * float(constant)


def load_number(robot: Robot) -> float:
    """Gamma = w L^3 / D0, weight beside stiffness [1] (Appendix A)."""
    return robot.weight_per_length * robot.length**3 / base_rigidity(robot)


def with_load(robot: Robot, load: float) -> Robot:
    """A robot, made so heavy that w L^3 / D0 is the load [1]."""
    unit = base_rigidity(robot) / robot.length**3
    return replace(robot, weight_per_length=load * unit)


def turn_number(robot: Robot) -> float:
    """alpha p L, the angle that the whole strip at peak pressure turns by [rad] (3)."""
    if robot.actuator is None:
        return curvature_per_pressure(robot) * robot.peak_pressure * robot.length
    curvature = natural_curvature(robot, np.full(len(robot.segments), robot.peak_pressure))
    return float(curvature @ np.diff(robot.borders)) * robot.length


def steepest_curvature(robot: Robot, most: float) -> float:
    """Largest change of kappa_p with pressure up to a pressure, alpha of (3) [1/(m Pa)]."""
    curves = [curve for curve in robot.actuators if curve]
    return max((c.steepest(most) for c in curves), default=curvature_per_pressure(robot))


def curvature_per_pressure(robot: Robot) -> float:
    """alpha = 6 H^2 c / (E t^3 x) [1/(m Pa)] (after (9))."""
    if robot.curvature_per_pressure is not None:
        return robot.curvature_per_pressure
    return (
        6 * robot.chamber_height**2 * robot.chamber_fraction / (robot.modulus * robot.thickness**3)
    )


def rigidity_per_pressure(robot: Robot) -> float:
    """eta = c H^3 w / (4 x) [N m^2 / Pa] (after (9))."""
    if robot.rigidity_per_pressure is not None:
        return robot.rigidity_per_pressure
    return robot.chamber_fraction * robot.chamber_height**3 * robot.width / 4


def natural_curvature(robot: Robot, pressure: ArrayLike) -> Array:
    """kappa_p = alpha p, curvature free of moment [1/m] (3), or as it was measured."""
    p = np.asarray(pressure, dtype=float)
    if robot.actuator is None:
        return curvature_per_pressure(robot) * p
    return _measured(robot.actuator, p, Actuator.curvature_at)


def rigidity(robot: Robot, pressure: ArrayLike) -> Array:
    """D_p = D0 + eta p, the affine law the locomotion model uses [N m^2] (9), or as measured."""
    curve = robot.actuators[0]
    if robot.actuator is not None and curve and curve.rigidity:
        return _measured(robot.actuator, np.asarray(pressure, dtype=float), _rigidity_at)
    return base_rigidity(robot) + rigidity_per_pressure(robot) * np.abs(pressure)


def _rigidity_at(actuator: Actuator, pressure: Array) -> Array:
    """Rigidity of an actuator of which it was measured [N m^2]."""
    rigidity = actuator.rigidity_at(pressure)
    assert rigidity is not None
    return rigidity


def _measured(
    actuator: Actuator | tuple[Actuator, ...], pressure: Array,
    law: Callable[[Actuator, Array], Array],
) -> Array:  # fmt: skip
    """A measured law at pressures, of the segments along the last axis where they differ."""
    if isinstance(actuator, Actuator):
        return law(actuator, pressure)
    columns = np.moveaxis(pressure, -1, 0)
    return np.stack([law(a, p) for a, p in zip(actuator, columns, strict=True)], axis=-1)


def tangent_rigidity(robot: Robot, pressure: ArrayLike) -> Array:
    """D_p = E w t^3 (6 c H^3 p + E t^3 x) / (12 (3 c H^3 p + E t^3 x)) [N m^2] (8).

    The printed (8) is garbled; this form is the one whose expansion in p is (9).
    """
    gas = robot.chamber_fraction * robot.chamber_height**3 * np.asarray(pressure, dtype=float)
    layer = robot.modulus * robot.thickness**3
    return base_rigidity(robot) * (6 * gas + layer) / (3 * gas + layer)


def chamber_volume(robot: Robot, curvature: ArrayLike) -> Array:
    """V/x, volume of compressed air per unit arclength [m^2] (2), with psi = c k."""
    k = np.asarray(curvature, dtype=float)
    height = robot.chamber_height
    return robot.chamber_fraction * robot.width * height * (1 + 0.5 * k * height)


def filled_volume(robot: Robot, pressure: ArrayLike) -> Array:
    """V_p/x, volume per unit arclength at pressure p and no moment [m^2] (5)."""
    return chamber_volume(robot, natural_curvature(robot, pressure))


def sealed_energy(robot: Robot, pressure: ArrayLike, curvature: ArrayLike) -> Array:
    """Pi/x at M = 0: energy per unit arclength once the valve is closed [N] (6)."""
    k = np.asarray(curvature, dtype=float)
    p = np.asarray(pressure, dtype=float)
    filled = filled_volume(robot, p)
    compressed = p * filled * np.log(chamber_volume(robot, k) / filled)
    return 0.5 * base_rigidity(robot) * k**2 - compressed


def sealed_moment(robot: Robot, pressure: ArrayLike, curvature: ArrayLike) -> Array:
    """M(k) of a sealed pneu-net, the stationarity of (6) in k, not expanded [N m]."""
    k = np.asarray(curvature, dtype=float)
    p = np.asarray(pressure, dtype=float)
    height = robot.chamber_height
    d_log_volume = 0.5 * height / (1 + 0.5 * k * height)
    return base_rigidity(robot) * k - p * filled_volume(robot, p) * d_log_volume


def sealed_rigidity(robot: Robot, pressure: ArrayLike, curvature: ArrayLike) -> Array:
    """dM/dk of a sealed pneu-net at a curvature [N m^2]; at the natural one it is (8)."""
    k = np.asarray(curvature, dtype=float)
    height = robot.chamber_height
    d_log_volume = 0.5 * height / (1 + 0.5 * k * height)
    gas = np.asarray(pressure, dtype=float) * filled_volume(robot, pressure)
    return base_rigidity(robot) + gas * d_log_volume**2


def sealed_curvature(robot: Robot, pressure: ArrayLike, moment: ArrayLike) -> Array:
    """k(M) of a sealed pneu-net [1/m]: the root of sealed_moment = M with k > -2/H.

    The volume (2) vanishes at k = -2/H, so exactly one root lies above it, at every M.
    """
    p = np.asarray(pressure, dtype=float)
    m = np.asarray(moment, dtype=float)
    d0, half = base_rigidity(robot), 0.5 * robot.chamber_height
    # (D0 k - M)(1 + k H/2) = p V_p H/2, a quadratic in u = 1 + k H/2 > 0
    a = d0 / half
    b = -(a + m)
    c = -p * filled_volume(robot, p) * half
    u = 0.5 * (-b + np.sqrt(b * b - 4 * a * c)) / a
    return (u - 1) / half
