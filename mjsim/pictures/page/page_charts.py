"""Charts of a page that tell their values under the pointer, by Plotly."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from mjsim.results.shades import shade_of_pixels
from mjsim.results.trajectory import Trajectory

Array = NDArray[np.float64]
Rows = NDArray[np.int_]

_FRAMES = 60  # of the scrubber; chosen
_POINTS = 600  # of a line, so that a page stays small
_SHADES = ("#9a8f78", "#5f7f95", "#8a5f95", "#6f9560", "#95605f")  # of chambers, in turn
CLEAR = "rgba(0,0,0,0)"


def frames_of(walk: Trajectory) -> Rows:
    """States that the slider shows, (F,)."""
    return np.linspace(walk.start, len(walk.time) - 1, _FRAMES).astype(int)


def rows_of(walk: Trajectory) -> Rows:
    """States that a line shows, of the cycles alone."""
    end = len(walk.time) - 1
    return np.unique(np.linspace(walk.start, end, min(_POINTS, end + 1)).astype(int))


def limb_line(
    across: Array, up: Array, name: str, pressure: float, peak: float, **more: Any
) -> go.Scatter:  # fmt: skip
    """A limb or a segment at one time, dark where it is inflated.

    Args:
        across, up: of its vertices, (N,) [mm].
        name: of its chamber.
        pressure, peak: in it, and the robot's peak pressure [Pa].
        more: properties of the trace.
    """
    colour = "rgb({},{},{})".format(*shade_of_pixels(pressure / peak))
    return go.Scatter(x=np.round(across, 3), y=np.round(up, 3), mode="lines", showlegend=False,
                      line={"color": colour, "width": 8}, name=f"{name}: {1e-3 * pressure:.0f} kPa",
                      **more)  # fmt: skip


def pressures(walk: Trajectory) -> list[go.Scatter]:
    """Pressure of each chamber over time [kPa]."""
    rows = rows_of(walk)
    chambers = zip(walk.scene.robot.chambers, 1e-3 * walk.pressure[rows].T, strict=True)
    return [go.Scatter(x=walk.time[rows], y=values, name=name, mode="lines",
                       line={"color": _SHADES[number % len(_SHADES)]})
            for number, (name, values) in enumerate(chambers)]  # fmt: skip


def over_time(charts: Mapping[str, Sequence[Any]], height: int) -> go.Figure:
    """Charts below each other over one time axis.

    Args:
        charts: traces of each, by the title of its axis.
        height: of one chart [pixels].
    """
    figure = make_subplots(len(charts), 1, shared_xaxes=True, vertical_spacing=0.05)
    for number, (title, traces) in enumerate(charts.items(), start=1):
        figure.add_traces(traces, rows=number, cols=1)
        figure.update_yaxes(title=title, row=number, col=1)
    figure.update_xaxes(title="time [s]", row=len(charts), col=1)
    figure.update_layout(hovermode="x unified")
    return styled(figure, height * len(charts))


def scrubbed(frames: list[list[Any]], times: Array, figure: go.Figure | None = None) -> go.Figure:
    """Figure with the lines of the time at which a slider stands, or played.

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


def styled(figure: go.Figure, height: int) -> go.Figure:
    """The figure in the style of the page."""
    figure.update_layout(
        height=height, margin={"l": 60, "r": 12, "t": 16, "b": 44}, paper_bgcolor=CLEAR,
        plot_bgcolor=CLEAR, font={"color": "#777"}, template="none",
        legend={"orientation": "h", "y": 1.02, "yanchor": "bottom"},
    )  # fmt: skip
    figure.update_xaxes(gridcolor="rgba(128,128,128,0.25)", zeroline=False)
    figure.update_yaxes(gridcolor="rgba(128,128,128,0.25)", zeroline=False)
    return figure
