"""Readings of the lost Figure 3 that peak at an amplitude of a quarter, or stand still there."""

import itertools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from analytic import SURFACES, Gait, Robot, predict
from analytic.scene import pneunet
from analytic.scene.trapezoid import trapezoid
from studies import Array
from studies.drawing import COLOURS
from studies.table import pool

_QUANTITIES = ("height", "felt", "polyethylene")
_LAGS = (1 / 8, 1 / 6, 1 / 5, 1 / 4, 0.3, 1 / 3, 0.4, 0.5)
_DUTIES = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7)
_RAMPS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5)
_GAMMAS = (1, 2, 4, 6, 8.1, 12, 16, 24, 32, 40)
_PRESSURES = np.linspace(2e3, 90e3, 45)
_MOST_STAGES = 6
_STATES = 12  # in a ramp
_HIGHEST = 0.45  # amplitude over L at which a sweep ends
_AT, _FROM, _TO = 0.25, 0.2, 0.3  # amplitude over L of the paper's peak, and what counts as such
_LEAST = 0.005  # of the length: a robot that goes less has no peak
_LOSS, _STILL = 0.1, 0.1  # of the distance on felt: a peak loses more; a standstill goes less


class Reading(NamedTuple):
    """Distance of one gait on one robot as the pressure rises.

    Attributes:
        gait, gamma, solver: name of the gait, load of the robot, name of the solver.
        loss: part of the greatest distance on felt that is lost beyond a peak at about a quarter;
            0 without such a peak.
        ratio: distance on polyethylene over that on felt, at an amplitude of a quarter.
        plateau: True if the distance stays within a tenth of its greatest from there on.
        rows: amplitude and distances, see sweep.
    """

    gait: str
    gamma: float
    solver: str
    loss: float
    ratio: float
    plateau: bool
    rows: Array


def stage_gaits() -> Iterator[Gait]:
    """Sequences of stages in which each segment inflates once, the left ones first."""
    for count in range(2, _MOST_STAGES + 1):
        starts = itertools.combinations_with_replacement(range(count), 2)
        ends = itertools.product(range(1, count + 1), repeat=3)
        for later, end in itertools.product(starts, ends):
            lives = [range(*life) for life in zip((0, *later), end, strict=True)]
            words = [tuple(float(k in life) for life in lives) for k in range(count)]
            stages = ((0.0, 0.0, 0.0), *words, (0.0, 0.0, 0.0))
            changing = all(a != b for a, b in itertools.pairwise(stages))
            if all(lives) and max(end) == count and changing:
                names = ("".join(f"{value:.0f}" for value in word) for word in words)
                yield Gait("-".join(["stages", *names]), stages)


def gaits() -> list[Gait]:
    """Every gait that is tried."""
    family = [
        trapezoid(lag, duty, ramp)
        for lag, duty, ramp in itertools.product(_LAGS, _DUTIES, _RAMPS)
        if ramp <= min(duty, 1 - duty) + 1e-9
    ]
    return [*family, *stage_gaits()]


def sweep(gait: Gait, gamma: float, solver: str, pressures: Array) -> Array:
    """Amplitude and distances on felt and polyethylene over L, by pressure, (P, 3)."""
    rows = []
    for pressure in pressures:
        robot = pneunet.with_load(Robot(peak_pressure=float(pressure)), gamma)
        walks = [predict(robot, gait, SURFACES[name], solver, _STATES)
                 for name in _QUANTITIES[1:]]  # fmt: skip
        height = float(walks[0].shapes.amplitude.max()) / robot.length
        row = [height, *(walk.locomotion.per_cycle / robot.length for walk in walks)]
        if not np.isfinite(row).all() or height > _HIGHEST:
            break
        rows.append(row)
    return np.array(rows).reshape(-1, 3)


def read(gait: str, gamma: float, solver: str, rows: Array) -> Reading | None:
    """Reading of a sweep; None if the robot hardly moves or never rises so high."""
    if len(rows) < 5 or rows[-1, 0] < _TO:
        return None
    height, felt, polyethylene = rows.T
    far = np.abs(felt)
    best, at = int(np.argmax(far)), int(np.argmin(np.abs(height - _AT)))
    if far[best] < _LEAST or far[at] < _LEAST:
        return None
    peak = _FROM <= height[best] <= _TO
    loss = float(1 - far[best:].min() / far[best]) if peak else 0.0
    first = int(np.argmax(far >= 0.9 * far[best]))
    plateau = height[first] <= _TO - 0.02 and bool((far[first:] >= 0.9 * far[best]).all())
    return Reading(gait, gamma, solver, loss, float(polyethylene[at] / far[at]),
                   plateau and loss < _LOSS, rows)  # fmt: skip


def _readings(gait: Gait) -> list[Reading]:
    """Readings by the modes, and by elastica where they say anything."""
    readings = []
    for gamma in _GAMMAS:
        rows = sweep(gait, gamma, "modes", _PRESSURES)
        modes = read(gait.name, gamma, "modes", rows)
        readings.append(modes)
        if modes and (modes.loss > _LOSS or modes.plateau or abs(modes.ratio) < _STILL):
            rows = sweep(gait, gamma, "elastica", _PRESSURES[: len(rows) + 2 : 2])
            readings.append(read(gait.name, gamma, "elastica", rows))
    return [reading for reading in readings if reading]


def make() -> xr.Dataset:
    """Every reading, and the sweep of the clearest peak by each solver."""
    with pool() as workers:
        groups = workers.map(_readings, gaits(), chunksize=4)
        readings = list(itertools.chain.from_iterable(groups))
    best = max((row for row in readings if row.solver == "elastica"), key=lambda row: row.loss)
    columns = {name: ("reading", [getattr(row, name) for row in readings])
               for name in Reading._fields[:-1]}  # fmt: skip
    attributes = {"units": "1; sweeps over L", "best": best.gait, "best_gamma": best.gamma}
    data = xr.Dataset(columns, {"quantity": list(_QUANTITIES)}, attributes)
    for row in readings:
        if (row.gait, row.gamma) == (best.gait, best.gamma):
            data[f"sweep_{row.solver}"] = (f"pressure_{row.solver}", "quantity"), row.rows
    return data.set_coords(["gait", "gamma", "solver"])


def draw(data: xr.Dataset) -> Figure:
    """The figure of that data."""
    figure = Figure(figsize=(10, 4.3), layout="constrained")
    left, right = figure.subplots(1, 2)
    for solver, size, alpha in (("modes", 9, 0.35), ("elastica", 14, 0.8)):
        part = data.where(data["solver"] == solver, drop=True)
        left.scatter(part["ratio"].clip(-1.5, 1.5), part["loss"], s=size, color=COLOURS[solver],
                     alpha=alpha, linewidths=0,
                     label=f"{solver}, {part.sizes['reading']} readings")  # fmt: skip
        height, felt, polyethylene = data[f"sweep_{solver}"].values.T
        right.plot(height, felt, color=COLOURS[solver], label=f"felt, {solver}")
        right.plot(height, polyethylene, color=COLOURS[solver], dashes=(4, 2),
                   label=f"polyethylene, {solver}")  # fmt: skip
    left.fill_between([-_STILL, _STILL], _LOSS, 1.05, color="0.85", linewidth=0, zorder=0)
    left.text(0, 0.6, "the paper's\ncorner", ha="center", fontsize=8)
    left.set(xlabel="distance on polyethylene over that on felt, at 0.25",
             ylabel="part of the distance lost beyond the peak", xlim=(-1.6, 1.6),
             ylim=(-0.05, 1.05))  # fmt: skip
    left.legend(frameon=False, fontsize=7.5, loc="upper right")
    left.set_title("(a) no gait peaks and stands still", loc="left", fontsize=9)
    right.axhline(0, color="0.7", linewidth=0.8)
    right.set(xlabel="greatest height / L", ylabel="displacement per cycle / L")
    right.legend(frameon=False, fontsize=7.5)
    title = f"(b) {data.attrs['best']}, Γ = {data.attrs['best_gamma']:.3g}"
    right.set_title(title, loc="left", fontsize=9)
    return figure
