"""The regime map: displacement over the friction ratio and the amplitude."""

from dataclasses import replace

import numpy as np
import xarray as xr
from matplotlib.cm import ScalarMappable
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from analytic import GAITS, SURFACES, Robot, Surface, displacements, solve_elastica
from analytic.friction.laws import neutral_ratio
from studies.drawing import FONT

_LOADS = (1 / 3, 1.0, 3.0)
_PRESSURES = np.linspace(4e3, 77e3, 50)
_RATIOS = (0.0, *np.geomspace(0.01, 3.0, 79).tolist())
_PER_RAMP = 120
_TIMES = {0.333: "a third of", 1.0: "", 3.0: "3 times"}
_HIGHEST = 0.5  # amplitude over L that is shown


def _walked(load: float, pressure: float) -> list[float]:
    """Amplitude of a robot of so many times the weight, and displacements by ratio, over L."""
    robot = replace(Robot(), weight_per_length=load * Robot().weight_per_length,
                    peak_pressure=pressure)  # fmt: skip
    shapes = solve_elastica(robot, GAITS["wave"].pressures(_PER_RAMP) * pressure)
    side = robot.width * robot.length  # force of a shear strength of 1 Pa, N
    surfaces = (Surface("any", tip_force=ratio * side, shear_strength=1.0) for ratio in _RATIOS)
    lengths = (displacements(shapes, surface).per_cycle for surface in surfaces)
    return [length / robot.length for length in (shapes.amplitude.max(), *lengths)]


def make() -> xr.Dataset:
    """Displacements over L; NaN where the branch has ended."""
    walks = np.array([[_walked(load, pressure) for pressure in _PRESSURES.tolist()]
                      for load in _LOADS])  # fmt: skip
    return xr.Dataset(
        {
            "displacement": (("load", "pressure", "ratio"), walks[..., 1:]),
            "amplitude": (("load", "pressure"), walks[..., 0]),
        },
        coords={"load": list(_LOADS), "pressure": _PRESSURES, "ratio": list(_RATIOS)},
        attrs={
            "units": "displacement and amplitude over L, pressure in Pa, load over the default's"
        },
    )


def draw(data: xr.Dataset) -> Figure:
    """The figure of that data."""
    figure = Figure(figsize=(11, 4.3), layout="constrained")
    figure.suptitle("One gait: forward or backward by the friction of tips over that of sides; "
                    "black: stands still", fontsize=10)  # fmt: skip
    axes = figure.subplots(1, 3, sharey=True)
    ratio = data["ratio"].values.copy()
    ratio[0] = 0.5 * ratio[1]  # 0 has no place on a logarithmic axis: felt sits at the left edge
    polyethylene = neutral_ratio(SURFACES["polyethylene"], Robot())
    norm, colours = TwoSlopeNorm(0, -0.08, 0.08), "RdBu"
    for ax, load in zip(axes, data["load"].values, strict=True):
        height = data["amplitude"].sel(load=load).values
        finite = np.isfinite(height)
        height, shift = height[finite], data["displacement"].sel(load=load).values[finite]
        ax.set_facecolor("0.85")
        ax.pcolormesh(ratio, height, shift, cmap=colours, shading="nearest", norm=norm,
                      rasterized=True)  # fmt: skip
        ax.contour(ratio, height, np.ma.masked_invalid(shift), levels=[0.0], colors="black",
                   linewidths=1.4)  # fmt: skip
        ax.axvline(polyethylene, color="0.2", dashes=(4, 2), lw=1)
        if load == 1:
            star = np.interp(Robot().peak_pressure, data["pressure"].values[finite], height)
            ax.plot(polyethylene, star, "*", ms=13, color="#f2c14e", mec="black", mew=0.8)
        ax.set_xscale("log")
        ax.text(0.5, 0.97, "no stable shape, or not reached", transform=ax.transAxes, ha="center",
                va="top", fontsize=FONT["font.size"] - 2)  # fmt: skip
        for place, way in ((0.03, "forward"), (0.97, "backward")):
            ax.text(place, 0.53, way, transform=ax.transAxes, ha="right" if place > 0.5 else "left",
                    color="white" if load == 3 else "black")  # fmt: skip
        ax.set_xlabel(r"friction of a tip over that of a side, $V_t / (\tau q L)$")
        ax.set_title(f"{_TIMES[round(load, 3)]} the default weight".strip(), fontsize=9, pad=16)
        for x, name in ((ratio[0], "felt"), (polyethylene, "polyethylene"), (ratio[-1], "gelatin")):
            ax.annotate(name, (x, _HIGHEST), xytext=(0, 3), textcoords="offset points",
                        ha="center", fontsize=FONT["font.size"] - 2)  # fmt: skip
    axes[0].set(ylabel="greatest height / L", ylim=(0, _HIGHEST))
    figure.colorbar(ScalarMappable(norm, colours), ax=axes, extend="both", shrink=0.9,
                    label="displacement per cycle / L:  − backward,  + forward")  # fmt: skip
    return figure
