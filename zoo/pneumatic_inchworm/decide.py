"""Measurements to decide on the pneumatic inchworm: `python -m zoo.pneumatic_inchworm.decide`.

For each measurement that could be made, with the accuracy beside it: what it leaves of the standard
errors of the robot's numbers and of the speeds at pressures that nobody measured, by the fit's
information matrix. A minute of CPU.
"""

import numpy as np
from scipy.optimize import approx_fprime

from examples import inchworm_speeds as inchworm
from studies import Array
from zoo.deciding import Measurement, errors, narrowed
from zoo.pneumatic_inchworm.distances import GAIT, read
from zoo.pneumatic_inchworm.model import RUNS

_STEP = 0.02  # of differences, as the fit's
_BETWEEN = (125.0, 175.0, 225.0)  # kPa, that are predicted, at MIDDLE on all materials


def runs_at(
    pressures: tuple[float, ...], frequency: float, materials: tuple[str, ...]
) -> inchworm.Runs:
    """Runs at pressures [kPa] and a frequency [Hz] on materials."""
    measured_runs = inchworm.read(RUNS)
    friction = {
        name: measured_runs.friction[measured_runs.material == name][0] for name in materials
    }
    rows = [(p, frequency, np.nan, name, friction[name]) for p in pressures for name in materials]
    return inchworm.Runs(*(np.array(column) for column in zip(*rows, strict=True)))


def measurements(fit: inchworm.Fit, table: object) -> list[Measurement]:
    """Quantities of robot, ground and speed that could be measured."""
    unit = np.eye(len(fit.values))
    ground = len(inchworm.ROBOT)
    paper, glass = (ground + 2 * fit.materials.index(name) for name in ("Paper", "Glass"))

    def speed(pressure: float, frequency: float, material: str) -> Array:
        runs = runs_at((pressure,), frequency, (material,))
        return np.asarray(approx_fprime(
            fit.values, lambda v: inchworm.speeds(table, fit.materials, v, runs)[0], _STEP
        ))  # fmt: skip

    return [
        Measurement("length of the robot, 1 mm", unit[2], 1.0 / np.exp(fit.values[2])),
        Measurement("weight and rigidity (Gamma), 10 %", unit[0], 0.1),
        Measurement("bend at 100 kPa, free, 5 %", unit[1], 0.05),
        Measurement("friction of the robot on paper, 10 %", unit[paper], 0.1),
        Measurement("friction of the robot on glass, 10 %", unit[glass], 0.1),
        Measurement("speed at 125 kPa and 0.25 Hz on iron, 0.05 mm/s", speed(125, 0.25, "Iron"),
                    0.05),
        Measurement("speed at 225 kPa and 0.25 Hz on paper, 0.05 mm/s", speed(225, 0.25, "Paper"),
                    0.05),
        Measurement("speed at half the speed: 250 kPa, 0.065 Hz, on glass, 0.05 mm/s",
                    speed(250, 0.065, "Glass"), 0.05),
    ]  # fmt: skip


def main() -> None:
    """Print a row per measurement."""
    tables = {GAIT: read()}
    fit = inchworm.fit(tables, inchworm.read(RUNS))
    table, between = tables[fit.gait], runs_at(_BETWEEN, inchworm.MIDDLE, fit.materials)
    slopes = approx_fprime(
        fit.values, lambda v: inchworm.speeds(table, fit.materials, v, between), _STEP
    )
    robot = np.eye(len(fit.values))[: len(inchworm.ROBOT)]
    print("| measurement | length | Gamma | bend at 100 kPa | speeds between |")
    print("|---|---|---|---|---|")
    nothing = Measurement("none", np.zeros(len(fit.values)), 1.0)
    for one in (nothing, *measurements(fit, table)):
        after = narrowed(fit.covariance, one.slope, one.error)
        load, turn, length = errors(after, robot)
        speed = np.sqrt(np.mean(errors(after, slopes) ** 2))
        print(f"| {one.name} | {length:.1%} | {load:.1%} | {turn:.1%} | {speed:.3f} mm/s |")
    print("values:", *(f"{np.exp(x):.3g}" for x in fit.values[:3]), f"noise {fit.noise:.2f}")


if __name__ == "__main__":
    main()
