"""Error against cost, as a figure and as a table: pure functions of the rows."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mjsim.files.files import whole
from mjsim.scene import Numerics
from studies.accuracy import benchmark_cases, heavy_cantilever
from studies.accuracy.rows import Row, everywhere

GOALS = (0.10, 0.02, 0.005)  # relative errors that a table names the cheapest way to
_LEAST = 1e-5  # errors below are drawn there: the reference is no better
_COLOUR = {
    "planar": "#d1495b", "cable": "#edae49", "rod": "#66a182", "stock cable": "#8b5e34",
    "modes": "#8d99ae", "lifted": "#52796f", "obstacle": "#3a7ca5", "elastica": "black",
    "Drake": "#5e548e", "PyElastica": "#00798c", "PyBullet": "#b56576",
}  # fmt: skip
_FAILED = {"diverged": "x", "toppled": "1", "drifting": "2", "turned": "3"}
_TITLE = {
    heavy_cantilever.CASE: ("heavy cantilever", "distance of the tip from its exact place / L"),
    benchmark_cases.WALK: ("one cycle", "relative error of displacement per cycle"),
    benchmark_cases.COULOMB: (
        "one cycle under Coulomb friction", "relative error of displacement per cycle",
    ),
}  # fmt: skip


def draw(rows: Sequence[Row], case: str) -> Figure:
    """Error over CPU seconds per simulated second, a panel a scene.

    A line a method, its own Pareto front, with what else was measured of it pale behind; failures
    in a row of their own above.
    """
    names = list(dict.fromkeys(row.scene for row in rows if row.case == case))
    figure = Figure(figsize=(1 + 5.2 * max(1, len(names)), 4.6), layout="constrained", dpi=110)
    title, label = _TITLE[case]
    panels = figure.subplots(1, max(1, len(names)), sharey=True, squeeze=False)[0]
    for axes, scene in zip(panels, names, strict=False):
        here = [row for row in rows if (row.case, row.scene) == (case, scene)]
        _draw_methods(axes, here)
        _draw_failures(axes, here)
        for row in here:
            if is_default(row) and row.status == "ok":
                place = row.cost, max(row.error, _LEAST)
                axes.plot(*place, "o", ms=13, mfc="none", mec="0.1")
                axes.annotate("default", place, xytext=(9, 6), textcoords="offset points",
                              fontsize=8)  # fmt: skip
        axes.set(xscale="log", yscale="log", xlabel="CPU seconds per simulated second")
        axes.set_title(title if scene == heavy_cantilever.TIP else f"{title}, {scene}", fontsize=9)
        axes.grid(which="major", color="0.92", lw=0.6)
    panels[0].set_ylabel(label)
    return figure


def _draw_methods(axes: Axes, rows: Sequence[Row]) -> None:
    for method in dict.fromkeys(row.method for row in rows):
        colour = _COLOUR.get(method, "0.5")
        mine = [row for row in rows if row.method == method and row.status == "ok"]
        if not mine:
            continue
        front = pareto(mine)
        x, y = [row.cost for row in front], [max(row.error, _LEAST) for row in front]
        axes.plot([row.cost for row in mine], [max(row.error, _LEAST) for row in mine], "o",
                  color=colour, ms=3, alpha=0.25, mec="none")  # fmt: skip
        axes.plot(x, y, "o-", color=colour, ms=4, lw=1.4)
        axes.annotate(method, (x[0], y[0]), xytext=(-4, 5), textcoords="offset points",
                      color=colour, fontsize=8, ha="right")  # fmt: skip


def _draw_failures(axes: Axes, rows: Sequence[Row]) -> None:
    """Above the rest, by their kind; the methods in their colours."""
    failed = [row for row in rows if row.status != "ok"]
    if not failed:
        return
    level = 3 * max((row.error for row in rows if row.status == "ok"), default=1.0)
    for row in failed:
        axes.plot(row.cost, level, _FAILED.get(row.status, "+"), color=_COLOUR.get(row.method),
                  ms=5, mew=0.8)  # fmt: skip
    kinds = dict.fromkeys(row.status for row in failed)
    handles = [Line2D([], [], ls="none", marker=_FAILED.get(kind, "+"), color="0.4", label=kind)
               for kind in kinds]  # fmt: skip
    axes.legend(handles=handles, title="failed", fontsize=7, title_fontsize=7, frameon=False,
                loc="lower left")  # fmt: skip


def pareto(rows: Iterable[Row]) -> list[Row]:
    """The Pareto front: rows that nothing is both cheaper and more accurate than."""
    front: list[Row] = []
    for row in sorted((r for r in rows if r.status == "ok"), key=lambda r: (r.cost, r.error)):
        if not front or row.error < front[-1].error:
            front.append(row)
    return front


def is_default(row: Row) -> bool:
    """Whether a row is what `undulator run` does unless told otherwise."""
    if row.case not in benchmark_cases.GROUNDS or row.method != "planar":
        return False
    usual = Numerics().resolved("planar", "coulomb" if row.cone else "constant")
    return row.setting.numerics() == usual


def cheapest(rows: Sequence[Row], case: str, goal: float) -> dict[str, Row]:
    """The cheapest row of each method whose error is within a goal, on its worst scene."""
    best: dict[str, Row] = {}
    for group in everywhere(rows, case).values():
        worst = max(group, key=lambda row: row.cost)
        if all(row.status == "ok" and row.error <= goal for row in group):
            name = worst.method
            if name not in best or worst.cost < best[name].cost:
                best[name] = worst
    return dict(sorted(best.items(), key=lambda item: item[1].cost))


def table(rows: Sequence[Row], case: str) -> str:
    """The cheapest way of each method to each goal, and its cost over the cheapest of all."""
    head = f"{case:<13}" + "".join(f"{f'{goal:.1%}':>40}" for goal in GOALS)
    best_rows = [cheapest(rows, case, goal) for goal in GOALS]
    methods = dict.fromkeys(row.method for row in rows if row.case == case)
    lines = [head]
    for method in methods:
        cells = []
        for best in best_rows:
            row = best.get(method)
            least = next(iter(best.values())).cost if best else math.nan
            cells.append(f"{'-' if row is None else _cell(row, least):>40}")
        lines.append(f"{method:<13}{''.join(cells)}")
    return "\n".join(lines)


def save(figure: Figure, path: Path) -> None:
    """Write a picture that appears under its name only when it is whole."""
    with whole(path) as part:
        figure.savefig(part)


def _cell(row: Row, least: float) -> str:
    how = f"{row.links}" if row.links else ""
    how += f"/{1e3 * row.timestep:g} ms/{row.integrator}" if row.timestep else ""
    how += f"/{row.cone[:1]}{row.impratio:g}" if row.cone else ""
    return f"{how} {row.cost:.2g} s ×{row.cost / least:.3g}"
