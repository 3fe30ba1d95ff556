"""Small pictures that pages begin with: `python -m studies.sketches`."""

import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle

from analytic.scene.gait import GAITS, Gait
from analytic.scene.limbs import quadruped
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from mjsim import Scene, Trajectory, build, distance_interval, measure, read_spreads, simulate
from studies import Array
from studies.drawing import FONT, draw_ground, draw_strip, save

TOP = Path(__file__).resolve().parent.parent
COLOURS = dict(zip(SURFACES, ("#8c6d46", "#4f7cac", "#c8553d"), strict=True))
_NOTE = {"arrowstyle": "<->", "color": "0.3", "lw": 0.8, "shrinkA": 0, "shrinkB": 0}


def _figure(width: float, height: float, columns: int, **grid: Any) -> tuple[Figure, list[Axes]]:
    figure = Figure(figsize=(width, height), dpi=110, layout="constrained")
    panels = figure.subplots(1, columns, squeeze=False, **grid)
    return figure, list(panels[0])


def _span(axes: Axes, begin: tuple[float, float], end: tuple[float, float], text: str,
          shift: tuple[float, float] = (0.0, 0.0)) -> None:  # fmt: skip
    """A dimension line and what it measures."""
    axes.annotate("", begin, end, arrowprops=_NOTE)
    middle = 0.5 * (np.array(begin) + end) + shift
    axes.text(middle[0], middle[1], text, ha="center", va="center", fontsize=8,
              bbox={"fc": "white", "ec": "none", "pad": 1.0})  # fmt: skip


def _pressures(axes: Axes, gait: Gait, names: Sequence[str]) -> None:
    """Pressures of a cycle, one line per chamber."""
    time = np.linspace(0.0, gait.period, 200)
    for row, name in enumerate(names):
        level = len(names) - 1 - row
        axes.fill_between(time, level, level + 0.75 * gait.fractions(time)[:, row], color="0.75")
        axes.text(-0.02 * gait.period, level + 0.2, name, ha="right", fontsize=8)
    axes.set(xlabel="time [s]", yticks=[], xlim=(0, gait.period))
    axes.spines["left"].set_visible(False)


def _shape(axes: Axes, walk: Trajectory, time: float, lift: float = 0.0) -> Array:
    """Draw the strip at a time; returns its points [mm], (N, 2)."""
    row = int(np.searchsorted(walk.time, time))
    x, z = (1e3 * part[row] for part in walk.nodes())
    along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(z)))])
    even = np.linspace(0.0, along[-1], 61)
    x, z = np.interp(even, along, x), np.interp(even, along, z)
    draw_strip(axes, x, z + lift, walk.scene.gait.fractions(np.array([time]))[0], lw=3)
    return np.stack([x, z], axis=1)


def scene() -> Figure:
    """A scene: robot, gait and ground."""
    walk = simulate(Scene(ground=SURFACES["felt"]))
    figure, (robot, gait, ground) = _figure(10, 2.2, 3, gridspec_kw={"width_ratios": [3, 2, 3]})
    strip, q = Robot(), 1e3 * Robot().width
    for left in range(3):
        robot.add_patch(Rectangle((left * 130 / 3, 0), 130 / 3, q, fc="0.9", ec="0.4"))
        robot.text((left + 0.5) * 130 / 3, 0.5 * q, ("left", "middle", "right")[left], ha="center")
    _span(robot, (0, -9), (1e3 * strip.length, -9), "length 130 mm")
    _span(robot, (138, 0), (138, q), "width\n40 mm", (14, 0))
    robot.set(xlim=(-5, 170), ylim=(-20, 50), aspect="equal", title="robot, from above")
    robot.axis("off")
    _pressures(gait, GAITS["wave"], ("left", "middle", "right"))
    gait.set_title("gait: pressure per chamber")
    _shape(ground, walk, 2.0)
    ground.text(-4, 4, "tip: V_t", ha="right", fontsize=8)
    ground.text(105, 5, "side: tau times its area", ha="center", fontsize=8)
    draw_ground(ground, -40, 150)
    ground.set(
        xlim=(-40, 150), ylim=(-15, 60), aspect="equal", title="ground: friction of tips and sides"
    )
    ground.axis("off")
    return figure


def columns() -> Figure:
    """Sketch of what the columns of a run measure on the strip."""
    walk = simulate(Scene(ground=SURFACES["felt"]))
    figure, (axes,) = _figure(8, 2.4, 1)
    begin = _shape(axes, walk, 0.0)
    middle = _shape(axes, walk, 4.0, 14.0)
    end = _shape(axes, walk, walk.scene.gait.period, 70.0)
    for level, text in ((0, "before"), (14, "in the cycle"), (70, "after")):
        axes.text(-12, level, text, ha="right", va="center", fontsize=8)
    x0, x1 = begin[0, 0], end[0, 0]
    axes.plot([x0, x0], [0, 84], color="0.6", lw=0.8, ls=":")
    _span(axes, (x0, 80), (x1, 80), "Δ", (0, 7))
    _span(axes, (x0, -10), (begin[-1, 0], -10), "L")
    top = middle[:, 1].max()
    _span(axes, (150, 14), (150, 14 + top), "height", (14, 0))
    axes.set(xlim=(-50, 190), ylim=(-18, 92), aspect="equal")
    axes.axis("off")
    return figure


def ground_tests() -> Figure:
    """The two tests of a bench."""
    figure, (tilt, pull) = _figure(8, 2.2, 2)
    slope = np.deg2rad(22)
    along, up = np.array([np.cos(slope), np.sin(slope)]), np.array([-np.sin(slope), np.cos(slope)])
    tilt.plot([0, 100], [0, 0], color="0.5")
    tilt.plot(*np.stack([0 * along, 110 * along], axis=1), color="0.3", lw=3)
    corners = [60 * along + 2 * up, 95 * along + 2 * up, 95 * along + 9 * up, 60 * along + 9 * up]
    tilt.add_patch(Polygon(corners, fc="0.85", ec="0.4"))
    tilt.annotate("", 40 * along + 5 * up, 58 * along + 5 * up, arrowprops={"arrowstyle": "->"})
    tilt.text(24, 3.5, "angle", fontsize=8)
    tilt.set(xlim=(-5, 125), ylim=(-8, 55), aspect="equal", title="tilt until it slides")
    draw_ground(pull, 0, 120)
    pull.plot([0, 120], [0, 0], color="0.3", lw=3)
    pull.add_patch(Rectangle((15, 1), 40, 7, fc="0.85", ec="0.4"))
    pull.add_patch(Rectangle((28, 8), 14, 10, fc="0.6", ec="0.4"))
    pull.text(35, 22, "load", ha="center", fontsize=8)
    pull.annotate("", (110, 4.5), (55, 4.5), arrowprops={"arrowstyle": "->"})
    pull.text(85, 9, "force", ha="center", fontsize=8)
    pull.set(xlim=(-5, 125), ylim=(-8, 55), aspect="equal", title="pull until it slides")
    for axes in (tilt, pull):
        axes.axis("off")
    return figure


def robots() -> Figure:
    """Section of the strip, and the quadruped from above."""
    figure, (section, plan) = _figure(9, 2.6, 2)
    strip = Robot()
    t, height, part = 1e3 * strip.thickness, 1e3 * strip.chamber_height, strip.chamber_fraction
    pitch = 10.0
    for cell in range(4):
        section.add_patch(
            Rectangle((cell * pitch, t), part * pitch, height, fc="#dbe9f4", ec="0.4")
        )
    section.add_patch(Rectangle((0, 0), 4 * pitch, t, fc="0.75", ec="0.4"))
    _span(section, (-2, 0), (-2, t), "t", (-2, 0))
    _span(section, (-2, t), (-2, t + height), "H", (-2, 0))
    _span(section, (0, t + height + 1.5), (part * pitch, t + height + 1.5), "c", (0, 1.6))
    _span(section, (pitch, t + height + 1.5), (2 * pitch, t + height + 1.5), "x", (0, 1.6))
    section.text(20, 0.5 * t, "layer that bends", ha="center", va="center", fontsize=8)
    section.text(
        22, -2.5, "chambers of air (blue) above a layer of silicone", ha="center", fontsize=8
    )
    section.set(xlim=(-6, 44), ylim=(-4, 14), aspect="equal", title="strip, section along it")
    robot = quadruped()
    for limb, (x, y, angle) in zip(robot.limbs, _plan(), strict=True):
        length, width = 1e3 * limb.strip.length, 1e3 * limb.strip.width
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        box = np.array([[0, -1], [1, -1], [1, 1], [0, 1]]) * [length, 0.5 * width]
        plan.add_patch(Polygon(box @ turn + [x, y], fc="0.9", ec="0.4"))
        middle = np.array([0.5 * length, 0.0]) @ turn + [x, y]
        plan.text(middle[0], middle[1], limb.name, ha="center", va="center", fontsize=7)
    _span(plan, (-45.2, -42), (90.4, -42), "135.7 mm")
    plan.set(xlim=(-55, 100), ylim=(-50, 45), aspect="equal", title="quadruped, from above")
    for axes in (section, plan):
        axes.axis("off")
    return figure


def _plan() -> list[tuple[float, float, float]]:
    """Place [mm] and direction [rad] of the beginning of each limb of the quadruped, lying flat."""
    robot, places = quadruped(), {}
    for limb in robot.limbs:
        if limb.on is None:
            places[limb.name] = (0.0, 0.0, limb.angle)
            continue
        x, y, angle = places[limb.on]
        carrier = next(other for other in robot.limbs if other.name == limb.on)
        far = 1e3 * carrier.strip.length * (limb.at == "end")
        aside = 1e3 * limb.offset
        x += far * np.cos(angle) - aside * np.sin(angle)
        y += far * np.sin(angle) + aside * np.cos(angle)
        places[limb.name] = (x, y, limb.angle)
    return list(places.values())


def unsure() -> Figure:
    """Within what the distance lies on each ground if friction and modulus are not known."""
    text = "surface.tip_force=20%, surface.shear_strength=20%, robot.modulus=10%"
    figure, (axes,) = _figure(7, 2.0, 1)
    for row, name in enumerate(SURFACES):
        tables = {"ground": {"surface": name}}
        interval = distance_interval(tables, read_spreads(tables, text))
        axes.plot([interval.low, interval.high], [-row, -row], lw=7, color=COLOURS[name])
        axes.text(-0.055, -row, name, ha="right", va="center")
    axes.axvline(0, color="0.6", lw=0.8)
    axes.set(
        xlim=(-0.055, 0.055),
        ylim=(-2.6, 0.6),
        yticks=[],
        xlabel="distance per cycle over L, 95 %: friction within 20 %, modulus within 10 %",
    )
    axes.spines["left"].set_visible(False)
    return figure


def gaits() -> Figure:
    """The wave and a gait that was found for gelatin, and how far each goes."""
    path = TOP / "examples" / "gaits" / "gelatin_forward.toml"
    best = build({"gait": {"file": str(path)}})[0].gait
    figure, (wave, other, far) = _figure(10, 2.4, 3)
    far.axhline(0, color="0.6", lw=0.8)
    for place, (axes, gait, title) in enumerate(((wave, GAITS["wave"], "wave"),
                                                 (other, best, "found for gelatin"))):  # fmt: skip
        _pressures(axes, gait, ("left", "middle", "right"))
        axes.set_title(title)
        for row, (name, surface) in enumerate(SURFACES.items()):
            numbers = measure(simulate(Scene(gait=gait, ground=surface)))
            far.bar(4 * place + row, numbers.displacement, color=COLOURS[name], label=name)
    far.set_xticks([1, 5], ["wave", "found"])
    far.set_title("distance per cycle over L")
    far.legend(*(part[:3] for part in far.get_legend_handles_labels()), fontsize=8, frameon=False)
    return figure


def zoo() -> Figure:
    """Measured beside predicted, of every row of the zoo's table that has a unit in common."""
    table = (TOP / "zoo" / "README.md").read_text("utf-8")
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()
            if re.match(r"\| \w+ +\| .* \| [a-z]+.* \| +-?\d", line)]  # fmt: skip
    units = ("mm/s", "deg", "cm", "mm per cycle")
    figure, panels = _figure(10, 2.8, len(units))
    for axes, unit in zip(panels, units, strict=True):
        here = [row for row in rows if row[2] == unit]
        for robot in dict.fromkeys(row[0] for row in here):
            pairs = np.array([[float(row[3]), float(row[5])] for row in here if row[0] == robot])
            axes.plot(*pairs.T, "o", ms=4, label=robot.replace("_", " "))
        if unit == "cm":  # robots of unlike sizes
            axes.loglog()
        ends = np.array(axes.axis()).reshape(2, 2)
        low, high = ends[:, 0].min(), ends[:, 1].max()
        axes.plot([low, high], [low, high], color="0.6", lw=0.8, zorder=0)
        axes.set(xlabel=f"measured [{unit}]", ylabel="predicted" if unit == units[0] else "")
        axes.legend(fontsize=7, frameon=False)
    return figure


SKETCHES: dict[str, Callable[[], Figure]] = {
    "docs/scene.png": scene, "docs/columns.png": columns, "docs/ground_tests.png": ground_tests,
    "docs/robots.png": robots, "docs/unsure.png": unsure, "docs/gaits.png": gaits,
    "zoo/measured.png": zoo,
}  # fmt: skip


def main(words: Sequence[str]) -> None:
    """Draw those whose names contain one of the words, or all."""
    for name, sketch in SKETCHES.items():
        if not words or any(word in name for word in words):
            with mpl.rc_context(FONT):
                save(sketch(), TOP / name, format="png")
            print(name)


if __name__ == "__main__":
    main(sys.argv[1:])
