"""Charts of a walk of a strip for the page; see mjsim.pictures.page.page_charts."""

from typing import Any

import numpy as np
import plotly.graph_objects as go

from mjsim.pictures.page import page_charts
from mjsim.pictures.page.page_charts import CLEAR, Rows, over_time, rows_of
from mjsim.results.plots import anchored, edges, segments, touches
from mjsim.results.trajectory import Trajectory

_ENDS = ((0, "left", "#4a7de0"), (-1, "right", "#d9702f"))
_ANCHORED = "#1c9c4a"


def shapes(walk: Trajectory) -> go.Figure:
    """The strip at the time at which a slider stands, dark where it is inflated."""
    rows = page_charts.frames_of(walk)
    x, z = 1e3 * np.array(walk.nodes())[:, rows]
    peak, names, pieces = walk.scene.strip.peak_pressure, walk.scene.robot.chambers, segments(walk)
    frames = [
        [page_charts.limb_line(along[piece], up[piece], name, pressure, peak)
         for piece, name, pressure in zip(pieces, names, walk.pressure[row], strict=True)]
        for along, up, row in zip(x, z, rows, strict=True)
    ]  # fmt: skip
    figure = page_charts.scrubbed(frames, walk.time[rows])
    margin = 0.05e3 * walk.scene.strip.length
    low, high = float(x.min()) - margin, float(x.max()) + margin
    figure.update_layout(
        shapes=[{"type": "line", "layer": "below", "x0": low, "x1": high, "y0": 0, "y1": 0,
                 "line": {"color": "#999", "width": 1}}],
    )  # fmt: skip
    figure.update_xaxes(title="x [mm]", range=[low, high])
    highest = 1e3 * float(walk.line[..., 2].max())
    figure.update_yaxes(title="height [mm]", scaleanchor="x", range=[-4, highest + 6])
    return page_charts.styled(figure, 380)


def course(walk: Trajectory) -> go.Figure:
    """Displacement and contacts of the ends, pressures and friction over one time axis."""
    rows = rows_of(walk)
    time, (x, _) = walk.time[rows], walk.nodes()
    charts = {
        "displacement [mm]": [
            go.Scatter(x=time, y=1e3 * (x[rows, end] - x[walk.start, end]), name=f"{side} end",
                       mode="lines", line={"color": colour})
            for end, side, colour in _ENDS
        ],
        "contact [mm]": _contacts(walk, rows),
        "pressure [kPa]": [trace.update(name=f"segment {trace.name}")
                           for trace in page_charts.pressures(walk)],
    }  # fmt: skip
    if walk.forces is not None:
        charts["friction [mN]"] = [
            go.Scatter(x=time, y=1e3 * walk.forces.friction[rows, end], mode="lines",
                       name=f"friction, {side} end", line={"color": colour, "dash": "dot"})
            for end, side, colour in _ENDS
        ]  # fmt: skip
    return over_time(charts, 210)


def _contacts(walk: Trajectory, rows: Rows) -> list[Any]:
    """Grey where the strip touches; a green band along the end that stays."""
    touching, s, time = touches(walk)[rows], 1e3 * edges(walk), walk.time[rows]
    traces: list[Any] = [go.Heatmap(
        x=time, y=0.5 * (s[1:] + s[:-1]), z=touching.T.astype(int), showscale=False,
        colorscale=[[0, CLEAR], [1, "#9c9c9c"]], zmin=0, zmax=1,
        hovertemplate="%{y:.0f} mm: %{z}<extra>touches</extra>",
    )]  # fmt: skip
    for end, _, _ in _ENDS:
        stays = anchored(walk, end)[rows] & touching[:, end]
        traces.append(go.Scatter(
            x=time, y=np.where(stays, s[end], np.nan), mode="lines", name="end that stays",
            line={"color": _ANCHORED, "width": 7}, showlegend=end == 0,
        ))  # fmt: skip
    return traces
