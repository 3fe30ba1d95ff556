"""Figure 5: greatest height against displacement, on every solver and with coarse increments."""

from dataclasses import replace

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from analytic import GAITS, SOLVERS, SURFACES, Gait, Robot, Shapes, predict, solve_modes
from analytic.locomotion import state_slip
from analytic.scene import pneunet
from mjsim.results.measures import measure
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate
from studies.paper.style import SIMULATED, SOLVER

NAME = "figure5"
CAPTION = """\
Figure 5. Displacement on felt (gelatin: the same, backward) against the greatest height of the
cycle, as the peak pressure rises. (a) Every model with fine increments, for the default robot
(Gamma = 8.1) and a lighter one (Gamma = 4); crosses end the stable branch. (b) The modes of the
paper for the default robot with few increments of pressure a ramp, the friction rule applied as it
stands after each.
Agrees with the paper: hardly any travel at small amplitude, and for a light robot nothing gained by
more than about 25 % (Gamma = 4: a plateau from 0.23 on). Differs: there is no peak. With fine
increments the distance is the shortening 1 - Lambda/L at the instant when both ends become tips;
from then on both slide alike and give back what they take. So it rises until the branch ends, or,
for a robot so light that one inflated segment lifts both ends, it stays. Small slopes are not the
reason: modes, the same with finite rotations (lifted), obstacle, elastica and MuJoCo agree on it.
Coarse increments make peaks, as each step over that instant counts a part too much: saw-teeth whose
place is set by the number of increments (0.13 with two a ramp, 0.20 with three, 0.27 with five). A
peak at 25 % can come from such increments, or from the gait of the lost Figure 3; of the three
gaits here none has it.
"""

_PRESSURES = np.linspace(4e3, 77e3, 74)
_SIMULATED = np.linspace(10e3, 62e3, 9)
_COARSE = (1, 2, 3, 5, 10, 100)
_GAMMAS = (8.1, 4.0)


def coarse_displacement(shapes: Shapes) -> float:
    """Displacement on felt over L with the rule taken at the end of each increment (2.2)."""
    share = state_slip(shapes, SURFACES["felt"])[1:]
    return float(-(share * np.diff(shapes.separation)).sum()) / shapes.robot.length


def make() -> xr.Dataset:
    """Displacements and heights over L on grids of pressure."""
    felt, wave = SURFACES["felt"], GAITS["wave"]
    shape = (len(_GAMMAS), len(SOLVERS), len(_PRESSURES))
    shift, height = np.full(shape, np.nan), np.full(shape, np.nan)
    for i, gamma in enumerate(_GAMMAS):
        for k, pressure in enumerate(_PRESSURES):
            robot = replace(pneunet.with_load(Robot(), gamma), peak_pressure=float(pressure))
            for j, solver in enumerate(SOLVERS):
                walk = predict(robot, wave, felt, solver, states_per_ramp=30)
                shift[i, j, k] = walk.locomotion.per_cycle / robot.length
                height[i, j, k] = walk.shapes.amplitude.max() / robot.length
    simulated = np.full((len(_GAMMAS), 2, len(_SIMULATED)), np.nan)
    slow = Gait(wave.name, wave.stages, ramp_time=4.0)
    for i, gamma in enumerate(_GAMMAS):
        for k, pressure in enumerate(_SIMULATED):
            robot = replace(pneunet.with_load(Robot(), gamma), peak_pressure=float(pressure))
            numbers = measure(simulate(Scene(robot, slow, felt)))
            if numbers:
                simulated[i, :, k] = numbers.displacement, numbers.amplitude
    coarse = np.full((len(_COARSE), 2, len(_PRESSURES)), np.nan)
    for i, count in enumerate(_COARSE):
        for k, pressure in enumerate(_PRESSURES):
            robot = replace(Robot(), peak_pressure=float(pressure))
            shapes = solve_modes(robot, wave.pressures(count) * robot.peak_pressure)
            coarse[i, :, k] = (
                coarse_displacement(shapes),
                float(shapes.amplitude.max()) / robot.length,
            )
    return xr.Dataset(
        {
            "displacement": (("gamma", "solver", "pressure"), shift),
            "height": (("gamma", "solver", "pressure"), height),
            "planar": (("gamma", "quantity", "simulated_pressure"), simulated),
            "coarse": (("increments", "quantity", "pressure"), coarse),
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
    for gamma, dashes in zip(data["gamma"].values, ((None, None), (4, 2)), strict=True):
        for solver in data["solver"].values:
            part = {"gamma": gamma, "solver": solver}
            x = data["height"].sel(part).values
            y = data["displacement"].sel(part).values
            known = np.isfinite(y)
            name = str(solver) if gamma == data["gamma"].values[0] else None  # dashes are labelled
            line = {"dashes": dashes} if dashes[0] else {}
            left.plot(x[known], y[known], color=SOLVER[str(solver)], label=name, **line)
            if not known.all():
                left.plot(x[known][-1], y[known][-1], "x", color=SOLVER[str(solver)], markersize=7)
        y, x = data["planar"].sel(gamma=gamma).values
        left.plot(x, y, "o", color=SIMULATED, markersize=4,
                  fillstyle="full" if not dashes[0] else "none",
                  label="MuJoCo" if not dashes[0] else None)  # fmt: skip
        left.annotate(f"Γ = {gamma:.3g}", (x[-1], y[-1]), xytext=(6, -14), fontsize=8,
                      textcoords="offset points")  # fmt: skip
    left.set_title("(a) every model, fine increments", loc="left", fontsize=9)
    left.legend(frameon=False, fontsize=7.5)
    shades = np.linspace(0.8, 0.0, len(data["increments"]))
    for count, shade in zip(data["increments"].values, shades, strict=True):
        y, x = data["coarse"].sel(increments=count).values
        known = np.isfinite(y)
        right.plot(x[known], y[known], color=str(shade), label=f"{count} a ramp")
    right.axvline(0.25, color=SIMULATED, linewidth=0.8, dashes=(4, 2))
    right.text(0.255, 0.11, "paper's peak", color=SIMULATED)
    right.set_title("(b) modes, Γ = 8.1, increments of pressure", loc="left", fontsize=9)
    right.legend(frameon=False, fontsize=7.5, loc="upper left")
    for axes in (left, right):
        axes.set_xlabel("greatest height / L")
    left.set_ylabel("displacement per cycle on felt / L")
    left.set(xlim=(0, 0.5), ylim=(-0.01, 0.12))
    return figure
