"""Distance of the quadruped over slope and heading: `python -m studies.inclines FILE.png`.

By the reference (lines) and by MuJoCo (dots), at 2 s per ramp, on polyethylene by its constant
bounds and on a rough board by mu N. Where nothing holds it any more the lines end.
"""

import math
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES, Surface
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate

HEADINGS = {0: "uphill", 45: "half uphill", 90: "across", 135: "half downhill", 180: "downhill"}
BOARD = Surface("board", friction=0.3, tip_friction=0.6)
PANELS = (
    (SURFACES["polyethylene"], "constant", np.linspace(0.0, 3.0, 4)),
    (BOARD, "coulomb", np.linspace(0.0, 18.0, 4)),
)


def main() -> None:
    """Walk all, and draw them into the file that is named."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
    for panel, (surface, law, angles) in zip(axes, PANELS, strict=True):
        level = None  # whatever the heading
        for number, (heading, words) in enumerate(HEADINGS.items()):
            lines: list[float] = [level[0]] if level else []
            dots: list[float] = [level[1]] if level else []
            for degrees in angles[len(lines) :]:
                scene = Scene(
                    quadruped(), undulation("wave"), surface, friction=law,
                    slope=math.radians(degrees), uphill=math.radians(heading),
                )  # fmt: skip
                quasi = reference(scene)
                measures = measure(simulate(scene))
                lines.append(quasi.displacement[0])
                dots.append(measures.displacement if measures else math.nan)
                print(surface.name, heading, degrees, lines[-1], dots[-1], flush=True)
            level = lines[0], dots[0]
            panel.plot(angles, lines, color=f"C{number}", label=words)
            panel.plot(angles, dots, "o", color=f"C{number}", markersize=4)
        panel.set_title(f"{surface.name}, {law} friction")
        panel.set_xlabel("slope [degrees]")
        panel.axhline(0, color="0.7", linewidth=0.8, zorder=0)
    axes[0].set_ylabel("distance ahead per cycle, over length")
    axes[1].legend(title="lines: reference\ndots: MuJoCo", frameon=False, fontsize=8)
    figure.savefig(Path(sys.argv[1]), dpi=110)


if __name__ == "__main__":
    main()
