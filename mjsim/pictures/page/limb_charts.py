"""Charts of a walk of a robot of limbs for the page; see mjsim.pictures.page.page_charts."""

from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from analytic.scene.limbs import chambers_by_limb, limbs_of
from mjsim.pictures.page import page_charts
from mjsim.pictures.page.page_charts import Array, over_time, rows_of
from mjsim.results.trajectory import Trajectory


def shapes(walk: Trajectory) -> go.Figure:
    """The limbs from the side and from above at the time at which a slider stands."""
    rows = page_charts.frames_of(walk)
    places = 1e3 * walk.position[rows]
    figure = make_subplots(2, 1, shared_xaxes=True, vertical_spacing=0.08)
    frames = [_limbs(walk, row, at) for row, at in zip(rows, places, strict=True)]
    figure = page_charts.scrubbed(frames, walk.time[rows], figure)
    (x_low, y_low, _), (x_high, y_high, z_high) = (
        extreme(places, axis=(0, 1, 2)).tolist() for extreme in (np.min, np.max)
    )
    figure.update_xaxes(range=[x_low - 6, x_high + 6])
    figure.update_xaxes(title="x [mm]", row=2, col=1)
    figure.update_yaxes(title="height [mm]", scaleanchor="x", row=1, col=1,
                        range=[-4, z_high + 6])  # fmt: skip
    figure.update_yaxes(title="y [mm]", scaleanchor="x", row=2, col=1,
                        range=[y_low - 6, y_high + 6])  # fmt: skip
    return page_charts.styled(figure, 560)


def course(walk: Trajectory) -> go.Figure:
    """Displacement and turn of the trunk, pressures and contacts over one time axis."""
    rows = rows_of(walk)
    gone = 1e3 * np.array([walk.moved(walk.start, row) for row in rows])
    turn = np.degrees(walk.heading[rows] - walk.heading[walk.start])

    def line(name: str, values: Array, **more: Any) -> go.Scatter:
        return go.Scatter(x=walk.time[rows], y=values, name=name, mode="lines", **more)

    return over_time({
        "displacement [mm]": [line("ahead", gone[:, 0]), line("to the left", gone[:, 1])],
        "turn [°]": [line("turned to the left", turn)],
        "pressure [kPa]": page_charts.pressures(walk),
        "limbs on the ground": [line("limbs on the ground", walk.contacts[rows],
                                     line={"shape": "hv"}, showlegend=False)],
    }, 180)  # fmt: skip


def _limbs(walk: Trajectory, row: int, places: Array) -> list[Any]:
    """One line per limb from the side, then from above; places in mm."""
    robot = walk.scene.robot
    chambers = zip(limbs_of(robot), places, chambers_by_limb(robot), strict=True)
    limbs = [(limb.name, at, float(walk.pressure[row, part].mean())) for limb, at, part in chambers]
    return [
        page_charts.limb_line(at[:, 0], at[:, across], name, pressure, robot.peak_pressure,
                              xaxis=f"x{number}", yaxis=f"y{number}")
        for number, across in ((1, 2), (2, 1)) for name, at, pressure in limbs
    ]  # fmt: skip
