"""The stability maps drawn: pure functions of their rows and of the predicted limits."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from analytic.friction.laws import friction_number
from analytic.scene import pneunet
from mjsim.scene import INTEGRATORS, Numerics
from studies.accuracy.setting import Setting
from studies.stability import maps, parameters
from studies.stability.limits import highest_frequency, predicted_limit
from studies.stability.outcome import OUTCOMES, stiffened

_CLIP, _FAILED = 20.0, "s"  # % that panels of parameters show; marker of a failed walk
_TICKS = (2, 5, 10, 20, 50)
_COLOURS = dict(zip(OUTCOMES,
                    ("#66a182", "#edae49", "#e76f51", "#8d6a9f", "#30343f", "#d9d2c5"),
                    strict=True))  # fmt: skip
_COLOURS["rolled up"] = "#3a7ca5"
_BRANCH = {"ok": "accurate", "branch_end": "toppled", "rolled_up": "rolled up"}
_ROBOTS = (
    "elastica: where its stable branch ends", "MuJoCo, against elastica",
    "the paper's modes: depth below the ground / L", "elastica: Newton steps a state",
    "obstacle: exchanges a state", "the paper's modes: part of states below it",
)  # fmt: skip


def draw(name: str, rows: Sequence[Any]) -> Figure:
    """The map of a name of studies.stability.__main__."""
    if name == "robots":
        return draw_robots(rows)
    return draw_knobs(rows) if name == "parameters" else draw_integrators(rows)


def draw_integrators(rows: Sequence[maps.Tried]) -> Figure:
    """Outcome over time step and links (top) and stiffness (bottom), a column an integrator.

    A cross: a longer walk came out otherwise.
    """
    figure = Figure(figsize=(13, 6.2), layout="constrained", dpi=100)
    axes = figure.subplots(2, len(INTEGRATORS), sharey=True)
    usual = min(row.cycles for row in rows)
    for column, integrator in enumerate(INTEGRATORS):
        every = [row for row in rows if row.integrator == integrator]
        mine = [row for row in every if row.cycles == usual]
        top, bottom = axes[0, column], axes[1, column]
        _tiles(top, [(r.links, r.timestep, r.outcome) for r in mine if r.stiffness == 1.0])
        _tiles(bottom, [(r.stiffness, r.timestep, r.outcome) for r in mine
                        if r.links == maps.USUAL_LINKS])  # fmt: skip
        top.set_title(integrator, fontsize=10)
        links = sorted({row.links for row in mine if row.stiffness == 1.0})
        _limit(top, rows[0].body, integrator, [(n, n, 1.0) for n in links])
        soft = sorted({row.stiffness for row in mine})
        _limit(bottom, rows[0].body, integrator, [(f, maps.USUAL_LINKS, f) for f in soft])
        short = {row.timestep: row.outcome for row in mine
                 if (row.links, row.stiffness) == (maps.USUAL_LINKS, 1.0)}  # fmt: skip
        for row in every:
            if row.cycles > usual and short.get(row.timestep, row.outcome) != row.outcome:
                top.plot(row.links, row.timestep, "x", color="black", ms=5)
        top.set(xlabel="links", xscale="linear", xticks=[12, 24, 48, 72])
        bottom.set_xlabel("stiffness / default")
    for left in axes[:, 0]:
        left.set_ylabel("time step [s]")
    _legend(figure, OUTCOMES[:-1])
    return figure


def draw_robots(rows: Sequence[maps.Standing]) -> Figure:
    """What becomes of robots over pressure and Gamma (top), and what it costs theory (bottom)."""
    figure = Figure(figsize=(11, 6.8), layout="constrained", dpi=100)
    panels = figure.subplots(2, 3, sharex=True, sharey=True)
    theory, simulated = panels[0, :2]
    _tiles(theory, [(r.gamma, 1e-3 * r.pressure, _BRANCH.get(r.elastica, r.elastica))
                    for r in rows])  # fmt: skip
    _tiles(simulated, [(r.gamma, 1e-3 * r.pressure, r.planar) for r in rows])
    shaded = (panels[0, 2], "sunk"), *zip(panels[1], ("newton", "exchanges", "penetrating"),
                                          strict=True)  # fmt: skip
    for axes, column in shaded:
        x, y, z = _grid([(r.gamma, 1e-3 * r.pressure, getattr(r, column)) for r in rows])
        shown = axes.pcolormesh(x, y, z, cmap="cividis", shading="nearest")
        figure.colorbar(shown, ax=axes)
    x, y, beyond = _grid([(r.gamma, 1e-3 * r.pressure, float(r.elastica != "ok")) for r in rows])
    for axes, title in zip(panels.ravel(), _ROBOTS, strict=True):
        axes.set(xscale="log")
        axes.set_xticks(_TICKS, [f"{tick:g}" for tick in _TICKS])
        axes.minorticks_off()
        axes.set_title(title, fontsize=9)
        axes.contour(x, y, beyond, levels=[0.5], colors="black", linewidths=1.2)
    for axes in panels[:, 0]:
        axes.set_ylabel("peak pressure [kPa]")
    for axes in panels[1]:
        axes.set_xlabel(r"$\Gamma = w L^3 / D_0$")
    _legend(figure, [name for name in _COLOURS if name != "diverged"])
    return figure


def draw_knobs(rows: Sequence[parameters.Varied]) -> Figure:
    """Error of the distance over each parameter; the default of each is dotted."""
    figure = Figure(figsize=(11, 5.4), layout="constrained", dpi=110)
    panels = figure.subplots(2, 3, sharey=True).ravel()
    for axes, (parameter, (_, _, label)) in zip(panels, parameters.PARAMETERS.items(), strict=True):
        for ground, colour in (("felt", "#8b5e34"), ("gelatin", "#3a7ca5")):
            mine = [row for row in rows if (row.parameter, row.ground) == (parameter, ground)]
            mine.sort(key=lambda row: row.value)
            fine = [row for row in mine if row.status == "ok"]
            axes.plot([r.value for r in fine], [100 * r.error for r in fine], "o-", ms=3.5, lw=1,
                      color=colour, label=ground)  # fmt: skip
            for row in mine:
                if row.status != "ok":
                    axes.plot(row.value, -_CLIP, _FAILED, color=colour, mfc="none", clip_on=False)
        axes.axhspan(-2, 2, color="0.92", zorder=0, lw=0)
        axes.axvline(_usual(parameter), color="0.2", lw=1, ls=":")
        axes.set(xscale="log", xlabel=label, ylim=(-_CLIP, _CLIP))
    for left in panels[::3]:
        left.set_ylabel("error of displacement [%]")
    panels[0].legend(frameon=False)
    return figure


def _usual(parameter: str) -> float:
    law = parameters.law_of(parameter)
    scene, numerics = parameters.scene_of(law, "felt"), Numerics().resolved("planar", law)
    if parameter == "ramp_time":
        return float(scene.gait.ramp_times[0])
    if parameter == "friction_number":
        rigidity = pneunet.base_rigidity(scene.strip)
        return friction_number(scene.ground.at(0.0), scene.strip, rigidity)
    return float(getattr(numerics, parameter))


def _limit(axes: Axes, body: str, integrator: str, at: Sequence[tuple[float, int, float]]) -> None:
    """Predicted limits of the time step: with the damping, and 2/omega_max without."""
    damped, bare = [], []
    for _, links, stiffness in at:
        # frequencies are no matter of the integrator: each is looked for once
        numerics = Setting(body, links, 1e-3, "discrete").numerics()
        scene = replace(stiffened(stiffness), body=body)
        omega = highest_frequency(scene, numerics, standing=True)
        damped.append(predicted_limit(integrator, omega, numerics.damping_time, body))
        bare.append(2 / omega)
    x = [place for place, _, _ in at]
    low, high = axes.get_ylim()
    axes.plot(x, damped, color="black", lw=1.4)
    axes.plot(x, bare, color="black", lw=1, ls=":")
    axes.set_ylim(low, high)


def _tiles(axes: Axes, cells: Sequence[tuple[float, float, str]]) -> None:
    names = list(_COLOURS)
    x, y, number = _grid([(a, b, float(names.index(name))) for a, b, name in cells])
    axes.pcolormesh(x, y, number, cmap=ListedColormap(list(_COLOURS.values())), vmin=-0.5,
                    vmax=len(names) - 0.5, shading="nearest")  # fmt: skip
    axes.set(xscale="log")
    if y.max() < 1:
        axes.set(yscale="log")


def _grid(cells: Sequence[tuple[float, float, float]]) -> tuple[Any, Any, Any]:
    """Axes and values of cells (x, y, value); NaN where there is none."""
    x, y = (np.unique([cell[axis] for cell in cells]) for axis in (0, 1))
    value = np.full((len(y), len(x)), np.nan)
    for a, b, v in cells:
        value[np.searchsorted(y, b), np.searchsorted(x, a)] = v
    return x, y, value


def _legend(figure: Figure, names: Sequence[str]) -> None:
    figure.legend(handles=[Patch(color=_COLOURS[name], label=name) for name in names],
                  loc="outside lower center", ncols=len(names), frameon=False)  # fmt: skip
