"""Ground that sticks: sides stay down for longer, and the robot goes farther, either way."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from mjsim import (
    GAITS,
    SURFACES,
    Friction,
    Numerics,
    Robot,
    Scene,
    measure,
    predict,
    simulate,
)


def main(folder: Path | None = None, count: int = 2) -> dict[str, list[tuple[float, float]]]:
    robot, gait = Robot(), replace(GAITS["wave"], ramp_time=8.0)
    works, far = np.geomspace(1e-3, 0.2, count), {}
    for name in ("felt", "gelatin"):
        far[name] = []
        for work in works.tolist():
            ground = replace(SURFACES[name], adhesion=work)
            theory = predict(robot, gait, ground, friction=Friction(tension=1.0)).locomotion
            numbers = measure(simulate(Scene(robot, gait, ground), Numerics(links=48)))
            assert numbers is not None
            far[name].append((theory.per_cycle / robot.length, numbers.displacement))
            print(f"{name:<8} {work:.3f} J/m²  theory {far[name][-1][0]:+.4f} L  "
                  f"MuJoCo {far[name][-1][1]:+.4f} L")  # fmt: skip
    if folder:
        figure = Figure(figsize=(6, 3.6), layout="constrained", dpi=110)
        axes = figure.subplots()
        axes.axhline(0, color="0.8", lw=0.8)
        for name, colour in (("felt", "#6a994e"), ("gelatin", "#bc6c25")):
            theory_, simulated = zip(*far[name], strict=True)
            axes.plot(works, theory_, color=colour, label=f"{name}, elastica")
            axes.plot(works, simulated, "o", color=colour, ms=4, label=f"{name}, MuJoCo")
        axes.set(xscale="log", xlabel="adhesion [J/m²]", ylabel="displacement per cycle / L")
        axes.legend(frameon=False, fontsize=8)
        figure.savefig(folder / "sticky_ground.png")
    return far


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None, count=9)
