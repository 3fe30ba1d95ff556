"""The stability maps drawn: pure functions of their rows and of the predicted limits."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import pandas as pd  # type: ignore[import-untyped]
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mjsim.scene import INTEGRATORS
from studies.accuracy.setting import Setting
from studies.stability import maps, parameters
from studies.stability.limits import highest_frequency, predicted_limit

_CLIP = 20.0  # % that panels of parameters show
_TICKS = (2, 5, 10, 20, 50)
_COLOURS = dict(zip(
    (*maps.OUTCOMES, "rolled up"),
    ("#66a182", "#edae49", "#e76f51", "#8d6a9f", "#30343f", "#d9d2c5", "#3a7ca5"), strict=True,
))  # fmt: skip
_TOLD = {"finished": "walks, with no reference"}
_BRANCH = {"ok": "accurate", "branch_end": "toppled", "rolled_up": "rolled up"}
_SHADED = {
    "sunk": "the paper's modes: depth below the ground / L",
    "newton": "elastica: Newton steps per state",
    "exchanges": "obstacle: exchanges per state",
    "penetrating": "the paper's modes: part of states below the ground",
}


def draw_integrators(table: pd.DataFrame) -> Figure:
    """Outcome over time step and links (top) and stiffness (bottom), one column per integrator.

    A cross: a longer walk came out otherwise.
    """
    body = table["body"].iloc[0]
    few, default = table["links"] == maps.USUAL_LINKS, table["stiffness"] == 1.0
    short = table["cycles"] == table["cycles"].min()
    figure = Figure(figsize=(12, 6.6), layout=ConstrainedLayoutEngine(hspace=0.09), dpi=110)
    figure.suptitle(
        f"Walks of the {body} on {maps.GROUND}: how they come out, and how many are accurate, by "
        "MuJoCo's integrator", fontsize=10,
    )  # fmt: skip
    axes, crossed = figure.subplots(2, len(INTEGRATORS), sharey=True), False
    for (top, bottom), integrator in zip(axes.T, INTEGRATORS, strict=True):
        chosen = table["integrator"] == integrator
        for panel, part, x in ((top, default, "links"), (bottom, few, "stiffness")):
            shown = table[chosen & short & part]
            over = _tiles(panel, shown, x, "timestep", "outcome")
            accurate = (shown["outcome"] == maps.OUTCOMES[0]).mean()
            panel.set_title(f"{integrator}: {accurate:.0%} accurate", fontsize=9)
            strips = ([(n, 1.0) for n in over] if panel is top
                      else [(maps.USUAL_LINKS, f) for f in over])  # fmt: skip
            _limit(panel, body, integrator, over, strips)
        outcomes = table[chosen & short & few & default].set_index("timestep")["outcome"]
        long = table[chosen & ~short]
        crosses = long[long["timestep"].map(outcomes).fillna(long["outcome"]) != long["outcome"]]
        crossed |= len(crosses) > 0
        top.plot(crosses["links"], crosses["timestep"], "x", color="black", ms=5)
        top.set(xlabel="number of links", xscale="linear", xticks=[12, 24, 48, 72])
        bottom.set_xlabel(f"stiffness over the default, {maps.USUAL_LINKS} links", fontsize=9)
    for left in axes[:, 0]:
        left.set_ylabel("time step [s]")
    lines = [
        Line2D([], [], color="black", lw=1.4, label="highest mode grows above, predicted"),
        Line2D([], [], color="black", lw=1, ls=":", label="the same without damping"),
    ]
    if crossed:
        lines.append(Line2D([], [], color="black", ls="none", marker="x", ms=5,
                            label=f"otherwise in {maps.LONG} cycles"))  # fmt: skip
    _legend(figure, maps.OUTCOMES[:-1], lines, columns=4)
    return figure


def draw_robots(rows: pd.DataFrame) -> Figure:
    """Outcomes of robots over pressure and Gamma (top), and what each costs theory (bottom)."""
    figure = Figure(figsize=(11, 6.8), layout="constrained", dpi=100)
    panels = figure.subplots(2, 3, sharex=True, sharey=True)
    table = rows.assign(
        pressure=1e-3 * rows["pressure"],
        branch=rows["elastica"].replace(_BRANCH),
        beyond=(rows["elastica"] != "ok").astype(float),
    )  # kPa; fmt: skip
    tiles = {"branch": "elastica: where its stable branch ends",
             "chain": "MuJoCo, against elastica bent by friction"}  # fmt: skip
    beyond = _grid(table, "gamma", "pressure", "beyond")
    for axes, (column, title) in zip(panels.flat, {**tiles, **_SHADED}.items(), strict=True):
        if column in tiles:
            _tiles(axes, table, "gamma", "pressure", column)
        else:
            shown = axes.pcolormesh(*_grid(table, "gamma", "pressure", column), cmap="cividis",
                                    shading="nearest")  # fmt: skip
            figure.colorbar(shown, ax=axes)
        axes.set(xscale="log")
        axes.set_xticks(_TICKS, [f"{tick:g}" for tick in _TICKS])
        axes.minorticks_off()
        axes.set_title(title, fontsize=9)
        axes.contour(*beyond, levels=[0.5], colors="black", linewidths=1.2)
    for axes in panels[:, 0]:
        axes.set_ylabel("peak pressure [kPa]")
    for axes in panels[1]:
        axes.set_xlabel(r"$\Gamma = w L^3 / D_0$")
    figure.suptitle(f"Default gait on {maps.GROUND}: which robots walk, and what they cost theory",
                    fontsize=10)  # fmt: skip
    end = Line2D([], [], color="black", lw=1.2, label="the elastica's stable branch ends")
    _legend(figure, [name for name in _COLOURS if name != "diverged"], [end], columns=4)
    return figure


def draw_parameters(rows: pd.DataFrame) -> Figure:
    """Error of the distance over each parameter; the default of each is dotted."""
    figure = Figure(figsize=(11, 5.4), layout="constrained", dpi=110)
    panels = figure.subplots(2, 3, sharey=True).ravel()
    table = rows.sort_values("value")
    for axes, (name, (_, _, label)) in zip(panels, parameters.PARAMETERS.items(), strict=True):
        for ground, colour in (("felt", "#8b5e34"), ("gelatin", "#3a7ca5")):
            part = table[(table["parameter"] == name) & (table["ground"] == ground)]
            walked, failed = part[part["status"] == "ok"], part[part["status"] != "ok"]
            axes.plot(walked["value"], 100 * walked["error"], "o-", ms=3.5, lw=1, color=colour,
                      label=ground)  # fmt: skip
            for value in failed["value"]:
                axes.plot(value, -_CLIP, "s", color=colour, mfc="none", clip_on=False)
        axes.axhspan(-2, 2, color="0.92", zorder=0, lw=0)
        axes.axvline(parameters.default(name), color="0.2", lw=1, ls=":")
        axes.set(xscale="log", xlabel=label, ylim=(-_CLIP, _CLIP))
    for left in panels[::3]:
        left.set_ylabel("error of displacement [%]")
    panels[0].axhspan(0, 0, color="0.92", label="within 2 %")
    panels[0].axvline(parameters.default(next(iter(parameters.PARAMETERS))), color="0.2", lw=1,
                      ls=":", label="default")  # fmt: skip
    panels[0].legend(frameon=False, fontsize=9)
    figure.suptitle("Default walk, one parameter varied: how far its distance is off the reference",
                    fontsize=10)  # fmt: skip
    return figure


def _limit(
    axes: Axes, body: str, integrator: str, x: Any, strips: Iterable[tuple[int, float]]
) -> None:
    """Predicted limits of the time step of strips of these links and stiffnesses, over x.

    Solid with the damping; dotted without, 2/omega_max.
    """
    damped, bare = [], []
    for links, stiffness in strips:
        # frequencies are the same with every integrator: each is computed once
        numerics = Setting(body, int(links), 1e-3, "discrete").numerics()
        scene = replace(maps.stiffened(float(stiffness)), body=body)
        omega = highest_frequency(scene, numerics, standing=True)
        damped.append(predicted_limit(integrator, omega, numerics.damping_time, body))
        bare.append(2 / omega)
    limits = axes.get_ylim()
    axes.plot(x, damped, color="black", lw=1.4)
    axes.plot(x, bare, color="black", lw=1, ls=":")
    axes.set_ylim(limits)


def _tiles(axes: Axes, table: pd.DataFrame, x: str, y: str, outcome: str) -> Any:
    """Tiles in the colours of the outcomes in a column; returns their places along x."""
    numbers = table[outcome].map(list(_COLOURS).index)
    grid = _grid(table.assign(number=numbers), x, y, "number")
    axes.pcolormesh(*grid, cmap=ListedColormap(list(_COLOURS.values())), vmin=-0.5,
                    vmax=len(_COLOURS) - 0.5, shading="nearest")  # fmt: skip
    axes.set(xscale="log", yscale="log" if y == "timestep" else "linear")
    return grid[0]


def _grid(table: pd.DataFrame, x: str, y: str, column: str) -> tuple[Any, Any, Any]:
    """Places along x (N,) and y (M,), and the values of a column there (M, N); NaN for none."""
    values = table.pivot(index=y, columns=x, values=column)
    return values.columns.to_numpy(), values.index.to_numpy(), values.to_numpy()


def _legend(
    figure: Figure, names: Sequence[str], lines: Sequence[Line2D] = (), columns: int | None = None
) -> None:
    """Outcomes of tiles, and lines, below a figure."""
    handles = [*(Patch(color=_COLOURS[name], label=_TOLD.get(name, name))
                 for name in names), *lines]  # fmt: skip
    figure.legend(handles=handles, loc="outside lower center", ncols=columns or len(handles),
                  frameon=False, fontsize=9)  # fmt: skip
