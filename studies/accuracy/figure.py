"""Error against cost, as a figure and as a table: pure functions of the rows, see Row."""

import math
from dataclasses import fields
from textwrap import wrap
from typing import Any

import pandas as pd  # type: ignore[import-untyped]
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from analytic import REFERENCE
from mjsim.results.prediction import links
from mjsim.scene import Numerics, Scene
from studies.accuracy import benchmark_cases, heavy_cantilever, walking
from studies.accuracy.setting import Setting, setting_of
from studies.drawing import COLOURS
from studies.labels import name_lines

GOALS = (0.10, 0.02, 0.005)  # relative errors that a table names the cheapest way to
_LEAST = 1e-5  # errors below are drawn there: the reference is no better
_MARKERS = {"diverged": "x", "toppled": "1", "drifting": "2", "turned": "3"}
_NAMES = {"stock cable": "MuJoCo's own cable", "elastica": "elastica (theory)"}
_DISPLACEMENT = "relative error of displacement per cycle"
_TITLES = {
    heavy_cantilever.CASE: (
        "heavy strip clamped at one end",
        "distance of the tip from its exact place / L",
    ),
    benchmark_cases.WALK: ("one cycle", _DISPLACEMENT),
    benchmark_cases.COULOMB: ("one cycle under Coulomb friction", _DISPLACEMENT),
}  # fmt: skip


def draw(rows: pd.DataFrame, case: str) -> Figure:
    """Error over CPU seconds per simulated second, one panel per scene.

    One line per method, its own Pareto front, with its other rows pale behind; failures in a row of
    their own above. Rings: what commands take unless told otherwise.
    """
    rows = rows[rows["case"] == case]
    scenes = rows.groupby("scene", sort=False)
    columns = max(1, scenes.ngroups)
    figure = Figure(figsize=(1.6 + 4.4 * columns, 5.0), layout="constrained", dpi=130)
    title, label = _TITLES[case]
    panels = figure.subplots(1, columns, sharey=True, squeeze=False)[0]
    figure.suptitle(_titled(message(rows), 76 * columns), fontsize=9.5)
    for axes, (scene, measured) in zip(panels, scenes, strict=False):
        finished = measured["status"] == "ok"
        level = 3 * measured["error"].fillna(0).max() or 3.0
        _draw_methods(axes, measured[finished])
        _draw_failures(axes, measured[~finished], level)
        axes.set(xscale="log", yscale="log", xlabel="CPU seconds per simulated second")
        axes.margins(x=0.12)
        axes.set_ylim(top=2.5 * level)
        axes.set_title(title if scene == heavy_cantilever.TIP else f"{title}, {scene}", fontsize=9)
        axes.grid(which="major", color="0.92", lw=0.6)
    panels[0].set_ylabel(label)
    handles = _key(rows)
    figure.legend(handles=handles, fontsize=8, frameon=False, loc="outside lower center",
                  ncols=2 * columns)  # fmt: skip
    for axes, (_, measured) in zip(panels, scenes, strict=False):
        _name_methods(axes, measured)
    return figure


def _titled(lines: tuple[str, ...], width: int) -> str:
    """Lines of a title, broken at so many letters."""
    return "\n".join(part for line in lines for part in wrap(line, width))


def message(rows: pd.DataFrame) -> tuple[str, ...]:
    """Statement of a case: the cheapest method to the least goal, and what the others cost."""
    goal = GOALS[-1]
    best = list(cheapest(rows, goal).itertuples())
    if not best:
        return (f"No method comes within {goal:.1%}",)
    first, *others = best
    costs = (f"{_name(row.method)} {_rounded(row.cost / first.cost)}" for row in others)
    return (f"Within {goal:.1%} of the exact answer {_name(first.method)} costs least.",
            f"Times its cost: {', '.join(costs)}")  # fmt: skip


def _rounded(ratio: float) -> str:
    """A ratio to two digits, in full."""
    return f"{float(f'{ratio:.2g}'):,.10g}"


def _name(method: str) -> str:
    return _NAMES.get(method, method)


def _front(points: pd.DataFrame) -> tuple[Any, Any]:
    front = pareto(points)
    return front["cost"].to_numpy(), front["error"].clip(_LEAST).to_numpy()


def _draw_methods(axes: Axes, rows: pd.DataFrame) -> None:
    for method, points in rows.groupby("method", sort=False):
        colour = COLOURS.get(method, "0.5")
        axes.plot(points["cost"], points["error"].clip(_LEAST), "o", color=colour, ms=3,
                  alpha=0.25, mec="none")  # fmt: skip
        axes.plot(*_front(points), "o-", color=colour, ms=4, lw=1.4)
    for row in rows.itertuples():
        if is_default(row) or is_usual_reference(row):
            axes.plot(row.cost, max(row.error, _LEAST), "o", ms=13, mfc="none", mec="0.1")


def _name_methods(axes: Axes, rows: pd.DataFrame) -> None:
    fronts = {method: _front(points) for method, points in rows.groupby("method", sort=False)}
    name_lines(axes, {_name(method): (*front, COLOURS.get(method, "0.5"))
                      for method, front in fronts.items() if len(front[0])})  # fmt: skip


def _draw_failures(axes: Axes, rows: pd.DataFrame, level: float) -> None:
    """Markers at a level above the rest, by the kind of failure, in the colour of the method."""
    for row in rows.itertuples():
        axes.plot(row.cost, level, _MARKERS.get(row.status, "+"), color=COLOURS.get(row.method),
                  ms=5, mew=0.8)  # fmt: skip


def _key(rows: pd.DataFrame) -> list[Line2D]:
    """Legend of marks of any colour."""

    def mark(label: str, **looks: Any) -> Line2D:
        return Line2D([], [], **{"ls": "none", "marker": "o", "color": "0.4", **looks}, label=label)

    marks = [mark("best settings of a method (Pareto front)", ls="-", ms=4),
             mark("its other settings", ms=3, alpha=0.4)]  # fmt: skip
    if any(is_default(row) or is_usual_reference(row) for row in rows.itertuples()):
        marks.append(
            mark("default; of what is cheaper and nearer, errors cancel", ms=10, mfc="none")
        )
    failed = rows.loc[rows["status"] != "ok", "status"].unique()
    return marks + [mark(f"fails: {kind}", marker=_MARKERS.get(kind, "+")) for kind in failed]


def pareto(rows: pd.DataFrame) -> pd.DataFrame:
    """The Pareto front: rows that nothing is both cheaper and more accurate than."""
    finished = rows[rows["status"] == "ok"].sort_values(["cost", "error"])
    return finished[finished["error"] < finished["error"].cummin().shift(fill_value=math.inf)]


def is_default(row: Any) -> bool:
    """True for the numerics of `undulator run` unless told otherwise."""
    if row.case not in benchmark_cases.GROUNDS or row.method != "chain":
        return False
    usual = Numerics().resolved("chain", "coulomb" if row.cone else "constant")
    return setting_of(row).numerics() == usual


def is_usual_reference(row: Any) -> bool:
    """True for the reference as `undulator run` computes it, without and with its error bar."""
    if row.case not in benchmark_cases.GROUNDS:
        return False
    return row.method in (REFERENCE, walking.WITH_BAR) and row.links == links(Scene())


def cheapest(rows: pd.DataFrame, goal: float) -> pd.DataFrame:
    """The cheapest row of each method whose error is within a goal, on its worst scene."""
    names = [field.name for field in fields(Setting)]
    good = rows[(rows["status"] == "ok") & (rows["error"] <= goal)]
    scenes = good.groupby(names)["scene"].transform("nunique")
    good = good[scenes == rows["scene"].nunique()].sort_values("cost")
    return good.drop_duplicates(names, keep="last").drop_duplicates("method")


def table(rows: pd.DataFrame, case: str) -> str:
    """The cheapest way of each method to each goal, and its cost over the cheapest of all."""
    rows = rows[rows["case"] == case]
    lines = [f"{case:<13}" + "".join(f"{f'{goal:.1%}':>40}" for goal in GOALS)]
    goals = [{row.method: row for row in cheapest(rows, goal).itertuples()} for goal in GOALS]
    for method in rows["method"].unique():
        cells = (f"{_cell(method, best):>40}" for best in goals)
        lines.append(f"{method:<13}{''.join(cells)}")
    return "\n".join(lines)


def _cell(method: str, best: dict[str, Any]) -> str:
    if method not in best:
        return "-"
    row, least = best[method], min(row.cost for row in best.values())
    numerics = f"{row.links}" if row.links else ""
    numerics += f"/{1e3 * row.timestep:g} ms/{row.integrator}" if row.timestep else ""
    numerics += f"/{row.cone[:1]}{row.impratio:g}" if row.cone else ""
    return f"{numerics} {row.cost:.2g} s ×{row.cost / least:.3g}"
