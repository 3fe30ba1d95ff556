"""Figure 5: greatest height against displacement, on every solver and with coarse increments."""

import math
from dataclasses import replace

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from analytic import GAITS, SOLVERS, SURFACES, Robot, Shapes, predict, solve_modes
from analytic.locomotion import state_slip
from analytic.scene import pneunet
from mjsim.results.measures import measure
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate
from studies.drawing import COLOURS, SIMULATED

_FELT, _WAVE = SURFACES["felt"], GAITS["wave"]
_PRESSURES = np.linspace(4e3, 77e3, 74)
_SIMULATED = np.linspace(10e3, 62e3, 9)
_COARSE = (1, 2, 3, 5, 10, 100)
_GAMMAS = (8.1, 4.0)
_RAMP_TIME = 4.0  # s, of the simulated gait


def coarse_displacement(shapes: Shapes) -> float:
    """Displacement on felt over L with the rule taken at the end of each increment (2.2)."""
    slip = state_slip(shapes, _FELT)[1:]
    return float(-(slip * np.diff(shapes.separation)).sum()) / shapes.robot.length


def _predicted(robot: Robot, solver: str) -> tuple[float, float]:
    """Displacement and greatest height over L by a solver, with fine increments."""
    walk = predict(robot, _WAVE, _FELT, solver, states_per_ramp=30)
    return walk.locomotion.per_cycle / robot.length, walk.shapes.amplitude.max() / robot.length


def _simulated(robot: Robot) -> tuple[float, float]:
    """Displacement and greatest height over L by MuJoCo."""
    numbers = measure(simulate(Scene(robot, replace(_WAVE, ramp_time=_RAMP_TIME), _FELT)))
    return (numbers.displacement, numbers.amplitude) if numbers else (math.nan, math.nan)


def _coarse(robot: Robot, increments: int) -> tuple[float, float]:
    """Displacement and height by the modes, with so many increments per ramp."""
    shapes = solve_modes(robot, _WAVE.pressures(increments) * robot.peak_pressure)
    return coarse_displacement(shapes), float(shapes.amplitude.max()) / robot.length


def make() -> xr.Dataset:
    """Displacements and heights over L on grids of pressure."""
    base = [pneunet.with_load(Robot(), gamma) for gamma in _GAMMAS]

    def under(robot: Robot, pressures: np.ndarray) -> list[Robot]:
        return [replace(robot, peak_pressure=pressure) for pressure in pressures.tolist()]

    fine = [[[_predicted(robot, solver) for robot in under(light, _PRESSURES)]
             for solver in SOLVERS] for light in base]  # fmt: skip
    simulated = [[_simulated(robot) for robot in under(light, _SIMULATED)] for light in base]
    coarse = [[_coarse(robot, count) for robot in under(Robot(), _PRESSURES)] for count in _COARSE]
    displacement, height = np.moveaxis(np.array(fine), -1, 0)
    return xr.Dataset(
        {
            "displacement": (("gamma", "solver", "pressure"), displacement),
            "height": (("gamma", "solver", "pressure"), height),
            "chain": (("gamma", "quantity", "simulated_pressure"), np.swapaxes(simulated, 1, 2)),
            "coarse": (("increments", "quantity", "pressure"), np.swapaxes(coarse, 1, 2)),
        },
        coords={"gamma": list(_GAMMAS), "solver": list(SOLVERS), "pressure": _PRESSURES,
                "quantity": ["displacement", "height"], "increments": list(_COARSE),
                "simulated_pressure": _SIMULATED},
        attrs={"units": "lengths over L, pressure in Pa"},
    )  # fmt: skip


def draw(data: xr.Dataset) -> Figure:
    """The figure of that data."""
    figure = Figure(figsize=(10, 4.3), layout="constrained")
    left, right = figure.subplots(1, 2, sharex=True, sharey=True)
    default, light = data["gamma"].values
    for gamma in (default, light):
        style = {"dashes": (4, 2)} if gamma == light else {}
        robot = data.sel(gamma=gamma)
        for name in map(str, data["solver"].values):
            points = robot.sel(solver=name).dropna("pressure", subset=["displacement"])
            x, y = points["height"], points["displacement"]
            left.plot(x, y, color=COLOURS[name], label=None if style else name, **style)
            if points.sizes["pressure"] < data.sizes["pressure"]:
                left.plot(x[-1], y[-1], "x", color=COLOURS[name], markersize=7)
        y, x = robot["chain"].values
        left.plot(x, y, "o", color=SIMULATED, markersize=4, fillstyle="none" if style else "full",
                  label=None if style else "MuJoCo")  # fmt: skip
        left.annotate(f"Γ = {gamma:.3g}", (x[-1], y[-1]), xytext=(6, -14), fontsize=8,
                      textcoords="offset points")  # fmt: skip
    left.set_title("(a) every model, fine increments", loc="left", fontsize=9)
    left.legend(frameon=False, fontsize=7.5)
    shades = np.linspace(0.8, 0.0, len(data["increments"]))
    for count, shade in zip(data["increments"].values, shades, strict=True):
        y, x = data["coarse"].sel(increments=count).dropna("pressure").values
        right.plot(x, y, color=str(shade), label=f"{count} per ramp")
    right.axvline(0.25, color=SIMULATED, linewidth=0.8, dashes=(4, 2))
    right.text(0.255, 0.11, "paper's peak", color=SIMULATED)
    right.set_title("(b) modes, Γ = 8.1, increments of pressure", loc="left", fontsize=9)
    right.legend(frameon=False, fontsize=7.5, loc="upper left")
    for axes in (left, right):
        axes.set_xlabel("greatest height / L")
    left.set_ylabel("displacement per cycle on felt / L")
    left.set(xlim=(0, 0.5), ylim=(-0.01, 0.12))
    return figure
