"""Figure 6: the six modes of side contact, drawn from solved states."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from analytic import Mode, Robot, solve_elastica, solve_modes
from studies.drawing import SIMULATED, draw_ground, draw_strip

_POINTS = 181
_MAGNIFIED = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
# pressures over the peak at which each mode occurs, found by solving
_STATES = {
    Mode.LEFT_1: (0.0, 0.2, 1.0),
    Mode.LEFT_2: (0.0, 0.0, 0.3),
    Mode.LEFT_3: (0.0, 0.0, 0.02),
    Mode.RIGHT_1: (0.02, 0.0, 0.0),
    Mode.RIGHT_2: (0.3, 0.0, 0.0),
    Mode.RIGHT_3: (1.0, 0.2, 0.0),
}
_NUMERAL = dict(zip(_STATES, ("i", "ii", "iii", "iv", "v", "vi"), strict=True))


def make() -> xr.Dataset:
    """Shapes of one state in each mode, lengths over L."""
    s = np.linspace(0, 1, _POINTS)
    modes, elastica, off = [], [], []
    robot = Robot()
    for mode, fraction in _STATES.items():
        pressure = np.array([fraction]) * robot.peak_pressure
        shapes = solve_modes(robot, pressure)
        if shapes.mode[0] != mode:
            raise RuntimeError(f"no mode {mode.name} at pressures {fraction} of the peak")
        path = np.linspace(0, 1, 20)[1:, None] * pressure
        exact = solve_elastica(robot, path, links=120)
        modes.append([c[0] / robot.length for c in shapes.curve(s * robot.length)])
        elastica.append([c[-1] / robot.length for c in exact.curve(s * robot.length)])
        right = 1 - shapes.contact_right[0] / robot.length
        off.append(right if right < 1 else shapes.contact_left[0] / robot.length)
    return xr.Dataset(
        {
            "modes": (("mode", "axis", "point"), np.array(modes)),
            "elastica": (("mode", "axis", "point"), np.array(elastica)),
            "lift_off": (("mode",), np.array(off)),
            "fraction": (("mode", "segment"), np.array(list(_STATES.values()))),
        },
        coords={"mode": list(_NUMERAL.values()), "axis": ["x", "y"], "arclength": ("point", s)},
        attrs={"units": "lengths over L, pressures over the peak"},
    )


def draw(data: xr.Dataset) -> Figure:
    """The figure of that data."""
    figure = Figure(figsize=(10, 4.6), layout="constrained")
    axes = figure.subplots(2, 3)
    for ax, numeral in zip(axes.flat, data["mode"].values, strict=True):
        part = data.sel(mode=numeral)
        x, y = part["modes"].values
        u, v = part["elastica"].values
        room = min(0.29 / max(y.max(), v.max()), 0.15 / max(-y.min(), 1e-9))
        scale = max(step for step in _MAGNIFIED if step <= room)
        draw_ground(ax, -0.05, 1.05)
        inflated = np.where(part["fraction"].values > 0, 1.0, 0.0)
        draw_strip(ax, x, scale * y, inflated, linewidth=3)
        ax.plot(u, scale * v, color=SIMULATED, linewidth=1.2, dashes=(4, 2))
        at = float(np.interp(part["lift_off"], data["arclength"], x))
        ax.plot([at], [0], "o", color="white", markeredgecolor="black", markersize=6)
        pressures = ", ".join(f"{f:g}" for f in part["fraction"].values)
        magnified = f", heights × {scale:g}" if scale > 1 else ""
        ax.set_title(f"({numeral})  p = {pressures}{magnified}", fontsize=9, loc="left")
        ax.set(xlim=(-0.05, 1.05), ylim=(-0.16, 0.3))
        ax.axis("off")
    return figure
