"""Drawing: colours of the methods, the strip on its ground, files that are whole or not there."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mjsim.files.files import whole
from studies import Array

COLOURS = {
    "chain": "#d1495b", "cable": "#edae49", "rod": "#66a182", "stock cable": "#8b5e34",
    "modes": "#8d99ae", "lifted": "#52796f", "obstacle": "#3a7ca5", "elastica": "black",
    "elastica, weak friction": "0.55", "elastica, with error bar": "#9b2fae",
    "Drake": "#5e548e", "PyElastica": "#00798c", "PyBullet": "#b56576",
}  # fmt: skip
SIMULATED = COLOURS["chain"]
PASSIVE, INFLATED = "0.68", "black"  # as the shading of Figure 4
FONT: dict[Any, Any] = {"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False}


def save(figure: Figure, path: Path, **options: Any) -> None:
    """Write a picture that appears under its name only when it is whole; options of savefig."""
    with whole(path) as part:
        figure.savefig(part, **options)


def draw_strip(axes: Axes, x: Array, y: Array, fraction: Array, **line: Any) -> None:
    """A strip of points from end to end, passive segments grey and inflated ones black.

    Args:
        axes: where to.
        x, y: points at equal arclengths, shape (N,), N - 1 a multiple of S.
        fraction: of the peak pressure in each segment, equal in length, shape (S,).
        line: more properties of the lines.
    """
    step = (len(x) - 1) // len(fraction)
    for segment, pressure in enumerate(fraction):
        part = slice(segment * step, (segment + 1) * step + 1)
        colour = INFLATED if pressure > 0.25 else PASSIVE
        axes.plot(x[part], y[part], color=colour, solid_capstyle="round", **line)


def draw_ground(axes: Axes, left: float, right: float) -> None:
    """A ground line with its hatching."""
    axes.fill_between([left, right], 0, -0.025, color="0.93", linewidth=0)
    axes.plot([left, right], [0, 0], color="0.45", linewidth=0.8, zorder=0)
