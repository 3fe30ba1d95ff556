"""What the figures share: colours, the strip drawn by segments, the ground."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

Array = NDArray[np.float64]

PASSIVE, INFLATED = "0.68", "black"  # as the shading of Figure 4
SIMULATED = "#d1495b"
SOLVER = {
    "modes": "#8d99ae",
    "lifted": "#52796f",
    "obstacle": "#3a7ca5",
    "elastica": "black",
    "planar": SIMULATED,
}
FONT: dict[Any, Any] = {"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False}


def draw_strip(axes: Axes, x: Array, y: Array, fraction: Array, **line: Any) -> None:
    """A strip of points from end to end, passive segments grey and inflated ones black.

    Args:
        axes: where to.
        x, y: points at equal arclengths, shape (S,), S - 1 a multiple of 3.
        fraction: of the peak pressure in each segment, equal in length, shape (3,).
        line: more properties of the lines.
    """
    step = (len(x) - 1) // len(fraction)
    for segment in range(len(fraction)):
        part = slice(segment * step, (segment + 1) * step + 1)
        colour = INFLATED if fraction[segment] > 0.25 else PASSIVE
        axes.plot(x[part], y[part], color=colour, solid_capstyle="round", **line)


def draw_ground(axes: Axes, left: float, right: float) -> None:
    """A ground line with its hatching."""
    axes.fill_between([left, right], 0, -0.025, color="0.93", linewidth=0)
    axes.plot([left, right], [0, 0], color="0.45", linewidth=0.8, zorder=0)
