"""Charts of a walk that tell their values under the pointer, by Plotly."""

from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from mjsim.model.parts import DARK, PALE
from mjsim.results.plots import edges, touches
from mjsim.results.trajectory import Trajectory

Array = NDArray[np.float64]
Rows = NDArray[np.int_]

_FRAMES = 60  # of the scrubber; chosen
_POINTS = 600  # of a line, so that a page stays small
_LEFT, _RIGHT, _HELD = "#4a7de0", "#d9702f", "#1c9c4a"
SHADES = ("#9a8f78", "#5f7f95", "#8a5f95", "#6f9560", "#95605f")
_CLEAR = "rgba(0,0,0,0)"


def shapes(walk: Trajectory) -> go.Figure:
    """The strip at the time that a slider says, dark where it is inflated."""
    rows = np.linspace(walk.start, len(walk.time) - 1, _FRAMES).astype(int)
    x, z = 1e3 * np.array(walk.nodes())
    pieces = _pieces(walk)
    figure = scrubbed([_strip(walk, row, x, z, pieces) for row in rows], walk.time[rows])
    reach = 1e3 * walk.scene.strip.length
    low, high = float(x[rows].min()) - 0.05 * reach, float(x[rows].max()) + 0.05 * reach
    figure.update_layout(
        shapes=[{"type": "line", "layer": "below", "x0": low, "x1": high, "y0": 0, "y1": 0,
                 "line": {"color": "#999", "width": 1}}],
    )  # fmt: skip
    figure.update_xaxes(title="x [mm]", range=[low, high])
    figure.update_yaxes(title="height [mm]", scaleanchor="x", range=[-4, float(z.max()) + 6])
    return styled(figure, 380)


def scrubbed(frames: list[list[Any]], times: Array, figure: go.Figure | None = None) -> go.Figure:
    """A figure whose lines are those of the time that a slider says, or played.

    Args:
        frames: traces of each time.
        times: of the frames, (F,) [s].
        figure: to draw on, with its axes; a new one if None.
    """
    named = [go.Frame(data=traces, name=f"{time:.2f}")
             for traces, time in zip(frames, times, strict=True)]  # fmt: skip
    instant: dict[str, Any] = {"mode": "immediate", "frame": {"duration": 0, "redraw": False},
                               "transition": {"duration": 0}}  # fmt: skip
    steps = [{"method": "animate", "label": frame.name, "args": [[frame.name], instant]}
             for frame in named]  # fmt: skip
    playing = {"frame": {"duration": 80, "redraw": False}, "transition": {"duration": 0},
               "fromcurrent": True}  # fmt: skip
    figure = go.Figure() if figure is None else figure
    figure.add_traces(frames[len(frames) // 2])
    figure.frames = named
    figure.update_layout(
        sliders=[{"steps": steps, "currentvalue": {"prefix": "t = ", "suffix": " s"},
                  "pad": {"t": 44}, "x": 0.16, "len": 0.84, "active": len(frames) // 2}],
        updatemenus=[{"type": "buttons", "x": 0.0, "y": -0.12, "xanchor": "left", "yanchor": "top",
                      "pad": {"t": 44}, "showactive": False, "buttons": [
                          {"label": "▶", "method": "animate", "args": [None, playing]}]}],
    )  # fmt: skip
    return figure


def shade_of(fraction: float) -> str:
    """Colour of a chamber at a part of the peak pressure."""
    pale, dark = np.array(PALE), np.array(DARK)
    mixed = pale + min(abs(fraction), 1.0) * (dark - pale)
    return "rgb({},{},{})".format(*np.rint(255 * mixed).astype(int))


def course(walk: Trajectory) -> go.Figure:
    """Over one time axis: how far the ends went, what holds them, pressures, friction, energy."""
    bound = walk.forces is not None
    titles = ["displacement [mm]", "contact [mm]", "pressure [kPa]"]
    titles += ["friction [mN]"] * bound
    figure = make_subplots(len(titles), 1, shared_xaxes=True, vertical_spacing=0.05)
    rows = rows_of(walk)
    time = walk.time[rows]
    _tracks(figure, walk, rows, time)
    _contacts(figure, walk, rows, time)
    names = walk.scene.robot.chambers
    for segment, (name, values) in enumerate(zip(names, 1e-3 * walk.pressure[rows].T, strict=True)):
        figure.add_scatter(x=time, y=values, name=f"segment {name}", row=3, col=1,
                           line={"color": SHADES[segment % len(SHADES)]})  # fmt: skip
    if walk.forces is not None:
        ends = 1e3 * walk.forces.friction[rows][:, [0, -1]].T
        for name, colour, values in zip(("left", "right"), (_LEFT, _RIGHT), ends, strict=True):
            figure.add_scatter(x=time, y=values, name=f"friction, {name} end", row=4, col=1,
                               line={"color": colour, "dash": "dot"})  # fmt: skip
    for number, title in enumerate(titles, start=1):
        figure.update_yaxes(title=title, row=number, col=1)
    figure.update_xaxes(title="time [s]", row=len(titles), col=1)
    figure.update_layout(hovermode="x unified")
    return styled(figure, 210 * len(titles))


def _tracks(figure: go.Figure, walk: Trajectory, rows: Rows, time: Array) -> None:
    x, _ = walk.nodes()
    for end, name, colour in ((0, "left end", _LEFT), (-1, "right end", _RIGHT)):
        gone = 1e3 * (x[rows, end] - x[walk.start, end])
        figure.add_scatter(x=time, y=gone, name=name, line={"color": colour}, row=1, col=1)


def _contacts(figure: go.Figure, walk: Trajectory, rows: Rows, time: Array) -> None:
    """What touches in grey; a green band along the end that stays."""
    touching, s = touches(walk)[rows], 1e3 * edges(walk)
    figure.add_heatmap(
        x=time, y=0.5 * (s[1:] + s[:-1]), z=touching.T.astype(int), showscale=False,
        colorscale=[[0, _CLEAR], [1, "#9c9c9c"]], zmin=0, zmax=1, row=2, col=1,
        hovertemplate="%{y:.0f} mm: %{z}<extra>touches</extra>",
    )  # fmt: skip
    for end, holds in ((0, 0.0), (-1, 1.0)):
        held = (walk.left_slip_fraction[rows] == holds) & touching[:, end]
        figure.add_scatter(
            x=time, y=np.where(held, s[end], np.nan), mode="lines", row=2, col=1,
            line={"color": _HELD, "width": 7}, showlegend=end == 0, name="end that stays",
        )  # fmt: skip


def _strip(walk: Trajectory, row: int, x: Array, z: Array, pieces: list[slice]) -> list[Any]:
    fractions = walk.pressure[row] / walk.scene.strip.peak_pressure
    lines = []
    for piece, name, fraction, pressure in zip(
        pieces, walk.scene.robot.chambers, fractions, walk.pressure[row], strict=True
    ):
        lines.append(go.Scatter(
            x=np.round(x[row, piece], 3), y=np.round(z[row, piece], 3), mode="lines",
            line={"color": shade_of(fraction), "width": 9}, showlegend=False,
            name=f"{name}: {1e-3 * pressure:.0f} kPa",
        ))  # fmt: skip
    return lines


def _pieces(walk: Trajectory) -> list[slice]:
    """Vertices of each segment, the border's in both."""
    middle = (np.arange(walk.numerics.links + 1) + 0.5) / (walk.numerics.links + 1)
    inside = np.searchsorted(np.asarray(walk.scene.strip.borders)[1:-1], middle)
    found = [np.flatnonzero(inside == i) for i in range(len(walk.scene.strip.segments))]
    return [slice(int(part[0]), int(part[-1]) + 2) for part in found]


def rows_of(walk: Trajectory) -> Rows:
    """States that a line shows, of the cycles alone."""
    last = len(walk.time) - 1
    return np.unique(np.linspace(walk.start, last, min(_POINTS, last + 1)).astype(int))


def styled(figure: go.Figure, height: int) -> go.Figure:
    """A figure in the manner of the page."""
    figure.update_layout(
        height=height, margin={"l": 60, "r": 12, "t": 16, "b": 44}, paper_bgcolor=_CLEAR,
        plot_bgcolor=_CLEAR, font={"color": "#777"}, template="none",
        legend={"orientation": "h", "y": 1.02, "yanchor": "bottom"},
    )  # fmt: skip
    figure.update_xaxes(gridcolor="rgba(128,128,128,0.25)", zeroline=False)
    figure.update_yaxes(gridcolor="rgba(128,128,128,0.25)", zeroline=False)
    return figure
