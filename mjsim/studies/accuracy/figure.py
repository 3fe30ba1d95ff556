"""Error against cost, as a figure and as a table: pure functions of the rows."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from mjsim.io.files import whole
from mjsim.scene import Numerics
from mjsim.studies.accuracy import benchmark_cases, heavy_cantilever
from mjsim.studies.accuracy.rows import Row, everywhere
from mjsim.studies.paper.style import FONT

GOALS = (0.10, 0.02, 0.005)  # relative errors that a table names the cheapest way to
_LEAST = 1e-5  # errors below are drawn there: the reference is no better
_COLOUR = {
    "planar": "#d1495b", "cable": "#edae49", "rod": "#66a182", "stock cable": "#8b5e34",
    "modes": "#8d99ae", "obstacle": "#3a7ca5", "elastica": "black",
    "Drake": "#5e548e", "PyElastica": "#00798c", "PyBullet": "#b56576",
}  # fmt: skip
_MARKER = {
    "discrete": "o", "Euler": "s", "implicitfast": "^", "implicit": "v", "RK4": "D",
    "SAP": "X", "Verlet": "X", "explicit": "X",
}  # fmt: skip
_CONE = {
    ("elliptic", 1.0): "<", ("elliptic", 10.0): ">", ("elliptic", 1000.0): "*",
    ("pyramidal", 1.0): "p", ("pyramidal", 100.0): "H",
}  # fmt: skip
_FAILED = {"diverged": "x", "toppled": "1", "drifting": "2"}
_TITLE = {
    heavy_cantilever.CASE: (
        "heavy clamped strip, settling",
        "distance of the tip from its place / L",
    ),
    benchmark_cases.WALK: (
        "one cycle of the default gait",
        "relative error of displacement per cycle",
    ),
    benchmark_cases.COULOMB: (
        "one cycle, Coulomb's law",
        "relative error of displacement per cycle",
    ),
}


def draw(rows: Sequence[Row], case: str) -> Figure:
    """Error over seconds of one core per simulated second, a panel a scene, with the front."""
    names = list(dict.fromkeys(row.scene for row in rows if row.case == case))
    figure = Figure(figsize=(2 + 4.2 * len(names), 4.6), layout="constrained", dpi=110)
    title, label = _TITLE[case]
    panels = figure.subplots(1, max(1, len(names)), sharey=True, squeeze=False)[0]
    for axes, scene in zip(panels, names, strict=False):
        here = [row for row in rows if (row.case, row.scene) == (case, scene)]
        worst = max((row.error for row in here if row.status == "ok"), default=1.0)
        for row in here:
            colour = _COLOUR.get(row.method, "0.5")
            if row.status == "ok":
                usual = _MARKER.get(row.integrator, "P")
                marker = _CONE.get((row.cone, row.impratio), usual)
                axes.plot(row.cost, max(row.error, _LEAST), marker, color=colour, ms=4.5,
                          alpha=0.75, mec="none", label=_name(row))  # fmt: skip
            else:
                marker = _FAILED.get(row.status, "+")
                axes.plot(row.cost, 2 * worst, marker, color=colour, ms=5, mew=0.8)
                axes.plot([], [], marker, color="0.4", ms=5, mew=0.8, label=row.status)
        front = pareto(here)
        axes.step([r.cost for r in front], [max(r.error, _LEAST) for r in front], color="0.3",
                  lw=1, where="post", zorder=0)  # fmt: skip
        for row in here:
            if is_default(row) and row.status == "ok":
                axes.plot(row.cost, max(row.error, _LEAST), "o", ms=13, mfc="none", mec="0.1")
                axes.annotate("default", (row.cost, max(row.error, _LEAST)), xytext=(9, 6),
                              textcoords="offset points", fontsize=8)  # fmt: skip
        axes.set(xscale="log", yscale="log", xlabel="CPU seconds per simulated second")
        axes.set_title(title if scene == heavy_cantilever.TIP else f"{title}, {scene}", fontsize=9)
        axes.grid(which="major", color="0.92", lw=0.6)
    panels[0].set_ylabel(label)
    handles: dict[str, Any] = {}
    for axes in panels:
        found, labels = axes.get_legend_handles_labels()
        handles |= dict(zip(labels, found, strict=True))
    failed = {row.status for row in rows} - {"ok"}
    handles = {name: handles[name] for name in sorted(handles, key=lambda name: name in failed)}
    figure.legend(list(handles.values()), list(handles), loc="outside right upper", frameon=False,
                  fontsize=FONT["font.size"] - 2)  # fmt: skip
    return figure


def pareto(rows: Iterable[Row]) -> list[Row]:
    """Rows that nothing else is both cheaper and more accurate than, cheapest first."""
    front: list[Row] = []
    for row in sorted((r for r in rows if r.status == "ok"), key=lambda r: (r.cost, r.error)):
        if not front or row.error < front[-1].error:
            front.append(row)
    return front


def is_default(row: Row) -> bool:
    """Whether a row is what `python -m mjsim.run` does unless told otherwise."""
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
    found = [cheapest(rows, case, goal) for goal in GOALS]
    methods = dict.fromkeys(row.method for row in rows if row.case == case)
    lines = [head]
    for method in methods:
        cells = []
        for best in found:
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


def _name(row: Row) -> str:
    name = f"{row.method}, {row.integrator}" if row.integrator else row.method
    return f"{name}, {row.cone} {row.impratio:g}" if row.cone else name
