"""From felt onto gelatin: the same gait walks up to the seam and stalls there."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from mjsim import SURFACES, Friction, Patches, Scene, predict, simulate


def main(folder: Path | None = None) -> tuple[float, float]:
    seam = 0.15
    ground = Patches("felt-gelatin", borders=(seam,), surfaces=(SURFACES["felt"],
                                                                SURFACES["gelatin"]))  # fmt: skip
    scene = Scene(ground=ground, cycles=8)
    walk = simulate(scene)
    theory = predict(scene.robot, scene.gait, ground, cycles=scene.cycles,
                     friction=Friction(tension=1.0))  # fmt: skip
    rests = np.flatnonzero((theory.pressures == 0).all(axis=1))
    for cycle in range(scene.cycles + 1):
        step = int(np.searchsorted(walk.time, cycle * scene.gait.period - 1e-9))
        x = walk.line[min(step, len(walk.time) - 1), 0, 0]
        expected = theory.locomotion.left[rests[cycle]]
        print(f"after {cycle} cycles: left end {1e3 * x:6.2f} mm, theory {1e3 * expected:6.2f} mm")
    if folder:
        figure = Figure(figsize=(6, 3.6), layout="constrained", dpi=110)
        axes = figure.subplots()
        axes.axhspan(1e3 * seam, 170, color="#e9c46a", alpha=0.4, lw=0, label="gelatin")
        axes.axhspan(-10, 1e3 * seam, color="#8ab17d", alpha=0.3, lw=0, label="felt")
        x, _ = walk.nodes()
        for end, style in ((0, "-"), (-1, "--")):
            axes.plot(walk.time / scene.gait.period, 1e3 * x[:, end], style, color="#264653", lw=1)
        for shift in (theory.locomotion.left, theory.locomotion.right + scene.robot.length):
            axes.plot(range(len(rests)), 1e3 * shift[rests], "o", color="#d1495b", ms=4)
        axes.plot([], [], "-", color="#264653", label="left end, MuJoCo")
        axes.plot([], [], "--", color="#264653", label="right end, MuJoCo")
        axes.plot([], [], "o", color="#d1495b", ms=4, label="theory, at rest")
        axes.set(xlabel="cycles", ylabel="place of the ends [mm]", xlim=(0, scene.cycles),
                 ylim=(-10, 170))  # fmt: skip
        axes.set_title(
            "It walks on felt till its right end lies on gelatin, and stalls", fontsize=9
        )
        axes.legend(loc="center right", framealpha=0.9, fontsize=8)
        figure.savefig(folder / "crossing.png")
    return float(walk.line[-1, 0, 0]), float(theory.locomotion.left[-1])


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
