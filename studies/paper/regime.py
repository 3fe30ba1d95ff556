"""The regime map: which way and how far, over the friction ratio and the amplitude."""

from dataclasses import replace

import numpy as np
import xarray as xr
from matplotlib.cm import ScalarMappable
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from analytic import GAITS, SURFACES, Robot, Surface, displacements, solve_elastica
from analytic.friction.laws import neutral_ratio
from studies.paper.style import FONT

NAME = "regime"
CAPTION = """\
Regime map. Displacement per cycle by elastica over the surface's ratio V_t / (tau q L) and the
greatest height over L, as the peak pressure rises from 4 to 77 kPa, for the default robot and one
of a third and of three times its weight; the black line is the neutral curve. Felt is the left
edge, gelatin the right one, polyethylene the dashed line; the star is the paper's robot on
polyethylene, on the neutral curve; grey is beyond the stable branch, or no pressure leads there.
Agrees with the paper: one gait, and the friction ratio alone turns the robot round. Differs:
standing still is a curve in this map, not a property of polyethylene; which side of it {0.5, 1}
falls on depends on the amplitude and on the weight, and the default robot was identified as one
that stands still.
"""

_LOADS = (1 / 3, 1.0, 3.0)
_PRESSURES = np.linspace(4e3, 77e3, 50)
_RATIOS = np.concatenate([[0.0], np.geomspace(0.01, 3.0, 79)])
_PER_RAMP = 120
_HIGHEST = 0.5  # amplitude over L that is shown


def make() -> xr.Dataset:
    """Displacements over L; NaN where the branch has ended."""
    path = GAITS["wave"].pressures(_PER_RAMP)
    shift = np.full((len(_LOADS), len(_PRESSURES), len(_RATIOS)), np.nan)
    amplitude = np.full((len(_LOADS), len(_PRESSURES)), np.nan)
    for i, load in enumerate(_LOADS):
        for j, pressure in enumerate(_PRESSURES):
            robot = replace(
                Robot(),
                weight_per_length=load * Robot().weight_per_length,
                peak_pressure=float(pressure),
            )
            shapes = solve_elastica(robot, path * pressure)
            amplitude[i, j] = shapes.amplitude.max() / robot.length
            for k, ratio in enumerate(_RATIOS):
                side = robot.width * robot.length  # of a shear strength of 1 Pa
                surface = Surface("any", tip_force=float(ratio) * side, shear_strength=1.0)
                shift[i, j, k] = displacements(shapes, surface).per_cycle / robot.length
    return xr.Dataset(
        {
            "displacement": (("load", "pressure", "ratio"), shift),
            "amplitude": (("load", "pressure"), amplitude),
        },
        coords={"load": list(_LOADS), "pressure": _PRESSURES, "ratio": _RATIOS},
        attrs={
            "units": "displacement and amplitude over L, pressure in Pa, load over the default's"
        },
    )


def draw(data: xr.Dataset) -> Figure:
    """The figure of that data."""
    figure = Figure(figsize=(11, 4), layout="constrained")
    axes = figure.subplots(1, 3, sharey=True)
    ratio = data["ratio"].values.copy()
    ratio[0] = 0.5 * ratio[1]  # 0 has no place on a logarithmic axis: felt sits at the left edge
    limit = 0.08
    polyethylene = neutral_ratio(SURFACES["polyethylene"], Robot())
    norm, colours = TwoSlopeNorm(0, -limit, limit), "RdBu"
    for ax, load in zip(axes, data["load"].values, strict=True):
        height = data["amplitude"].sel(load=load).values
        known = np.isfinite(height)
        height, shift = height[known], data["displacement"].sel(load=load).values[known]
        ax.set_facecolor("0.85")
        ax.pcolormesh(ratio, height, shift, cmap=colours, shading="nearest",
                              norm=norm, rasterized=True)  # fmt: skip
        ax.contour(ratio, height, np.ma.masked_invalid(shift), levels=[0.0], colors="black",
                   linewidths=1.4)  # fmt: skip
        ax.axvline(polyethylene, color="0.2", dashes=(4, 2), lw=1)
        if load == 1:
            star = np.interp(Robot().peak_pressure, data["pressure"].values[known], height)
            ax.plot(polyethylene, star, "*", ms=13, color="#f2c14e",
                    mec="black", mew=0.8)  # fmt: skip
        ax.set_xscale("log")
        ax.set_xlabel(r"$V_t / (\tau q L)$")
        ax.set_title(f"{load:.3g} × the default weight", fontsize=9, pad=16)
        for x, name in ((ratio[0], "felt"), (polyethylene, "polyethylene"), (ratio[-1], "gelatin")):
            ax.annotate(name, (x, _HIGHEST), xytext=(0, 3), textcoords="offset points",
                        ha="center", fontsize=FONT["font.size"] - 2)  # fmt: skip
    axes[0].set(ylabel="greatest height / L", ylim=(0, _HIGHEST))
    figure.colorbar(
        ScalarMappable(norm, colours),
        ax=axes,
        label="displacement per cycle / L",
        extend="both",
        shrink=0.9,
    )
    return figure
