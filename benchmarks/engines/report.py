"""The table and the figure of the benchmark's rows."""

from pathlib import Path

from benchmarks.engines.engines import ENGINES
from benchmarks.engines.rows import BOUNDS, Row, best
from benchmarks.engines.specification import TASKS

COLOURS = {"MuJoCo": "#d1495b", "MuJoCo batch": "#edae49", "undulator": "#52796f",
           "undulator batch": "#66a182", "Drake": "#5e548e", "PyElastica": "#00798c"}  # fmt: skip


def table(rows: list[Row], task: str) -> str:
    """Cheapest setting of each engine within each bound of the error, as Markdown."""
    bounds = [bound for bound in BOUNDS if bound >= TASKS[task].doubt]  # as the answer is known
    heads = [f"within {100 * bound:g} %" for bound in bounds]
    lines = [f"| {task} | worlds | {' | '.join(heads)} |", "|---|---|" + "---|" * len(heads)]
    engines = [*ENGINES, *dict.fromkeys(row.engine for row in rows if row.engine not in ENGINES)]
    for engine in engines:
        among = [row for row in rows if (row.task, row.engine) == (task, engine)]
        for worlds in sorted({row.worlds for row in among}):
            cells = [_cell(best(among, task, engine, worlds, bound)) for bound in bounds]
            lines.append(f"| {engine} | {worlds} | {' | '.join(cells)} |")
    return "\n".join(lines)


def _cell(row: Row | None) -> str:
    """Links, time step: world steps and simulated seconds in a CPU second."""
    if row is None:
        return "-"
    setting = f"{row.links}, {1e3 * row.timestep:g} ms"
    return f"{setting}: {row.world_steps:,.0f} steps/s, {row.world_seconds:,.4g} s/s"


def draw(rows: list[Row], path: Path) -> None:
    """Error over speed: a point a setting, a line an engine's best."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False}):
        figure = Figure(figsize=(8.0, 3.4), layout="constrained")
        panels = figure.subplots(1, len(TASKS), sharey=True)
        for axes, task in zip(panels, TASKS, strict=True):
            engines = dict.fromkeys(row.engine for row in rows if row.task == task)
            for engine in engines:
                colour = COLOURS.get(engine, "black")
                points = [
                    (row.world_seconds, 100 * row.error)
                    for row in rows
                    if (row.task, row.engine) == (task, engine) and row.error == row.error
                ]
                axes.plot(*zip(*points, strict=True), ".", color=colour, alpha=0.3)
                axes.plot(*zip(*front(points), strict=True), "o-", color=colour, markersize=3,
                          linewidth=1, label=engine)  # fmt: skip
            doubt = 100 * TASKS[task].doubt
            axes.axhspan(0.0, doubt, color="0.95", zorder=0)
            axes.annotate("doubt of the answer", (0.02, doubt), xycoords=("axes fraction", "data"),
                          color="0.5", fontsize=7, va="top")  # fmt: skip
            for bound in BOUNDS:
                axes.axhline(100 * bound, color="0.85", linewidth=0.8, zorder=0)
            axes.set(xscale="log", yscale="log", title=task, ylim=(0.05, 200),
                     xlabel="worlds × simulated seconds per CPU second")  # fmt: skip
        panels[0].set_ylabel("error of the distance [%]")
        panels[0].legend(frameon=False, fontsize=7)
        figure.savefig(path, dpi=110)


def front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Points that none is both quicker and nearer than, quickest first."""
    kept: list[tuple[float, float]] = []
    for speed, error in sorted(points, key=lambda point: (-point[0], point[1])):
        if not kept or error < kept[-1][1]:
            kept.append((speed, error))
    return kept
