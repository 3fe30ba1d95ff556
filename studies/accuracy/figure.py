"""Error against cost, as a figure and as a table: pure functions of the rows."""

from collections import defaultdict
from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from mjsim.scene import Numerics
from studies.accuracy import benchmark_cases, heavy_cantilever
from studies.accuracy.rows import Row
from studies.accuracy.setting import Setting
from studies.drawing import COLOURS

Array = NDArray[np.float64]

GOALS = (0.10, 0.02, 0.005)  # relative errors that a table names the cheapest way to
_LEAST = 1e-5  # errors below are drawn there: the reference is no better
_MARKERS = {"diverged": "x", "toppled": "1", "drifting": "2", "turned": "3"}
_DISPLACEMENT = "relative error of displacement per cycle"
_TITLES = {
    heavy_cantilever.CASE: ("heavy cantilever", "distance of the tip from its exact place / L"),
    benchmark_cases.WALK: ("one cycle", _DISPLACEMENT),
    benchmark_cases.COULOMB: ("one cycle under Coulomb friction", _DISPLACEMENT),
}


def draw(rows: Sequence[Row], case: str) -> Figure:
    """Error over CPU seconds per simulated second, one panel per scene.

    One line per method, its own Pareto front, with its other rows pale behind; failures in a row of
    their own above.
    """
    scenes: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        if row.case == case:
            scenes[row.scene].append(row)
    columns = max(1, len(scenes))
    figure = Figure(figsize=(1 + 5.2 * columns, 4.6), layout="constrained", dpi=110)
    title, label = _TITLES[case]
    panels = figure.subplots(1, columns, sharey=True, squeeze=False)[0]
    for axes, (scene, scene_rows) in zip(panels, scenes.items(), strict=False):
        _draw_methods(axes, [row for row in scene_rows if row.status == "ok"])
        _draw_failures(axes, scene_rows)
        axes.set(xscale="log", yscale="log", xlabel="CPU seconds per simulated second")
        axes.set_title(title if scene == heavy_cantilever.TIP else f"{title}, {scene}", fontsize=9)
        axes.grid(which="major", color="0.92", lw=0.6)
    panels[0].set_ylabel(label)
    return figure


def _draw_methods(axes: Axes, rows: Sequence[Row]) -> None:
    methods: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        methods[row.method].append(row)
    for method, points in methods.items():
        colour, front = COLOURS.get(method, "0.5"), pareto(points)
        axes.plot(*_places(points), "o", color=colour, ms=3, alpha=0.25, mec="none")
        x, y = _places(front)
        axes.plot(x, y, "o-", color=colour, ms=4, lw=1.4)
        axes.annotate(method, (x[0], y[0]), xytext=(-4, 5), textcoords="offset points",
                      color=colour, fontsize=8, ha="right")  # fmt: skip
    for row in filter(is_default, rows):
        (place,) = _places([row]).T
        axes.plot(*place, "o", ms=13, mfc="none", mec="0.1")
        axes.annotate("default", place, xytext=(9, 6), textcoords="offset points", fontsize=8)


def _places(rows: Sequence[Row]) -> Array:
    """Cost and error of rows, (2, R)."""
    return np.array([(row.cost, max(row.error, _LEAST)) for row in rows]).T


def _draw_failures(axes: Axes, rows: Sequence[Row]) -> None:
    """Markers above the rest, by the kind of failure, in the colour of the method."""
    failed = [row for row in rows if row.status != "ok"]
    if not failed:
        return
    level = 3 * max((row.error for row in rows if row.status == "ok"), default=1.0)
    for row in failed:
        axes.plot(row.cost, level, _MARKERS.get(row.status, "+"), color=COLOURS.get(row.method),
                  ms=5, mew=0.8)  # fmt: skip
    handles = [Line2D([], [], ls="none", marker=_MARKERS.get(kind, "+"), color="0.4", label=kind)
               for kind in dict.fromkeys(row.status for row in failed)]  # fmt: skip
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
    """True for the numerics of `undulator run` unless told otherwise."""
    if row.case not in benchmark_cases.GROUNDS or row.method != "planar":
        return False
    usual = Numerics().resolved("planar", "coulomb" if row.cone else "constant")
    return row.setting.numerics() == usual


def cheapest(rows: Sequence[Row], case: str, goal: float) -> dict[str, Row]:
    """The cheapest row of each method whose error is within a goal, on its worst scene."""
    groups: dict[Setting, dict[str, Row]] = defaultdict(dict)
    for row in rows:
        if row.case == case:
            groups[row.setting][row.scene] = row
    scenes = set().union(*groups.values())
    slowest = [
        max(group.values(), key=lambda row: row.cost)
        for group in groups.values()
        if set(group) == scenes
        and all(row.status == "ok" and row.error <= goal for row in group.values())
    ]
    best: dict[str, Row] = {}
    for row in sorted(slowest, key=lambda row: row.cost):
        best.setdefault(row.method, row)
    return best


def table(rows: Sequence[Row], case: str) -> str:
    """The cheapest way of each method to each goal, and its cost over the cheapest of all."""
    lines = [f"{case:<13}" + "".join(f"{f'{goal:.1%}':>40}" for goal in GOALS)]
    goals = [cheapest(rows, case, goal) for goal in GOALS]
    for method in dict.fromkeys(row.method for row in rows if row.case == case):
        cells = (f"{_cell(method, best):>40}" for best in goals)
        lines.append(f"{method:<13}{''.join(cells)}")
    return "\n".join(lines)


def _cell(method: str, best: dict[str, Row]) -> str:
    if method not in best:
        return "-"
    row, least = best[method], min(row.cost for row in best.values())
    numerics = f"{row.links}" if row.links else ""
    numerics += f"/{1e3 * row.timestep:g} ms/{row.integrator}" if row.timestep else ""
    numerics += f"/{row.cone[:1]}{row.impratio:g}" if row.cone else ""
    return f"{numerics} {row.cost:.2g} s ×{row.cost / least:.3g}"
