"""A ground that grips ever more strongly: on polyethylene it turns the robot round."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from analytic.friction.laws import friction_number
from analytic.scene import pneunet
from mjsim import GAITS, SURFACES, Friction, Robot, Scene, measure, predict, simulate


def main(
    folder: Path | None = None, count: int = 5, strongest: float = 100.0
) -> list[tuple[float, float, float]]:
    robot, gait = Robot(), replace(GAITS["wave"], ramp_time=8.0)
    unit = friction_number(SURFACES["polyethylene"], robot, pneunet.base_rigidity(robot))
    rows = []
    for number in np.geomspace(0.1, strongest, count).tolist():
        ground = SURFACES["polyethylene"].scaled(number / unit)
        theory = predict(robot, gait, ground, friction=Friction(tension=1.0)).locomotion.per_cycle
        numbers = measure(simulate(Scene(robot, gait, ground)))
        assert numbers is not None
        rows.append((number, theory / robot.length, numbers.displacement))
        print(f"Phi {number:5.2f}  theory {rows[-1][1]:+.4f} L  MuJoCo {rows[-1][2]:+.4f} L")
    if folder:
        numbers_, theory_, simulated = zip(*rows, strict=True)
        figure = Figure(figsize=(6, 3.6), layout="constrained", dpi=110)
        axes = figure.subplots()
        axes.axhline(0, color="0.8", lw=0.8)
        axes.plot(numbers_, theory_, color="black", label="elastica, bent by friction")
        axes.plot(numbers_, simulated, "o", color="#d1495b", ms=4, label="MuJoCo, 8 s a ramp")
        axes.set(xscale="log", xlabel=r"friction number $\Phi = V L^2 / D_0$",
                 ylabel="displacement per cycle / L", title="polyethylene")  # fmt: skip
        axes.legend(frameon=False)
        figure.savefig(folder / "strong_friction.png")
    return rows


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None, count=21)
