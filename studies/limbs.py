"""The quadruped measured: turns over pressures, error against cost, and where walking fails.

`python -m studies.limbs`, about ten minutes on two cores. Drake's walks are read from
docs/quadruped_drake.csv, which benchmarks/peers/quadruped.py writes.
"""

import csv
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from analytic.scene.limbs import LENGTH, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import FRICTION, SURFACES, Surface
from analytic.solvers.limbs.walk import walk as quasi_static
from mjsim.files.cli import parse
from mjsim.files.files import check_folder, whole
from studies.workers import pool

PROGRAM = "python -m studies.limbs"
PARTS = (0.4, 0.6, 0.8, 1.0)  # of the pressure that the left legs get
LAWS = ("constant", "coulomb")
STEPS, ELEMENTS = (0.01, 0.02, 0.04, 0.06, 0.08), (4, 6, 8, 12)
RAMP, STATES = 8.0, 16  # s; of the reference
LEFT = 0.7  # of the chart's gait
_SPEEDS = (20, 50, 100, 200, 400)  # ticks
_PALE = 3e-3  # L; errors below it have a light cell
UNIFORM = Surface("uniform", friction=FRICTION)  # alike at tips and sides
GROUNDS = {**SURFACES, UNIFORM.name: UNIFORM}
DRAKE = Path(__file__).resolve().parents[1] / "docs" / "quadruped_drake.csv"
COLOURS = {"felt": "#2a6b4f", "polyethylene": "#4d7ea8", "gelatin": "#c8791a"}


@dataclass(frozen=True)
class Options:
    """Measure the quadruped and draw.

    Turns over the pressure of the left legs, by MuJoCo and by the quasi-static reference; error
    against cost; where walks fail; Drake beside it.
    """

    out: Path = Path("docs")
    """folder for the figures"""


class Point(NamedTuple):
    """One walk: displacement over L, turn in degrees, times real time, status."""

    surface: str
    law: str
    left: float
    step: float
    elements: int
    ahead: float
    aside: float
    turn: float
    speed: float
    status: str


def walked(surface: str, law: str, left: float, step: float, elements: int) -> Point:
    """By MuJoCo."""
    from mjsim.results.measures import measure
    from mjsim.scene import Numerics, Scene
    from mjsim.simulation.simulation import simulate

    gait = replace(undulation("wave", left=left), ramp_time=RAMP)
    scene = Scene(quadruped(), gait, GROUNDS[surface], friction=law)
    walk = simulate(scene, Numerics(links=elements, timestep=step))
    numbers = measure(walk)
    assert numbers is not None
    return Point(surface, law, left, step, elements, numbers.displacement, numbers.aside,
                 float(np.degrees(numbers.turn)),
                 scene.duration / walk.wall_time, str(walk.status))  # fmt: skip


def predicted(
    surface: str, law: str, left: float, states: int = STATES, elements: int = 6
) -> Point:
    """By the quasi-static reference."""
    from analytic.scene.limbs import quadruped

    gait = undulation("wave", left=left)
    path = quasi_static(quadruped(), gait, GROUNDS[surface], states, elements, law=law)
    ahead, aside = path.displacement / LENGTH
    return Point(surface, law, left, 0.0, elements, ahead, aside, float(np.degrees(path.turn)), 0.0,
                 "ok" if path.converged else "unconverged")  # fmt: skip


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    check_folder(options.out)
    turns = [(name, "constant", left) for name in SURFACES for left in PARTS]
    cases = [(name, law, LEFT) for name in SURFACES for law in LAWS]
    drake = read_drake(DRAKE)
    alike = [(UNIFORM.name, "coulomb", left) for left in dict.fromkeys(p.left for p in drake)]
    with pool() as workers:
        theory = [workers.submit(predicted, *case) for case in turns]
        fine = [workers.submit(predicted, *case, 2 * STATES, 8) for case in (*cases, *alike)]
        mujoco = [workers.submit(walked, *case, 0.02, 6) for case in turns]
        grid = [workers.submit(walked, *case, step, elements)
                for case in cases for step in STEPS for elements in ELEMENTS]  # fmt: skip
        same = [workers.submit(walked, *case, step, 6) for case in alike for step in STEPS]
        found = [[job.result() for job in jobs] for jobs in (theory, mujoco, fine, grid, same)]
    draw_turns(options.out / "quadruped_turns.png", *found[:2])
    draw_cost(options.out / "quadruped_accuracy.png", *found[2:4])
    draw_peers(options.out / "quadruped_drake.png", found[2], found[4], drake)
    for points in found:
        for point in points:
            print(*(f"{value:.4g}" if isinstance(value, float) else value for value in point))
    return 0


def read_drake(path: Path) -> list[Point]:
    """Drake's walks on the uniform ground.

    Raises:
        OSError: there is no such file.
    """
    with path.open(newline="") as file:
        return [
            Point(UNIFORM.name, "coulomb", float(row["left"]), float(row["timestep_s"]),
                  int(row["elements"]), float(row["ahead_L"]), float(row["aside_L"]),
                  float(row["turn_deg"]), float(row["times_real_time"]), "ok")
            for row in csv.DictReader(file)
        ]  # fmt: skip


def draw_turns(path: Path, theory: list[Point], mujoco: list[Point]) -> None:
    """Turn and displacement over the pressure of the left legs."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for axis, key, label in zip(axes, ("turn", "ahead"), ("turn to the left [° a cycle]",
                                                          "displacement [L a cycle]"),
                                strict=True):  # fmt: skip
        for name, colour in COLOURS.items():
            lines = ((theory, "-", "quasi-static"), (mujoco, "o", "MuJoCo"))
            for points, style, model in lines:
                own = [point for point in points if point.surface == name]
                axis.plot([point.left for point in own], [getattr(point, key) for point in own],
                          style, color=colour, label=f"{name}, {model}")  # fmt: skip
        axis.axhline(0, color="0.8", lw=0.8, zorder=0)
        axis.set_xlabel("pressure of the left legs over that of the right ones")
        axis.set_ylabel(label)
    axes[0].legend(fontsize=8, frameon=False)
    with whole(path) as part:
        figure.savefig(part, dpi=120)
    plt.close(figure)


def draw_cost(path: Path, reference: list[Point], grid: list[Point]) -> None:
    """Error against cost, and the grid of steps and links with what failed."""
    import matplotlib.pyplot as plt

    exact = {(point.surface, point.law): point for point in reference}
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    markers = dict(zip(ELEMENTS, "osD^", strict=True))
    worst = np.zeros((len(ELEMENTS), len(STEPS)))
    for point in grid:
        own = exact[point.surface, point.law]
        off = float(np.hypot(point.ahead - own.ahead, point.aside - own.aside))
        cell = ELEMENTS.index(point.elements), STEPS.index(point.step)
        if point.status != "ok":
            worst[cell] = np.inf
            continue
        worst[cell] = max(worst[cell], off)
        left.loglog(point.speed, off, markers[point.elements], color=COLOURS[point.surface],
                    ms=5, alpha=0.8)  # fmt: skip
    left.set_xlabel("times real time, one core")
    left.set_xticks([], minor=True)
    left.set_xticks(_SPEEDS, [str(speed) for speed in _SPEEDS])
    left.set_ylabel("error of the displacement [L]")
    for elements, marker in markers.items():
        left.plot([], [], marker, color="0.4", label=f"{elements} hinges a limb")
    for name, colour in COLOURS.items():
        left.plot([], [], "o", color=colour, label=name)
    left.legend(fontsize=8, frameon=False)
    shown = np.where(np.isfinite(worst), worst, np.nan)
    right.imshow(np.log10(shown), cmap="viridis_r", aspect="auto", vmin=-3.5, vmax=-1.5)
    for i, j in np.ndindex(worst.shape):
        text = f"{worst[i, j]:.4f}" if np.isfinite(worst[i, j]) else "falls"
        ink = "black" if np.isnan(shown[i, j]) or shown[i, j] < _PALE else "white"
        right.text(j, i, text, ha="center", va="center", fontsize=8, color=ink)
    right.set_xticks(range(len(STEPS)), [f"{1e3 * step:g}" for step in STEPS])
    right.set_yticks(range(len(ELEMENTS)), [str(n) for n in ELEMENTS])
    right.set_xlabel(f"time step [ms], {RAMP:g} s a ramp")
    right.set_ylabel("hinges a limb")
    right.set_title("worst error of three grounds and both friction laws [L]", fontsize=9)
    with whole(path) as part:
        figure.savefig(part, dpi=120)
    plt.close(figure)


def draw_peers(path: Path, reference: list[Point], mujoco: list[Point], drake: list[Point]) -> None:
    """What MuJoCo and Drake say of one ground, over how fast they say it."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for axis, key, label in zip(axes, ("turn", "ahead"), ("turn to the left [° a cycle]",
                                                          "displacement [L a cycle]"),
                                strict=True):  # fmt: skip
        for exact in (point for point in reference if point.surface == UNIFORM.name):
            solid = {"fillstyle": "full" if exact.left == 1 else "none"}
            words = f"left legs at {exact.left:.0%}"
            axis.axhline(getattr(exact, key), color="0.6", lw=0.9, zorder=0)
            for points, marker, colour, model in ((mujoco, "o", "#2a6b4f", "MuJoCo"),
                                                  (drake, "s", "#c8791a", "Drake")):  # fmt: skip
                own = [point for point in points if point.left == exact.left]
                axis.semilogx([point.speed for point in own],
                              [getattr(point, key) for point in own], marker + "-", ms=5, lw=0.7,
                              color=colour, label=f"{model}, {words}", **solid)  # fmt: skip
        axis.set_xlabel("times real time, one core")
        axis.set_ylabel(label)
    axes[0].set_title("lines: quasi-static reference", fontsize=9)
    axes[0].legend(fontsize=8, frameon=False)
    with whole(path) as part:
        figure.savefig(part, dpi=120)
    plt.close(figure)


if __name__ == "__main__":
    sys.exit(main())
