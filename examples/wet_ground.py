"""How fast a gait is matters on wet ground alone: it turns a slow robot round."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from mjsim import GAITS, SURFACES, Friction, Robot, Scene, Surface, measure, predict, simulate

GROUNDS = {
    "dry felt": SURFACES["felt"],
    "dry gelatin": SURFACES["gelatin"],
    "sticky gelatin, 0.05 J/m²": replace(SURFACES["gelatin"], adhesion=0.05),
    "film under the sides": Surface("film", viscosity=2000.0),
    "film, and tips that hold": Surface("wet", tip_force=0.010, viscosity=2000.0),
}
WET = "film, and tips that hold"


def main(folder: Path | None = None, count: int = 3) -> dict[str, list[float]]:
    robot = Robot()
    times, far = np.geomspace(0.25, 16.0, count), {}
    for name, ground in GROUNDS.items():
        gaits = [replace(GAITS["wave"], ramp_time=float(time)) for time in times]
        far[name] = [predict(robot, gait, ground, friction=Friction(tension=1.0)).locomotion
                     .per_cycle / robot.length for gait in gaits]  # fmt: skip
        print(f"{name:<28}" + "".join(f"{shift:+9.4f}" for shift in far[name]))
    far["MuJoCo"] = []
    for gait in gaits:
        numbers = measure(simulate(Scene(robot, gait, GROUNDS[WET])))
        assert numbers is not None
        far["MuJoCo"].append(numbers.displacement)
    print(f"{'the last in MuJoCo':<28}" + "".join(f"{shift:+9.4f}" for shift in far["MuJoCo"]))
    if folder:
        figure = Figure(figsize=(6, 3.6), layout="constrained", dpi=110)
        axes = figure.subplots()
        axes.axhline(0, color="0.8", lw=0.8)
        styles = zip(GROUNDS, ("#6a994e", "#bc6c25", "#e9c46a", "#4cc9f0", "#1d3557"), strict=True)
        for name, colour in styles:
            axes.plot(times, far[name], "--" if "under" in name else "-", color=colour, label=name)
        axes.plot(times, far["MuJoCo"], "o", color="#1d3557", ms=4, label="the last in MuJoCo")
        axes.set(xscale="log", xlabel="duration of a ramp [s]", ylabel="displacement per cycle / L")
        axes.legend(frameon=False, fontsize=8)
        figure.savefig(folder / "wet_ground.png")
    return far


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None, count=13)
