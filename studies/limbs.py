"""Turns of the quadruped over pressures, error against cost, and the steps at which walking fails.

`python -m studies.limbs`, about ten minutes on two cores. Limbs do not twist here, as Drake's do
not. Drake's walks are read from
docs/quadruped_drake.csv, which benchmarks/peers/quadruped.py writes.
"""

import itertools
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd  # type: ignore[import-untyped]
from matplotlib.figure import Figure

from analytic.scene.limbs import LENGTH, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import FRICTION, SURFACES, Surface
from analytic.solvers.limbs.walk import walk as quasi_static
from mjsim.files.cli import parse
from mjsim.files.files import check_folder
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate
from studies.drawing import save
from studies.table import DOCS, pool

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
DRAKE = DOCS / "quadruped_drake.csv"
COLOURS = {"felt": "#2a6b4f", "polyethylene": "#4d7ea8", "gelatin": "#c8791a"}
_LABELS = {"turn": "turn to the left [° a cycle]", "ahead": "displacement [L a cycle]"}


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


def simulated(surface: str, law: str, left: float, step: float, elements: int) -> Point:
    """One walk by MuJoCo."""
    gait = replace(undulation("wave", left=left), ramp_time=RAMP)
    scene = Scene(quadruped(), gait, GROUNDS[surface], friction=law)
    walk = simulate(scene, Numerics(links=elements, timestep=step, twists=0))
    numbers = measure(walk)
    assert numbers is not None
    return Point(surface, law, left, step, elements, numbers.displacement, numbers.aside,
                 float(np.degrees(numbers.turn)),
                 scene.duration / walk.wall_time, str(walk.status))  # fmt: skip


def predicted(surface: str, law: str, left: float, states: int, elements: int) -> Point:
    """One walk by the quasi-static reference."""
    path = quasi_static(quadruped(), undulation("wave", left=left), GROUNDS[surface], states,
                        elements, law=law, twists=0)  # fmt: skip
    ahead, aside = path.displacement / LENGTH
    return Point(surface, law, left, 0.0, elements, ahead, aside, float(np.degrees(path.turn)), 0.0,
                 "ok" if path.converged else "unconverged")  # fmt: skip


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    check_folder(options.out)
    drake = read_drake(DRAKE)
    turns = list(itertools.product(SURFACES, LAWS[:1], PARTS))
    cases = list(itertools.product(SURFACES, LAWS, [LEFT]))
    uniform = list(itertools.product([UNIFORM.name], LAWS[1:], drake["left"].unique().tolist()))
    grids: tuple[Any, ...] = (
        (predicted, turns, [(STATES, 6)]),
        (simulated, turns, [(0.02, 6)]),
        (predicted, cases + uniform, [(2 * STATES, 8)]),
        (simulated, cases, itertools.product(STEPS, ELEMENTS)),
        (simulated, uniform, itertools.product(STEPS, [6])),
    )
    with pool() as workers:
        jobs = [workers.submit(walk, *scene, *numerics) for walk, scenes, grid in grids
                for scene, numerics in itertools.product(scenes, grid)]  # fmt: skip
        points = pd.DataFrame([job.result() for job in jobs])
    for figure, name in ((draw_turns(points), "turns"), (draw_cost(points), "accuracy"),
                         (draw_peers(points, drake), "drake")):  # fmt: skip
        save(figure, options.out / f"quadruped_{name}.png", dpi=120)
    print(points.to_csv(sep=" ", header=False, index=False, float_format="%.4g"), end="")
    return 0


def read_drake(path: Path) -> pd.DataFrame:
    """Drake's walks on the uniform ground, with the columns of a Point.

    Raises:
        OSError: there is no such file.
    """
    names = {"timestep_s": "step", "ahead_L": "ahead", "aside_L": "aside", "turn_deg": "turn",
             "times_real_time": "speed"}  # fmt: skip
    return pd.read_csv(path).rename(columns=names).assign(surface=UNIFORM.name, law="coulomb")


def _panels(label: str) -> tuple[Figure, dict[str, Any]]:
    """A figure with a panel for the turn and one for the displacement, over what the label says."""
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    panels = dict(zip(_LABELS, figure.subplots(1, 2), strict=True))
    for column, axes in panels.items():
        axes.set(xlabel=label, ylabel=_LABELS[column])
    return figure, panels


def _models(points: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Points of the quasi-static reference, and those of MuJoCo."""
    return points[points["step"] == 0], points[points["step"] > 0]


def draw_turns(points: pd.DataFrame) -> Figure:
    """Turn and displacement over the pressure of the left legs."""
    figure, panels = _panels("pressure of the left legs over that of the right ones")
    theory, mujoco = _models(points[points["left"].isin(PARTS)])
    for column, axes in panels.items():
        for name, colour in COLOURS.items():
            for table, style, model in ((theory, "-", "quasi-static"), (mujoco, "o", "MuJoCo")):
                part = table[table["surface"] == name]
                axes.plot(part["left"], part[column], style, color=colour,
                          label=f"{name}, {model}")  # fmt: skip
        axes.axhline(0, color="0.8", lw=0.8, zorder=0)
    panels["turn"].legend(fontsize=8, frameon=False)
    return figure


def draw_cost(points: pd.DataFrame) -> Figure:
    """Error against cost, and the grid of steps and links with what failed."""
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    markers = dict(zip(ELEMENTS, "osD^", strict=True))
    chosen = (points["left"] == LEFT) & (points["surface"] != UNIFORM.name)
    exact, table = _models(points[chosen].set_index(["surface", "law"]))
    apart = (table[["ahead", "aside"]] - exact[["ahead", "aside"]].loc[table.index]).to_numpy()
    table = table.reset_index().assign(error=np.hypot(*apart.T))
    finished = table["status"] == "ok"
    for row in table[finished].itertuples():
        left.loglog(row.speed, row.error, markers[row.elements], color=COLOURS[row.surface],
                    ms=5, alpha=0.8)  # fmt: skip
    for elements, marker in markers.items():
        left.plot([], [], marker, color="0.4", label=f"{elements} hinges a limb")
    for name, colour in COLOURS.items():
        left.plot([], [], "o", color=colour, label=name)
    left.set(xlabel="times real time, one core", ylabel="error of the displacement [L]")
    left.set_xticks([], minor=True)
    left.set_xticks(_SPEEDS, [str(speed) for speed in _SPEEDS])
    left.legend(fontsize=8, frameon=False)
    table["error"] = table["error"].where(finished, np.inf)
    worst = table.pivot_table(index="elements", columns="step", values="error", aggfunc="max")
    shown = worst.where(np.isfinite(worst)).to_numpy()
    right.imshow(np.log10(shown), cmap="viridis_r", aspect="auto", vmin=-3.5, vmax=-1.5)
    for (i, j), error in np.ndenumerate(shown):
        right.text(j, i, "falls" if np.isnan(error) else f"{error:.4f}", ha="center", va="center",
                   fontsize=8, color="white" if error >= _PALE else "black")  # fmt: skip
    right.set_xticks(range(len(STEPS)), [f"{1e3 * step:g}" for step in STEPS])
    right.set_yticks(range(len(ELEMENTS)), [str(n) for n in ELEMENTS])
    right.set(xlabel=f"time step [ms], {RAMP:g} s a ramp", ylabel="hinges a limb")
    right.set_title("worst error of three grounds and both friction laws [L]", fontsize=9)
    return figure


def draw_peers(points: pd.DataFrame, drake: pd.DataFrame) -> Figure:
    """Turn and displacement on the uniform ground by MuJoCo and Drake, over their speed."""
    figure, panels = _panels("times real time, one core")
    reference, mujoco = _models(points[points["surface"] == UNIFORM.name])
    models = (("MuJoCo", mujoco, "o-", COLOURS["felt"]), ("Drake", drake, "s-", COLOURS["gelatin"]))
    for column, axes in panels.items():
        for exact in reference.itertuples():
            axes.axhline(getattr(exact, column), color="0.6", lw=0.9, zorder=0)
            for model, table, style, colour in models:
                part = table[table["left"] == exact.left]
                axes.semilogx(part["speed"], part[column], style, ms=5, lw=0.7, color=colour,
                              label=f"{model}, left legs at {exact.left:.0%}",
                              fillstyle="full" if exact.left == 1 else "none")  # fmt: skip
    panels["turn"].set_title("lines: quasi-static reference", fontsize=9)
    panels["turn"].legend(fontsize=8, frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(main())
