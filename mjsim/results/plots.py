"""Pictures of a walk: matplotlib axes in, the same axes out; axes are made where none are given."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mjsim.results.shades import shade

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from mjsim.results.trajectory import Trajectory

Array = NDArray[np.float64]

_SHAPES = 7  # drawn where no times are given
_LEFT, _RIGHT, _ANCHORED = "#1a4dbf", "#c2571a", "#0a8232"


class Plots:
    """Plots of one walk; `walk.plot` makes them.

    Args:
        walk: what to draw.
    """

    def __init__(self, walk: "Trajectory") -> None:
        self._walk = walk

    def shapes(self, ax: "Axes | None" = None, times: Sequence[float] | None = None) -> "Axes":
        """The strip at some times, each above the one before, dark where it is inflated.

        Args:
            ax: to draw into.
            times: since the first cycle began [s]; evenly over the walk if None.

        Raises:
            ValueError: a time is not in the walk.
        """
        walk, ax = self._walk, _axes(ax)
        first, last = float(walk.time[walk.start]), float(walk.time[-1])
        chosen = np.linspace(first, last, _SHAPES) if times is None else np.asarray(times, float)
        if not len(chosen) or not ((chosen >= walk.time[0]) & (chosen <= last)).all():
            raise ValueError(f"times must be from {walk.time[0]:g} to {last:g} s, got {times!r}")
        x, z = 1e3 * np.array(walk.nodes())
        rows = [int(np.searchsorted(walk.time, time - 1e-9)) for time in chosen]
        apart = 1.15 * max(float(z[rows].max()), 0.05e3 * walk.scene.strip.length)
        fractions = walk.pressure / walk.scene.strip.peak_pressure
        for number, (row, time) in enumerate(zip(rows, chosen, strict=True)):
            up = -number * apart
            ax.axhline(up, color="0.85", lw=0.8, zorder=0)
            for piece, fraction in zip(segments(walk), fractions[row], strict=True):
                ax.plot(x[row, piece], up + z[row, piece], lw=4, solid_capstyle="butt",
                        color=tuple(shade(fraction)))  # fmt: skip
            ax.annotate(f"{time:.3g} s", (1.0, up), xycoords=("axes fraction", "data"),
                        xytext=(4, 0), textcoords="offset points", va="center")  # fmt: skip
        ax.set_xmargin(0.1)
        ax.set(xlabel="x [mm]", yticks=[], title=walk.scene.ground.name)
        ax.set_aspect("equal")
        return ax

    def track(self, ax: "Axes | None" = None) -> "Axes":
        """Displacement of both ends since the first cycle began, over time."""
        walk, ax = self._walk, _axes(ax)
        x, _ = walk.nodes()
        for end, name, colour in ((0, "left end", _LEFT), (-1, "right end", _RIGHT)):
            gone = 1e3 * (x[walk.start :, end] - x[walk.start, end])
            ax.plot(walk.time[walk.start :], gone, color=colour, label=name)
        ax.axhline(0.0, color="0.7", lw=0.8, zorder=0)
        ax.set(xlabel="time [s]", ylabel="displacement [mm]", title=walk.scene.ground.name)
        ax.legend(frameon=False)
        return ax

    def contacts(self, ax: "Axes | None" = None) -> "Axes":
        """Contact of the parts of the strip with the ground over time; the end that stays in green.

        By the recorded push of the ground, else by height. Bands stand for the two ends.
        """
        walk, ax = self._walk, _axes(ax)
        rows = slice(walk.start, None)
        from matplotlib.colors import ListedColormap

        touching = touches(walk)[rows]
        time, s, dt = walk.time[rows], 1e3 * edges(walk), walk.numerics.timestep
        ax.pcolormesh(np.append(time - 0.5 * dt, time[-1] + 0.5 * dt), s, touching.T,
                      cmap=ListedColormap(["white", "0.75"]), vmin=0, vmax=1,
                      rasterized=True)  # fmt: skip
        for end in (0, -1):  # as bands, as a tip is only a point
            stays = touching[:, end] & anchored(walk, end)[rows]
            for chosen, colour in ((touching[:, end], "0.5"), (stays, _ANCHORED)):
                ax.plot(time, np.where(chosen, s[end], np.nan), color=colour, lw=6,
                        solid_capstyle="butt")  # fmt: skip
        ax.margins(x=0)
        ax.set(xlabel="time [s]", ylabel="arclength [mm]", title=walk.scene.ground.name)
        return ax


def segments(walk: "Trajectory") -> list[slice]:
    """Vertices of each segment, those at a border in both."""
    middle = (np.arange(walk.numerics.links + 1) + 0.5) / (walk.numerics.links + 1)
    inside = np.searchsorted(np.asarray(walk.scene.strip.borders)[1:-1], middle)
    links = [np.flatnonzero(inside == i) for i in range(len(walk.scene.strip.segments))]
    return [slice(int(part[0]), int(part[-1]) + 2) for part in links]


def anchored(walk: "Trajectory", end: int) -> NDArray[np.bool_]:
    """Truth of each step in which an end, 0 or -1, keeps its place by the anchor rule, (T,)."""
    return np.asarray(walk.left_slip_fraction == (0.0 if end == 0 else 1.0))


def touches(walk: "Trajectory") -> NDArray[np.bool_]:
    """Contact of each node with the ground after each step, (T, N + 2)."""
    if walk.forces is not None:
        return np.asarray(walk.forces.normal > 0)
    return np.asarray(walk.line[..., 2] <= 1e-4 * walk.scene.strip.length)


def edges(walk: "Trajectory") -> Array:
    """Arclengths half-way between the nodes, and of the ends, (N + 3,) [m]."""
    from analytic.scene.chain import node_positions

    nodes = node_positions(walk.scene.strip, walk.numerics.links)
    return np.concatenate([nodes[:1], 0.5 * (nodes[1:] + nodes[:-1]), nodes[-1:]])


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(layout="constrained")
    return axes
