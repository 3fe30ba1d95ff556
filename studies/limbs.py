"""Turns of the quadruped over pressures, error against cost, and the steps at which walking fails.

`python -m studies.limbs`, a few minutes of CPU for the walks that are not yet in
docs/quadruped_walks.csv, which the figures are drawn from. Limbs do not twist here, as Drake's do
not. Drake's walks are read from docs/quadruped_drake.csv, which benchmarks/peers/quadruped.py
writes.
"""

import itertools
import math
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd  # type: ignore[import-untyped]
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analytic.scene.limbs import LENGTH, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import FRICTION, SURFACES, Surface
from analytic.solvers.limbs.walk import walk as quasi_static
from mjsim.files.command_line.cli import parse
from mjsim.files.files import check_folder
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene, resolved
from mjsim.scene.scene import Chamber
from mjsim.simulation.simulation import Simulation
from studies.drawing import save
from studies.labels import name_lines
from studies.table import DOCS, complete

PROGRAM = "python -m studies.limbs"
PARTS = (0.4, 0.6, 0.8, 1.0)  # of the pressure that the left legs get
LAWS = ("constant", "coulomb")
STEPS, ELEMENTS = (0.01, 0.02, 0.04, 0.06, 0.08), (4, 6, 8, 12)
RAMP, STATES = 8.0, 16  # s; of the reference
LEFT = 0.7  # of the chart's gait
_SPEEDS = (20, 50, 100, 200, 400)  # ticks
_PALE = 3e-3  # L; errors below it have a light cell
# alike at tips and sides; Drake's springs there do not stiffen with pressure, so nor do ours
UNIFORM = Surface("uniform", friction=FRICTION)
SPRINGS: dict[str, Chamber] = {UNIFORM.name: "constant-pressure"}
GROUNDS = {**SURFACES, UNIFORM.name: UNIFORM}
WALKS, DRAKE = DOCS / "quadruped_walks.csv", DOCS / "quadruped_drake.csv"
_REPEATS = 3  # of a walk, the quickest of which is timed
_NEAR = 0.002  # L; error that the chart's title tells the cost of
COLOURS = {"felt": "#2a6b4f", "polyethylene": "#4d7ea8", "gelatin": "#c8791a"}
_LABELS = {"turn": "turn per cycle, to the left [°]", "ahead": "displacement ahead per cycle [L]"}


@dataclass(frozen=True)
class Options:
    """Measure the quadruped and draw.

    Turns over the pressure of the left legs, by MuJoCo and by the quasi-static reference; error
    against cost; where walks fail; Drake beside it.
    """

    out: Path = Path("docs")
    """folder for the figures"""


def walked(
    surface: str, law: str, left: float, step: float, elements: int, states: int
) -> dict[str, Any]:
    """One walk, by MuJoCo, or by the quasi-static reference if the step is 0.

    Args:
        surface: name of the ground.
        law: of friction.
        left: part of the pressure that the left legs get.
        step: of time [s].
        elements: hinges of a limb.
        states: of the reference per ramp.

    Returns:
        ahead, aside: displacement over L; turn: to the left in degrees; speed: seconds that are
        walked per second of CPU, by the quickest of some runs; status.
    """
    gait = replace(undulation("wave", left=left), ramp_time=RAMP)
    chamber = SPRINGS.get(surface, Scene.chamber)
    if not step:
        path = quasi_static(quadruped(), gait, GROUNDS[surface], states, elements, law=law,
                            chamber=chamber, twists=0)  # fmt: skip
        ahead, aside = path.displacement / LENGTH
        return {"ahead": ahead, "aside": aside, "turn": float(np.degrees(path.turn)), "speed": 0.0,
                "status": "ok" if path.converged else "unconverged"}  # fmt: skip
    scene = Scene(quadruped(), gait, GROUNDS[surface], friction=law, chamber=chamber)
    took = []
    for _ in range(_REPEATS):
        simulation = Simulation(scene, Numerics(links=elements, timestep=step, twists=0))
        begun = time.process_time()
        walk = simulation.run()
        took.append(time.process_time() - begun)
    numbers = measure(walk)
    ahead, aside, turn = (
        (numbers.displacement, numbers.aside, numbers.turn) if numbers else (math.nan,) * 3
    )
    return {"ahead": ahead, "aside": aside, "turn": math.degrees(turn),
            "speed": scene.duration / min(took), "status": str(walk.status)}  # fmt: skip


def grid(lefts: Sequence[float]) -> Iterator[tuple[Any, ...]]:
    """Walks of the figures, those on the uniform ground at these pressures of the left legs."""
    turns = list(itertools.product(SURFACES, LAWS[:1], PARTS))
    cases = list(itertools.product(SURFACES, LAWS, [LEFT]))
    uniform = list(itertools.product([UNIFORM.name], LAWS[1:], lefts))
    for scenes, numerics in (
        (turns, [(0.0, 6, STATES)]), (turns, [(0.02, 6, 0)]),
        (cases + uniform, [(0.0, 8, 2 * STATES)]),
        (cases, itertools.product(STEPS, ELEMENTS, [0])),
        (uniform, itertools.product(STEPS, [6], [0])),
    ):  # fmt: skip
        for scene, numbers in itertools.product(scenes, numerics):
            yield *scene, *numbers


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    check_folder(options.out)
    drake = read_drake(DRAKE)
    points = complete(WALKS, walked, grid(drake["left"].unique().tolist()))
    for figure, name in ((draw_turns(points), "turns"), (draw_cost(points), "accuracy"),
                         (draw_peers(points, drake), "drake")):  # fmt: skip
        save(figure, options.out / f"quadruped_{name}.png", dpi=120)
        print(options.out / f"quadruped_{name}.png")
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
    theory, mujoco = _models(points[points["law"] == LAWS[0]])
    theory = theory[theory["states"] == STATES]
    mujoco = mujoco[mujoco["left"].isin(PARTS)]
    for column, axes in panels.items():
        for name, colour in COLOURS.items():
            for table, style, model in ((theory, "-", "quasi-static"), (mujoco, "o", "MuJoCo")):
                part = table[table["surface"] == name]
                axes.plot(part["left"], part[column], style, color=colour,
                          label=f"{name}, {model}")  # fmt: skip
        axes.axhline(0, color="0.8", lw=0.8, zorder=0)
    figure.suptitle("Left legs pressed less turn it to the left on felt, to the right on gelatin",
                    fontsize=10)  # fmt: skip
    panels["turn"].legend(fontsize=8, frameon=False)
    return figure


def draw_cost(points: pd.DataFrame) -> Figure:
    """Error against cost by bounds, and grids of steps and hinges with what failed by each law."""
    table = errors(points)
    figure = Figure(figsize=(12, 3.9), layout="constrained")
    fronts, *grids = figure.subplots(1, 1 + len(LAWS))
    by_law = [table[table["law"] == law] for law in LAWS]
    worst = by_law[0].groupby(["elements", "step"]).agg({"error": "max", "speed": "min"})
    near = worst[worst["error"] <= _NEAR]["speed"]
    elements, step = near.idxmax()
    figure.suptitle(
        f"Friction by bounds: within {_NEAR:g} L on every ground at {near.max() // 10 * 10:g} "
        f"times real time, {elements} hinges per limb, {1e3 * step:g} ms", fontsize=10,
    )  # fmt: skip
    _draw_fronts(fronts, by_law[0])
    for axes, part, law in zip(grids, by_law, ("bounds", "load"), strict=True):
        _draw_grid(axes, part.groupby(["elements", "step"])["error"].max().unstack())
        axes.set_title(f"friction by {law}: error on the worst of 3 grounds [L]", fontsize=9)
    return figure


def errors(points: pd.DataFrame) -> pd.DataFrame:
    """Error of the displacement over L; infinite where a walk fails.

    Returns:
        Walks of the chart with that column.
    """
    chosen = (points["left"] == LEFT) & (points["surface"] != UNIFORM.name)
    exact, table = _models(points[chosen].set_index(["surface", "law"]))
    apart = (table[["ahead", "aside"]] - exact[["ahead", "aside"]].loc[table.index]).to_numpy()
    table = table.assign(error=np.hypot(*apart.T)).reset_index()
    return table.assign(error=table["error"].where(table["status"] == "ok", np.inf))


def _draw_fronts(axes: Axes, table: pd.DataFrame) -> None:
    """The Pareto front of each ground over its speed, with the other settings pale."""
    usual, fronts = resolved(Scene(quadruped()), Numerics(twists=0)), {}
    for name, colour in COLOURS.items():
        part = table[(table["surface"] == name) & np.isfinite(table["error"])]
        axes.loglog(part["speed"], part["error"], "o", color=colour, ms=4, alpha=0.3, mec="none")
        front = part.sort_values(["speed", "error"], ascending=[False, True])
        front = front[front["error"] < front["error"].cummin().shift(fill_value=np.inf)]
        axes.plot(front["speed"], front["error"], "o-", color=colour, ms=4, lw=1.4)
        default = part[(part["elements"] == usual.links) & (part["step"] == usual.timestep)]
        axes.plot(default["speed"], default["error"], "o", ms=11, mfc="none", mec="0.1")
        fronts[name] = (front["speed"].to_numpy(), front["error"].to_numpy(), colour)
    axes.set(xlabel="times real time, one core", ylabel="error of the displacement [L]")
    axes.set_xticks([], minor=True)
    axes.set_xticks(_SPEEDS, [str(speed) for speed in _SPEEDS])
    axes.set_title("by bounds; lines: best settings, pale: others, rings: default", fontsize=9)
    name_lines(axes, fronts)


def _draw_grid(axes: Axes, worst: pd.DataFrame) -> None:
    """Errors in numbers, hinges down and time steps across."""
    shown = worst.where(np.isfinite(worst)).to_numpy()
    axes.imshow(np.log10(shown), cmap="viridis_r", aspect="auto", vmin=-3.5, vmax=-1.5)
    for (i, j), error in np.ndenumerate(shown):
        axes.text(j, i, "falls" if np.isnan(error) else f"{error:.4f}", ha="center", va="center",
                  fontsize=8, color="white" if error >= _PALE else "black")  # fmt: skip
    axes.set_xticks(range(len(STEPS)), [f"{1e3 * step:g}" for step in STEPS])
    axes.set_yticks(range(len(ELEMENTS)), [str(n) for n in ELEMENTS])
    axes.set(xlabel=f"time step [ms], {RAMP:g} s per ramp", ylabel="hinges per limb")


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
        axes.plot([], [], color="0.6", lw=0.9, label="quasi-static reference")
    figure.suptitle("The same robot in MuJoCo and in Drake, friction alike at tips and sides",
                    fontsize=10)  # fmt: skip
    panels["turn"].legend(fontsize=8, frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(main())
