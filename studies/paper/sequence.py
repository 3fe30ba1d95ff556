"""Figure 4: the strip through the gait on the three surfaces, theory and MuJoCo together."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from analytic import GAITS, SURFACES, Gait, Robot, displacements, solve_elastica
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate
from studies.drawing import SIMULATED, draw_ground, draw_strip

_POINTS = 91
_PER_RAMP = 200
_RAMP_TIME = 4.0  # s; slow enough that inertia does not show


def make() -> xr.Dataset:
    """Shapes at the stages and in the middle of the arch, lengths over L."""
    robot, wave = Robot(), GAITS["wave"]
    gait = Gait(wave.name, wave.stages, _RAMP_TIME)
    moments = np.array([0.0, 1.0, 2.0, 2.5, 3.0, 4.0, 5.0])  # in ramps
    index = np.round(moments * _PER_RAMP).astype(int)
    fractions = gait.pressures(_PER_RAMP)
    shapes = solve_elastica(robot, fractions * robot.peak_pressure)
    x, y = shapes.curve(np.linspace(0, robot.length, _POINTS))
    theory, simulated = [], []
    for surface in SURFACES.values():
        left = displacements(shapes, surface).left[index, None]
        theory.append(np.stack([x[index] + left, y[index]]))
        walk = simulate(Scene(robot, gait, surface))
        steps = np.clip(np.searchsorted(walk.time, moments * _RAMP_TIME), 0, len(walk.time) - 1)
        nodes = np.stack(walk.nodes())[:, steps]
        nodes[0] -= walk.line[walk.start, 0, 0]
        simulated.append(nodes)
    return xr.Dataset(
        {
            "elastica": (("surface", "axis", "moment", "point"), np.array(theory) / robot.length),
            "mujoco": (("surface", "axis", "moment", "node"), np.array(simulated) / robot.length),
            "fraction": (("moment", "segment"), fractions[index]),
        },
        coords={"surface": list(SURFACES), "axis": ["x", "y"], "moment": moments},
        attrs={"units": "lengths over L, moments in ramps of the gait"},
    )


def draw(data: xr.Dataset) -> Figure:
    """The figure of that data."""
    moments = data["moment"].values
    figure = Figure(figsize=(10, 8.4), layout="constrained")
    axes = figure.subplots(len(moments), 3, sharex=True, sharey=True)
    for column, surface in enumerate(data["surface"].values):
        axes[0, column].set_title(str(surface))
        for row, moment in enumerate(moments):
            ax = axes[row, column]
            x, y = data["elastica"].sel(surface=surface, moment=moment).values
            u, v = data["mujoco"].sel(surface=surface, moment=moment).values
            fraction = data["fraction"].sel(moment=moment).values
            draw_ground(ax, -0.12, 1.2)
            ax.plot([0, 0], [-0.025, 0.06], color="0.45", linewidth=0.8)
            draw_strip(ax, x, y, fraction, linewidth=3.2)
            ax.plot(u, v, color=SIMULATED, linewidth=1.1, dashes=(4, 2))
            ax.text(1.18, 0.27, f"{x[0]:+.3f}", ha="right")
            ax.text(1.18, 0.19, f"{u[0]:+.3f}", ha="right", color=SIMULATED)
            if column == 0:
                stage = "  ".join(f"{f:.1f}".rstrip("0").rstrip(".") for f in fraction)
                ax.text(-0.1, 0.25, f"p = {stage}", color="0.3")
            ax.set_aspect("equal")
            ax.set(xlim=(-0.12, 1.2), ylim=(-0.03, 0.36))
            ax.axis("off")
    figure.suptitle("One cycle: elastica (thick) and MuJoCo (red), x and y over L", fontsize=10)
    return figure
