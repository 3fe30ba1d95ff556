"""The strip over ground with a nap: `python -m studies.naps FILE.png` (3 minutes).

Distance per cycle of the wave over by how much more the ground resists back than ahead, and over
whether tips or sides hold, by theory and by MuJoCo; and the nap at which the direction turns. The
mean of the bounds back and ahead is that of a ground between the three named ones.
"""

import sys
from dataclasses import replace
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import brentq

from analytic.prediction import predict
from analytic.scene.surface import SURFACES, Surface, from_ratios
from mjsim.results.measures import measure
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate
from studies.drawing import FONT, save

RATIOS = np.array([0.25, 0.35, 0.5, 0.7, 0.98, 1.0, 1.02, 1.4, 2.0, 2.8, 4.0])
"""Bounds back over bounds ahead; near 1 the distance jumps, where tips resist alike."""
_SHOWN = [0, 2, 4, 5, 6, 8, 10]  # of them in the table
KINDS = ((0.0, 1.0), (0.125, 1.0), (0.25, 1.0), (0.5, 1.0), (2 / 3, 2 / 3), (0.8, 0.4), (0.9, 0.2),
         (1.0, 0.0))  # fmt: skip
"""Tip force and shear strength over those of analytic.scene.surface, felt first, gelatin last."""
NAMED = {"felt": 0, "polyethylene": 3, "gelatin": 7}
_STATES = 12


def napped(surface: Surface, ratio: float) -> Surface:
    """A surface that resists back by so much more than ahead, and as strongly on average."""
    ahead = 2.0 / (1.0 + ratio)
    bounds = {key: getattr(surface, key) for key in ("tip_force", "shear_strength")}
    return replace(
        surface, **{key: ahead * value for key, value in bounds.items()},
        **{f"{key}_back": ratio * ahead * value for key, value in bounds.items()},
    )  # fmt: skip


def by_theory(surface: Surface, ratio: float) -> float:
    """Distance per cycle over L, friction bending the strip."""
    scene = Scene(ground=napped(surface, ratio), contacts="ends")
    path = predict(scene.robot, scene.gait, scene.ground, states_per_ramp=_STATES,  # type: ignore[arg-type]
                   friction=scene.reference_friction)  # fmt: skip
    return path.locomotion.per_cycle / scene.robot.length


def by_simulation(surface: Surface, ratio: float) -> float:
    """Distance per cycle over L in MuJoCo, at 2 s a ramp; NaN if it fails."""
    measures = measure(simulate(Scene(ground=napped(surface, ratio), contacts="ends", cycles=1)))
    return measures.displacement if measures else float("nan")


def neutral(surface: Surface, distance: object) -> float | None:
    """Ratio at which a distance, a function of surface and ratio, is 0; None if it is nowhere."""
    assert callable(distance)
    ends = [distance(surface, ratio) for ratio in (RATIOS[0], RATIOS[-1])]
    if ends[0] * ends[1] > 0:
        return None
    log_ratio = brentq(lambda log: distance(surface, np.exp(log)), np.log(RATIOS[0]),
                   np.log(RATIOS[-1]), xtol=1e-3)  # fmt: skip
    return float(np.exp(log_ratio))


def main() -> None:
    """Walk all, print a table, and draw it into the file that is named."""
    plt.rcParams.update(FONT)
    surfaces = [from_ratios("any", tip, side) for tip, side in KINDS]
    theory, walks = (
        np.array([[distance(surface, ratio) for ratio in RATIOS] for surface in surfaces])
        for distance in (by_theory, by_simulation)
    )
    turns = [[neutral(surface, distance) for surface in surfaces]
             for distance in (by_theory, by_simulation)]  # fmt: skip
    print("| tip : side |", " | ".join(f"{ratio:.3g}" for ratio in RATIOS[_SHOWN]), "| turns at |")
    print("|---" * (len(_SHOWN) + 2) + "|")
    for (tip, side), row, walked, *pair in zip(KINDS, theory, walks, *turns, strict=True):
        cells = [f"{a:+.4f} ({b:+.4f})" for a, b in zip(row[_SHOWN], walked[_SHOWN], strict=True)]
        at = ["nowhere" if turn is None else f"{turn:.3f}" for turn in pair]
        print(f"| {tip:.3g} : {side:.3g} |", " | ".join(cells), f"| {at[0]} ({at[1]}) |")
    off = np.abs(walks - theory)
    print(f"MuJoCo at 2 s a ramp differs by {np.nanmedian(off):.4f} in the median, "
          f"{np.nanmax(off):.4f} at most")  # fmt: skip

    figure, (lines, plane) = plt.subplots(1, 2, figsize=(8.6, 3.5), layout="constrained")
    for name, number in NAMED.items():
        lines.plot(RATIOS, theory[number], color=f"C{list(NAMED).index(name)}", label=name)
        lines.plot(RATIOS, walks[number], "o", color=f"C{list(NAMED).index(name)}", markersize=4)
    lines.axhline(0, color="0.7", linewidth=0.8, zorder=0)
    lines.axvline(1, color="0.7", linewidth=0.8, zorder=0)
    lines.set(xscale="log", xlabel="bound back over bound ahead",
              ylabel="distance per cycle over length")  # fmt: skip
    lines.legend(frameon=False, fontsize=8, loc="lower right")
    lines.set_title("lines: theory; dots: MuJoCo", fontsize=9)
    levels = np.linspace(-0.25, 0.25, 21)
    heights = np.arange(len(KINDS))
    shown = plane.contourf(RATIOS, heights, theory, levels=levels, cmap="RdBu", extend="both")
    plane.contour(RATIOS, heights, theory, levels=[0.0], colors="black", linewidths=1.6)
    plane.contour(RATIOS, heights, walks, levels=[0.0], colors="black", linewidths=1.6,
                  linestyles="dashed")  # fmt: skip
    plane.axvline(1, color="0.5", linewidth=0.8)
    labels = [f"{tip / side:.2g}" if side else "tips alone" for tip, side in KINDS]
    for name, number in NAMED.items():
        labels[number] += f" ({name})"
    plane.set(xscale="log", xlabel="bound back over bound ahead", yticks=heights,
              ylabel="bound of a tip over a third lying flat")  # fmt: skip
    plane.set_yticklabels(labels)
    for axes in (lines, plane):
        axes.set_xticks([0.25, 0.5, 1, 2, 4], ["1/4", "1/2", "1", "2", "4"])
        axes.minorticks_off()
    plane.set_title("black: it stands still (dashed in MuJoCo)", fontsize=9)
    figure.colorbar(shown, ax=plane, label="distance:  − back,  + ahead")
    save(figure, Path(sys.argv[1]), dpi=110, format="png")


if __name__ == "__main__":
    assert set(NAMED) == set(SURFACES)
    main()
