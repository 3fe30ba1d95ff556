"""Directions in which parameters may change without the data telling, and those that they tell.

The walk of a strip on constant bounds depends on dimensionless groups alone; a change that leaves
them all as they are shows in no shape or distance over the length.
"""

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.laws import friction_number
from analytic.scene import pneunet
from analytic.scene.limbs import limbs_of
from mjsim.files.scene_tables.tables import Tables
from mjsim.fitting.estimate import Estimate
from mjsim.fitting.parameters import ground_of, robot_of, with_values

Array = NDArray[np.float64]

_WIDE = math.log(2.0) / 1.96  # error of a logarithm: a factor of 2 either way; chosen
_PART = 0.1  # of the largest exponent, below which one is left out; chosen
_TOGETHER = 0.98  # multiple correlation: each alone is 5 times as unsure as its product; chosen
_MOVES = 0.05  # change of a group's logarithm for a unit step, below which it stays; chosen
_STEP = 1e-3


class Direction(NamedTuple):
    """A product of powers of parameters that the data leave open.

    Attributes:
        exponents: by parameter.
        factor: 95 % half-width of the product, as a factor.
        changed, same: groups that change along it, and that stay as they are.
    """

    exponents: dict[str, float]
    factor: float
    changed: tuple[str, ...]
    same: tuple[str, ...]

    def __str__(self) -> str:
        """Sentence for the user."""
        precision = f"within a factor of {self.factor:.2g}" if self.factor < 1e3 else "at all"
        groups = f" (leaves {', '.join(self.same)} as they are)" if self.same else ""
        return f"the data do not determine {_product(self.exponents)} {precision}{groups}"


class Together(NamedTuple):
    """A product of powers of parameters that the data determine, where they do not each alone.

    Attributes:
        exponents: by parameter.
        correlation: of the first with all others, multiple.
        value: of the product, in units of the parameters.
        error: relative standard error.
    """

    exponents: dict[str, float]
    correlation: float
    value: float
    error: float

    def __str__(self) -> str:
        """Sentence for the user."""
        return (
            f"{' and '.join(self.exponents)} are seen together (correlation "
            f"{self.correlation:.3f}): the data determine {_product(self.exponents)} = "
            f"{self.value:.4g} within {100 * 1.96 * self.error:.2g} %, not each alone"
        )


def together(estimate: Estimate) -> list[Together]:
    """Combinations that alone are determined, as no parameter in them is apart from the others."""
    covariance = estimate.covariance
    errors = np.sqrt(np.diag(covariance))
    information = np.linalg.pinv(covariance, hermitian=True, rcond=1e-14)
    apart = 1 / np.maximum(np.diag(covariance) * np.diag(information), 1.0)
    combinations: list[Together] = []
    for i in np.argsort(apart):
        name = estimate.parameters[i].name
        if apart[i] > 1 - _TOGETHER**2 or any(name in c.exponents for c in combinations):
            continue
        powers = information[i] / information[i, i]
        powers = np.where(np.abs(powers) * errors > _PART * errors[i], powers, 0.0)
        powers[i] = 1.0
        powers = np.where(np.abs(np.abs(powers) - 1) < _PART, np.sign(powers), powers.round(2))
        exponents = {
            estimate.parameters[k].name: float(powers[k])
            for k in sorted(range(len(powers)), key=lambda k: (k != i, k)) if powers[k]
        }  # fmt: skip
        value = math.exp(float(powers @ np.log(estimate.value)))
        error = math.sqrt(max(float(powers @ covariance @ powers), 0.0))
        combinations.append(Together(exponents, math.sqrt(1 - apart[i]), value, error))
    return combinations


def without_limit(estimate: Estimate, others: Iterable[str] = ()) -> list[str]:
    """Sentences on parameters to which the data set a limit on one side alone, or on none.

    Args:
        estimate: of a fit.
        others: names of parameters of which more is said elsewhere.
    """
    sentences = []
    for p, low, high in zip(estimate.parameters, estimate.low, estimate.high, strict=True):
        if p.name in others:
            continue
        unit = "" if p.unit == "1" else f" {p.unit}"
        if low == 0 and high == math.inf:
            sentences.append(f"the data set no limit to {p.name} within its bounds")
        elif low == 0:
            sentences.append(f"{p.name} is below {high:.4g}{unit}: the data set no lower limit")
        elif high == math.inf:
            sentences.append(f"{p.name} is above {low:.4g}{unit}: the data set no upper limit")
    return sentences


def undetermined(estimate: Estimate, base: Tables) -> list[Direction]:
    """Directions in which the estimate is open by a factor of 2 or more, the most open first.

    Args:
        estimate: of a fit.
        base: tables of the scene that was fitted.
    """
    values, vectors = np.linalg.eigh(estimate.covariance)
    slopes = _group_slopes(estimate, base)
    directions = []
    for variance, vector in sorted(zip(values, vectors.T, strict=True), key=lambda pair: -pair[0]):
        error = math.sqrt(max(variance, 0.0))
        if error <= _WIDE:
            break
        vector = vector / vector[np.argmax(np.abs(vector))]
        exponents = {
            p.name: round(float(power), 2)
            for p, power in zip(estimate.parameters, vector, strict=True)
            if abs(power) > _PART
        }
        changed = tuple(name for name, slope in slopes.items() if abs(slope @ vector) > _MOVES)
        same = tuple(name for name in slopes if name not in changed)
        factor = math.exp(min(1.96 * error, 700.0))
        directions.append(Direction(exponents, factor, changed, same))
    return directions


def _product(exponents: dict[str, float]) -> str:
    return " ".join(
        name if abs(power - 1) < 0.005 else f"{name}^{power:.2g}"
        for name, power in exponents.items()
    )


def at_bounds(estimate: Estimate) -> list[str]:
    """Names of parameters that ended at a bound, where intervals mean nothing."""
    return [
        p.name
        for p, value in zip(estimate.parameters, estimate.value, strict=True)
        if not 1.001 * p.low < value < p.high / 1.001
    ]


def groups(base: Tables, values: dict[str, float]) -> dict[str, float]:
    """Dimensionless groups of a scene: load, turn, friction number, ratio of the bounds.

    Those of a strip, of a robot of limbs those of the first limb that carries none.
    """
    tables = with_values(base, values)
    whole, surface = robot_of(tables), ground_of(tables).at(0.0)
    limbs = limbs_of(whole)
    carriers = {limb.on for limb in limbs}
    limb = next(limb.strip for limb in limbs if limb.name not in carriers)
    robot = replace(limb, peak_pressure=whole.peak_pressure)
    side = surface.shear_strength * robot.width * robot.length / len(robot.segments)
    rigidity = pneunet.base_rigidity(robot)
    return {
        "Gamma = w L^3/D0": pneunet.load_number(robot),
        "alpha p L": pneunet.turn_number(robot),
        "Phi = V L^2/D0": friction_number(surface, robot, rigidity),
        "V_t/(tau q L/S)": surface.tip_force / side if side else math.inf,
    }


def _group_slopes(estimate: Estimate, base: Tables) -> dict[str, Array]:
    """Exponent of each parameter in each group."""
    values = estimate.values
    start = groups(base, values)
    moved = [groups(base, {**values, name: values[name] * math.exp(_STEP)}) for name in values]
    return {
        name: np.array([_slope(value, end[name]) for end in moved]) for name, value in start.items()
    }


def _slope(start: float, end: float) -> float:
    """Change of a group's logarithm per unit step, 0 for a group that is 0 or infinite."""
    usable = 0 < start < math.inf and 0 < end < math.inf
    return math.log(end / start) / _STEP if usable else 0.0
