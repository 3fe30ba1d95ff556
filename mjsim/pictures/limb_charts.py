"""Charts of a walk of a robot of limbs that tell their values under the pointer, by Plotly."""

from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from analytic.scene.limbs import chambers_by_limb, limbs_of
from mjsim.pictures.page_charts import SHADES, rows_of, scrubbed, shade_of, styled
from mjsim.results.trajectory import Trajectory

Array = NDArray[np.float64]

_FRAMES = 60  # of the scrubber; chosen


def shapes(walk: Trajectory) -> go.Figure:
    """The limbs from the side and from above at the time that a slider says."""
    rows = np.linspace(walk.start, len(walk.time) - 1, _FRAMES).astype(int)
    places = 1e3 * walk.position[rows]
    figure = make_subplots(2, 1, shared_xaxes=True, vertical_spacing=0.08)
    frames = [_limbs(walk, row, at) for row, at in zip(rows, places, strict=True)]
    figure = scrubbed(frames, walk.time[rows], figure)
    low, high = places[..., 0].min() - 6, places[..., 0].max() + 6
    figure.update_xaxes(range=[low, high])
    figure.update_xaxes(title="x [mm]", row=2, col=1)
    figure.update_yaxes(title="height [mm]", scaleanchor="x", row=1, col=1,
                        range=[-4, places[..., 2].max() + 6])  # fmt: skip
    figure.update_yaxes(title="y [mm]", scaleanchor="x", row=2, col=1,
                        range=[places[..., 1].min() - 6, places[..., 1].max() + 6])  # fmt: skip
    return styled(figure, 560)


def course(walk: Trajectory) -> go.Figure:
    """Over one time axis: how far and about what angle the trunk went, pressures, contacts."""
    titles = ["displacement [mm]", "turn [°]", "pressure [kPa]", "limbs on the ground"]
    figure = make_subplots(len(titles), 1, shared_xaxes=True, vertical_spacing=0.05)
    rows = rows_of(walk)
    time = walk.time[rows]
    gone = 1e3 * np.array([walk.moved(walk.start, row) for row in rows])
    turned = np.degrees(walk.heading[rows] - walk.heading[walk.start])
    for name, values in (("ahead", gone[:, 0]), ("to the left", gone[:, 1])):
        figure.add_scatter(x=time, y=values, name=name, row=1, col=1)
    figure.add_scatter(x=time, y=turned, name="turned to the left", row=2, col=1)
    for chamber, values in enumerate(1e-3 * walk.pressure[rows].T):
        name = walk.scene.robot.chambers[chamber]
        figure.add_scatter(x=time, y=values, name=name, row=3, col=1,
                           line={"color": SHADES[chamber % len(SHADES)]})  # fmt: skip
    figure.add_scatter(x=time, y=walk.contacts[rows], name="limbs on the ground", row=4, col=1,
                       line={"shape": "hv"}, showlegend=False)  # fmt: skip
    for number, title in enumerate(titles, start=1):
        figure.update_yaxes(title=title, row=number, col=1)
    figure.update_xaxes(title="time [s]", row=len(titles), col=1)
    figure.update_layout(hovermode="x unified")
    return styled(figure, 180 * len(titles))


def _limbs(walk: Trajectory, row: int, places: Array) -> list[Any]:
    """A line a limb from the side, then from above; places in mm."""
    robot = walk.scene.robot
    limbs, parts = limbs_of(robot), chambers_by_limb(robot)
    lines = []
    for number, across in ((1, 2), (2, 1)):
        for limb, at in enumerate(np.round(places, 3)):
            pressure = float(walk.pressure[row, parts[limb]].mean())
            lines.append(go.Scatter(
                x=at[:, 0], y=at[:, across], mode="lines", xaxis=f"x{number}", yaxis=f"y{number}",
                line={"color": shade_of(pressure / robot.peak_pressure), "width": 7},
                name=f"{limbs[limb].name}: {1e-3 * pressure:.0f} kPa", showlegend=False,
            ))  # fmt: skip
    return lines
