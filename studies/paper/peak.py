"""Which readings of the lost Figure 3 peak at an amplitude of a quarter, or stand still there."""

import itertools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import NDArray

from analytic import SURFACES, Gait, Robot, predict
from analytic.scene import pneunet
from analytic.scene.trapezoid import trapezoid
from studies import workers
from studies.paper.style import SOLVER

Array = NDArray[np.float64]

NAME = "peak"
CAPTION = """\
The peak of Figure 5 looked for: the gaits of lag, duty and ramp of analytic.scene.trapezoid and all
sequences of up to six stages in which each segment inflates once, from left to right, on robots of
Gamma 1 to 40, by the modes with fine increments; those with a peak, a plateau or a standstill on
polyethylene again by elastica. (a) How much of the distance on felt is lost beyond a peak at an
amplitude between 0.2 and 0.3 (0: it rises on or stays) against the distance on polyethylene over
that on felt at 0.25. The corner that the paper describes, a peak there and a standstill on
polyethylene, is shaded. (b) The gait with the clearest peak by elastica: distance on felt and on
polyethylene.
Agrees with the paper: gaits exist whose distance peaks at a quarter, and some of them keep their
peak in exact contact. Differs: none of them stands still on polyethylene; there they go as far back
as felt takes them forth. Those that stand still rise on, or stay, like the default gait. So no
reading of Figure 3 among these gives both statements with increments fine enough to converge, and
the default gait is kept for the standstill.
"""

_LAGS = (1 / 8, 1 / 6, 1 / 5, 1 / 4, 0.3, 1 / 3, 0.4, 0.5)
_DUTIES = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7)
_RAMPS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5)
_GAMMAS = (1, 2, 4, 6, 8.1, 12, 16, 24, 32, 40)
_PRESSURES = np.linspace(2e3, 90e3, 45)
_MOST_STAGES = 6
_STATES, _REFINEMENT = 12, 16  # in a ramp
_HIGHEST = 0.45  # amplitude over L up to which it is looked at
_AT, _FROM, _TO = 0.25, 0.2, 0.3  # amplitude over L of the paper's peak, and what counts as such
_LEAST = 0.005  # of the length: who goes less has no peak
_LOSS, _STILL = 0.1, 0.1  # of the distance on felt: a peak loses more; a standstill goes less


class Reading(NamedTuple):
    """What one gait does on one robot as the pressure rises.

    Attributes:
        loss: part of the greatest distance on felt that is lost beyond a peak at about a quarter;
            0 without such a peak.
        ratio: distance on polyethylene over that on felt, at an amplitude of a quarter.
        plateau: whether the distance stays within a tenth of its greatest from there on.
    """

    loss: float
    ratio: float
    plateau: bool


def stage_gaits() -> Iterator[Gait]:
    """Sequences of stages in which each segment inflates once, the left ones first."""
    seen = set()
    for count in range(2, _MOST_STAGES + 1):
        for start in itertools.product(range(count), repeat=3):
            for end in itertools.product(range(1, count + 1), repeat=3):
                if sorted(start) != list(start) or start[0] or max(end) != count:
                    continue
                if any(b <= a for a, b in zip(start, end, strict=True)):
                    continue
                words = [tuple(float(a <= k < b) for a, b in zip(start, end, strict=True))
                         for k in range(count)]  # fmt: skip
                rest = (0.0, 0.0, 0.0)
                stages = (rest, *words, rest)
                if all(a != b for a, b in itertools.pairwise(stages)) and stages not in seen:
                    seen.add(stages)
                    yield Gait("stages-" + "-".join("".join(f"{v:.0f}" for v in w) for w in words),
                               stages)  # fmt: skip


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
        walks = [predict(robot, gait, SURFACES[name], solver, _STATES, _REFINEMENT)
                 for name in ("felt", "polyethylene")]  # fmt: skip
        height = float(walks[0].shapes.amplitude.max()) / robot.length
        rows.append([height, *(walk.locomotion.per_cycle / robot.length for walk in walks)])
        if not np.isfinite(rows[-1]).all() or height > _HIGHEST:
            rows.pop()
            break
    return np.array(rows).reshape(-1, 3)


def read(rows: Array) -> Reading | None:
    """What is to be seen of a sweep; None if the robot hardly goes or never rises so high."""
    if len(rows) < 5 or rows[-1, 0] < _TO:
        return None
    height, felt, other = rows.T
    far = np.abs(felt)
    best, at = int(np.argmax(far)), int(np.argmin(np.abs(height - _AT)))
    if far[best] < _LEAST or far[at] < _LEAST:
        return None
    peak = _FROM <= height[best] <= _TO
    loss = 1 - far[best:].min() / far[best] if peak else 0.0
    first = int(np.argmax(far >= 0.9 * far[best]))
    plateau = height[first] <= _TO - 0.02 and bool((far[first:] >= 0.9 * far[best]).all())
    return Reading(float(loss), float(other[at] / far[at]), plateau and loss < _LOSS)


def _tried(gait: Gait) -> list[tuple[str, float, str, Reading, Array]]:
    """Readings by the modes, and by elastica where they say anything."""
    found = []
    for gamma in _GAMMAS:
        rows = sweep(gait, gamma, "modes", _PRESSURES)
        reading = read(rows)
        if reading is None:
            continue
        found.append((gait.name, gamma, "modes", reading, rows))
        if reading.loss > _LOSS or reading.plateau or abs(reading.ratio) < _STILL:
            exact = sweep(gait, gamma, "elastica", _PRESSURES[: len(rows) + 2 : 2])
            reading = read(exact)
            if reading is not None:
                found.append((gait.name, gamma, "elastica", reading, exact))
    return found


def make() -> xr.Dataset:
    """Every reading, and the sweep of the clearest peak by each solver."""
    with workers.pool() as pool:
        found = [row for rows in pool.map(_tried, gaits(), chunksize=4) for row in rows]
    exact = [row for row in found if row[2] == "elastica"]
    best = max(exact, key=lambda row: row[3].loss)
    data = xr.Dataset(
        {name: ("reading", [getattr(row[3], name) for row in found]) for name in Reading._fields},
        coords={"gait": ("reading", [row[0] for row in found]),
                "gamma": ("reading", [row[1] for row in found]),
                "solver": ("reading", [row[2] for row in found])},
        attrs={"units": "1; sweeps over L", "best": best[0], "best_gamma": best[1]},
    )  # fmt: skip
    for row in found:
        if row[:2] == best[:2]:
            data[f"sweep_{row[2]}"] = (f"pressure_{row[2]}", "quantity"), row[4]
    return data.assign_coords(quantity=["height", "felt", "polyethylene"])


def draw(data: xr.Dataset) -> Figure:
    """The figure of that data."""
    figure = Figure(figsize=(10, 4.3), layout="constrained")
    left, right = figure.subplots(1, 2)
    for solver, size in (("modes", 9), ("elastica", 14)):
        part = data.where(data["solver"] == solver, drop=True)
        left.scatter(part["ratio"].clip(-1.5, 1.5), part["loss"], s=size, color=SOLVER[solver],
                     alpha=0.35 if solver == "modes" else 0.8, linewidths=0,
                     label=f"{solver}, {part.sizes['reading']} readings")  # fmt: skip
    left.fill_between([-_STILL, _STILL], _LOSS, 1.05, color="0.85", linewidth=0, zorder=0)
    left.text(0, 0.6, "the paper's\ncorner", ha="center", fontsize=8)
    left.set(
        xlabel="distance on polyethylene over that on felt, at 0.25",
        ylabel="part of the distance lost beyond the peak",
        xlim=(-1.6, 1.6),
        ylim=(-0.05, 1.05),
    )
    left.legend(frameon=False, fontsize=7.5, loc="upper right")
    left.set_title("(a) no gait peaks and stands still", loc="left", fontsize=9)
    for solver in ("modes", "elastica"):
        height, felt, other = data[f"sweep_{solver}"].values.T
        right.plot(height, felt, color=SOLVER[solver], label=f"felt, {solver}")
        right.plot(
            height, other, color=SOLVER[solver], dashes=(4, 2), label=f"polyethylene, {solver}"
        )
    right.axhline(0, color="0.7", linewidth=0.8)
    right.set(xlabel="greatest height / L", ylabel="displacement per cycle / L")
    right.legend(frameon=False, fontsize=7.5)
    right.set_title(
        f"(b) {data.attrs['best']}, Γ = {data.attrs['best_gamma']:.3g}", loc="left", fontsize=9
    )
    return figure
