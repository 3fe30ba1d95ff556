"""Picture of TerreSoRo-IV: where its limbs touch, and its gaits measured and predicted."""

import csv
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies import Array
from studies.drawing import FONT, save
from zoo.comparison import Row
from zoo.terresoro_iv.hub import DATA, LIMBS, gaits, turned
from zoo.terresoro_iv.limbs import LENGTH, lay
from zoo.terresoro_iv.model import Lagged, remembered, steady
from zoo.terresoro_iv.outline import flat_place
from zoo.terresoro_iv.scenes import by_mujoco, last_cycle, scene, stages

_SQUARE = 3.65  # cm, half of the hub as it looks


def draw(rows: list[Row], path: Path) -> None:
    """Draw the robot from above and a panel each of distances and turns."""
    with mpl.rc_context(FONT):
        figure = Figure(figsize=(11.0, 3.9), layout="constrained", dpi=110)
        plan, *panels = figure.subplots(1, 3, width_ratios=(1.25, 1, 1))
        _draw_plan(plan)
        walked = _in_mujoco()
        for axes, unit, by_limbs in zip(panels, ("cm", "deg"), walked.T, strict=True):
            here = [row for row in rows if row.unit == unit]
            axes.plot(np.arange(len(here)) + 0.3, by_limbs, "^", color="C0", label="limbs, MuJoCo")
            for shift, name, marker, colour in ((-0.1, "measured", "s", "black"),
                                                (0.1, "predicted", "o", "C1")):  # fmt: skip
                axes.errorbar(
                    np.arange(len(here)) + shift, [getattr(row, name) for row in here],
                    [getattr(row, f"{name}_error") for row in here], fmt=marker, color=colour,
                    capsize=3, label=name,
                )  # fmt: skip
            axes.set_xticks(range(len(here)), [row.quantity.split(",")[0] for row in here])
            axes.axhline(0, color="0.8", lw=0.8, zorder=0)
            axes.set_ylabel({"cm": "distance per cycle [cm]", "deg": "turn per cycle [deg]"}[unit])
        panels[0].legend(fontsize=8, frameon=False)
        save(figure, path)


def _in_mujoco() -> Array:
    """Distances [cm] and turns [deg] of the gaits by limbs in MuJoCo, (G, 2)."""
    numbers = Lagged(*remembered()[0])
    laid = lay(numbers)
    texts = [scene(numbers, laid, stages(numbers, laid, *steady(gait.states)), 2)
             for gait in gaits()]  # fmt: skip
    return np.array([last_cycle(by_mujoco(text)[0], len(gait.states))
                     for text, gait in zip(texts, gaits(), strict=True)])  # fmt: skip


def _draw_plan(axes: Axes) -> None:
    """Limbs as photographed, contacts, and the arches that stand for them."""
    numbers = Lagged(*remembered()[0])
    flat, curled = numbers.places
    laid, outline = lay(numbers), _outline()
    for limb in range(LIMBS):
        angle = -0.5 * np.pi * limb
        axes.fill(*turned(outline, angle).T, color="0.85", zorder=0,
                  label="limb on photographs" if not limb else None)  # fmt: skip
        begin = turned(laid.begin, angle)
        arch = np.stack([begin, flat[limb]])
        axes.plot(*arch.T, color="C0", lw=1.5, label=f"arch of {100 * LENGTH:g} cm" if not limb
                  else None)  # fmt: skip
        axes.annotate("", curled[limb], flat[limb], arrowprops={"arrowstyle": "->", "lw": 1.2})
    corners = _SQUARE * np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)])
    axes.fill(*turned(corners, flat_place()[1]).T, color="0.6", zorder=1, label="hub")
    axes.plot(*flat.T, "o", color="C1", label="flat limb touches, photographs")
    axes.plot(*curled.T, "s", color="C3", ms=5, label="curled limb touches, fitted")
    axes.set_aspect("equal")
    axes.set_xlabel("from above, as on the photographs [cm]")
    axes.set_xlim(-24, 24)
    axes.set_ylim(19, -31)  # rows of pictures go down
    axes.legend(fontsize=7, frameon=False, loc="upper center", ncols=2,
                handlelength=1.3, columnspacing=0.8)  # fmt: skip


def _outline() -> Array:
    """Outline of limb 1 on photographs, (P, 2) [cm]."""
    with (DATA / "edges.csv").open(encoding="utf-8") as file:
        along, one, other = np.array(list(csv.reader(file))[1:], dtype=float).T
    places = np.concatenate([np.stack([along, one], 1), np.stack([along, other], 1)[::-1]])
    return np.asarray(turned(places, flat_place()[1]))
