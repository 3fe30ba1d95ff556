"""Eight segments, two waves: where a long robot lies between its ends, friction there decides."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from analytic import Elastica
from mjsim import SURFACES, Friction, Gait, Numerics, Robot, Scene, measure, predict, simulate

STATES = 40  # of a ramp: contacts that come and go need many
PARTS = {"60 % of the pressure": 0.6, "full pressure": 1.0}


def main(folder: Path | None = None, links: int = 48) -> dict[str, float]:
    robot = Robot(length=0.347, weight_per_length=2.0, segments=(1.0,) * 8, chamber_height=4.1e-3)
    # stage k inflates segment j where (j - k) mod 4 is 0 or 1
    stages = tuple(tuple(float((j - k) % 4 in (0, 1)) for j in range(8)) for k in range(9))
    gait, shifts = Gait("two waves", stages, 16.0), {}
    for part, pressure in PARTS.items():
        walker = replace(robot, peak_pressure=pressure * robot.peak_pressure)
        for name, surface in SURFACES.items():
            for where in ("ends", "all"):
                walked = predict(walker, gait, surface, Elastica(links), STATES,
                                 friction=Friction(tension=1.0, contacts=where))  # fmt: skip
                shifts[f"{part}, {name}, {where}"] = walked.locomotion.per_cycle / robot.length
            numbers = measure(simulate(Scene(walker, gait, surface), Numerics(links=links)))
            shifts[f"{part}, {name}, MuJoCo"] = numbers.displacement if numbers else np.nan
            rows = (f"{kind} {shifts[f'{part}, {name}, {kind}']:+.4f} L"
                    for kind in ("ends", "all", "MuJoCo"))  # fmt: skip
            print(f"{part:<22}{name:<14}" + "   ".join(rows))
    if folder:
        figure = Figure(figsize=(7, 3.4), layout="constrained", dpi=110)
        for axes, part in zip(figure.subplots(1, 2), PARTS, strict=True):
            axes.axhline(0, color="0.8", lw=0.8)
            for offset, kind, label, colour in (
                (-0.25, "ends", "elastica, ends alone: wrong here", "#d1495b"),
                (0.0, "all", "elastica, wherever it touches", "#264653"),
                (0.25, "MuJoCo", "MuJoCo, 16 s a ramp", "#8ab17d"),
            ):
                values = [shifts[f"{part}, {name}, {kind}"] for name in SURFACES]
                axes.bar(np.arange(3) + offset, values, 0.23, label=label, color=colour)
            axes.set_xticks(range(3), list(SURFACES))
            axes.set(title=part, ylabel="displacement per cycle / L")
        entries = figure.axes[0].get_legend_handles_labels()
        figure.legend(*entries, loc="outside upper center", ncols=3, frameon=False, fontsize=8)
        figure.savefig(folder / "long_robot.png")
    return shifts


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None, links=96)
