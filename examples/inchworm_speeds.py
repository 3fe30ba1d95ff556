"""Speeds of a soft inchworm on several materials, fitted by dimensionless groups.

    python examples/inchworm_speeds.py soft_inchworm_speeds.csv [--out folder] [--predict more.csv]

The file has columns pressure, frequency, speed, material, friction_coefficient (100 runs of Ali
Pahlevani, Soft_Inchworm_Robot on GitHub, kPa, Hz, mm/s). Its robot's geometry, weight and gait are
not known, so the groups are fitted: load Gamma, turn per pressure and length of the robot; for each
material a factor on its coefficient of friction, and the power of frequency that distance per cycle
goes with (0: quasi-static); for all materials together and one by one. Each has a prior, so that
one which the runs do not determine stays within reason. The reference walks quasi-statically by
Coulomb friction over a grid of groups, once; fits read that table. What is to be predicted is a
file of the same columns, speed left out; a material that was not fitted gets its priors.
"""

import argparse
import csv
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy import optimize, stats
from scipy.interpolate import RegularGridInterpolator

from analytic import GAITS, Friction, Robot, Surface, predict
from analytic.scene import pneunet
from analytic.solvers.models import Elastica

LOADS = np.geomspace(1.4, 16.0, 7)
TURNS = np.linspace(0.0, 6.0, 13)  # rad, of the whole strip
FRICTIONS = np.geomspace(0.05, 5.0, 8)
MIDDLE = 0.25  # Hz, at which distance per cycle is the quasi-static one
ROBOT = ("log Gamma", "log turn at 100 kPa", "log length [mm]")
PRIOR = np.array([np.log(5.0), np.log(1.5), np.log(80.0)]), np.array([1.0, 0.7, 1.0])
GROUND = ("log friction over measured", "power of frequency")  # one each a material
GROUND_PRIOR = np.array([0.0, 0.0]), np.array([0.7, 0.3])


class Runs(NamedTuple):
    """Rows of a file: pressure [kPa], frequency [Hz], speed [mm/s], material, friction."""

    pressure: np.ndarray
    frequency: np.ndarray
    speed: np.ndarray
    material: np.ndarray
    friction: np.ndarray

    def of(self, rows):
        return Runs(*(column[rows] for column in self))


class Fit(NamedTuple):
    """Result of a fit.

    Attributes:
        gait: the one with the least misfit.
        materials: in the order of `values`.
        values: ROBOT's, then GROUND's of each material.
        covariance: of the values.
        noise: standard deviation of a speed [mm/s].
        free: degrees of freedom of that.
    """

    gait: str
    materials: tuple[str, ...]
    values: np.ndarray
    covariance: np.ndarray
    noise: float
    free: int


def read(path):
    with open(path, newline="", encoding="utf-8-sig") as file:
        rows = list(csv.DictReader(file))
    number = {name: np.array([float(row.get(name) or "nan") for row in rows])
              for name in ("pressure", "frequency", "speed", "friction_coefficient")}  # fmt: skip
    return Runs(number["pressure"], number["frequency"], number["speed"],
                np.array([row["material"] for row in rows]),
                number["friction_coefficient"])  # fmt: skip


def distances(job):
    """Distances per cycle over L of one gait, load and friction, by turn."""
    gait, load, friction = job
    surface, shifts = Surface("any", friction=friction, tip_friction=friction), [0.0]
    for turn in TURNS[1:]:
        robot = Robot(peak_pressure=Robot().peak_pressure * turn / pneunet.turn_number(Robot()))
        walk = predict(pneunet.with_load(robot, load), GAITS[gait], surface, Elastica(24), 15,
                       Friction("coulomb", 1.0))  # fmt: skip
        far = -walk.locomotion.per_cycle / robot.length  # as the mirrored gait goes
        shifts.append(far if np.isfinite(far) else shifts[-1])  # past the end of the branch
    return shifts


def tables(gaits, workers=2):
    """An interpolator of distance per cycle over L in log load, turn, log friction, by gait."""
    jobs = [(gait, load, friction) for gait in gaits for load in LOADS for friction in FRICTIONS]
    with ProcessPoolExecutor(workers) as pool:
        shifts = np.array(list(pool.map(distances, jobs)))
    shape = (len(gaits), len(LOADS), len(FRICTIONS), len(TURNS))
    axes = np.log(LOADS), TURNS, np.log(FRICTIONS)
    return {
        gait: RegularGridInterpolator(axes, table.transpose(0, 2, 1), "linear", False, None)
        for gait, table in zip(gaits, shifts.reshape(shape), strict=True)
    }


def speeds(table, materials, values, runs):
    load, turn, length = values[: len(ROBOT)]
    which = [materials.index(name) for name in runs.material]
    factor, power = values[len(ROBOT) :].reshape(-1, len(GROUND))[which].T
    points = np.stack([np.full_like(factor, load), np.exp(turn) * runs.pressure / 100.0,
                       np.log(runs.friction) + factor], axis=1)  # fmt: skip
    far = table(np.clip(points, [g[0] for g in table.grid], [g[-1] for g in table.grid]))
    return np.exp(length) * far * runs.frequency * (runs.frequency / MIDDLE) ** power


def fit(table_by_gait, runs, materials=None):
    """The gait and the values most likely under normal noise and the priors.

    The noise is found by turns with the values. Loads from several starts: more than one may fit.
    """
    materials = tuple(np.unique(runs.material) if materials is None else materials)
    mean, spread = (np.r_[robot, np.tile(ground, len(materials))]
                    for robot, ground in zip(PRIOR, GROUND_PRIOR, strict=True))  # fmt: skip
    best = None
    for gait, table in table_by_gait.items():
        for load in (3.0, 5.0, 8.0):
            values, noise = np.r_[np.log(load), mean[1:]], np.std(runs.speed) / 2
            for _ in range(4):
                left = _left(table, materials, runs, noise, mean, spread)
                values = optimize.least_squares(left, values, x_scale=spread, diff_step=0.01).x
                off = speeds(table, materials, values, runs) - runs.speed
                noise = max(float(np.sqrt(off @ off / (len(off) - 1))), 1e-3 * np.std(runs.speed))
            likely = len(off) * np.log(noise) + 0.5 * np.sum(((values - mean) / spread) ** 2)
            if best is None or likely < best[0]:
                best = likely, gait, values, noise
    _, gait, values, noise = best
    table = table_by_gait[gait]
    off = speeds(table, materials, values, runs) - runs.speed
    slope = _slope(table, materials, values, runs)
    # what the priors tell is not taken from the degrees of freedom
    told = np.linalg.inv(slope.T @ slope / noise**2 + np.diag(spread**-2.0))
    free = max(1, round(len(off) - np.trace(told @ slope.T @ slope) / noise**2))
    noise *= np.sqrt(len(off) / free)
    covariance = np.linalg.inv(slope.T @ slope / noise**2 + np.diag(spread**-2.0))
    return Fit(gait, materials, values, covariance, noise, free)


def _left(table, materials, runs, noise, mean, spread):
    return lambda values: np.r_[(speeds(table, materials, values, runs) - runs.speed) / noise,
                                (values - mean) / spread]  # fmt: skip


def _slope(table, materials, values, runs):
    return optimize.approx_fprime(values, lambda v: speeds(table, materials, v, runs), 0.02)


def predictions(table_by_gait, fitted, runs):
    """Speeds and the half-widths of their 95 % intervals [mm/s]."""
    table = table_by_gait[fitted.gait]
    slope = _slope(table, fitted.materials, fitted.values, runs)
    spread = np.sqrt(fitted.noise**2 + np.einsum("ij,jk,ik->i", slope, fitted.covariance, slope))
    value = speeds(table, fitted.materials, fitted.values, runs)
    return value, stats.t.ppf(0.975, fitted.free) * spread


def held_out(table_by_gait, runs, column):
    """Predictions of each run by a fit to all runs with other values of a column."""
    value, wide = np.empty(len(runs.speed)), np.empty(len(runs.speed))
    for one in np.unique(getattr(runs, column)):
        here = getattr(runs, column) == one
        fitted = fit(table_by_gait, runs.of(~here), np.unique(runs.material))
        value[here], wide[here] = predictions(table_by_gait, fitted, runs.of(here))
    return value, wide


def rms(left):
    return float(np.sqrt(np.mean(np.square(left))))


def report(name, table_by_gait, runs, materials=None):
    fitted = fit(table_by_gait, runs, materials)
    print(f"{name}: {len(runs.speed)} runs of spread {np.std(runs.speed):.2f} mm/s, "
          f"gait {fitted.gait}, misfit {fitted.noise:.2f} mm/s")  # fmt: skip
    labels = [*ROBOT, *(f"{of}, {label}" for of in fitted.materials for label in GROUND)]
    wide = 1.96 * np.sqrt(np.diag(fitted.covariance))
    for label, value, half in zip(labels, fitted.values, wide, strict=True):
        low, high = value - half, value + half
        if label.startswith("log ") or ", log " in label:
            label, value, low, high = label.replace("log ", ""), *np.exp([value, low, high])
        print(f"    {label:<36}{value:9.3g}   ({low:.3g} .. {high:.3g})")
    return fitted


def draw(path, table_by_gait, together, apart, runs):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 3.2), layout="constrained")
    names = sorted(apart, key=lambda name: runs.friction[runs.material == name][0])
    fine = np.linspace(0.1, 0.42, 40)
    for axes, name in zip(figure.subplots(1, len(names), sharey=True), names, strict=True):
        here = runs.of(runs.material == name)
        for number, pressure in enumerate(np.unique(runs.pressure)):
            rows = here.pressure == pressure
            axes.plot(here.frequency[rows], here.speed[rows], "o", ms=4, color=f"C{number}",
                      label=f"{pressure:.0f} kPa")  # fmt: skip
            line = Runs(np.full(40, pressure), fine, fine, np.full(40, name),
                        np.full(40, here.friction[0]))  # fmt: skip
            for fitted, style in ((together, "-"), (apart[name], ":")):
                far = speeds(table_by_gait[fitted.gait], fitted.materials, fitted.values, line)
                axes.plot(fine, far, style, lw=1.2, color=f"C{number}")
        axes.set_title(f"{name}, mu = {here.friction[0]:g}")
        axes.set_xlabel("frequency [Hz]")
    figure.axes[0].set_ylabel("speed [mm/s]")
    figure.axes[-1].text(0.03, 0.97, "full: all materials together\ndotted: this one alone",
                         transform=figure.axes[-1].transAxes, va="top", fontsize=8)  # fmt: skip
    figure.axes[0].legend(fontsize=8)
    figure.savefig(path, dpi=100)


def main(argv=None, gaits=("wave", "full-wave", "pulse")):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=Path)
    parser.add_argument("--out", type=Path, default=Path("fitted"))
    parser.add_argument("--predict", type=Path)
    options = parser.parse_args(argv)
    runs = read(options.file)
    more = read(options.predict) if options.predict else None
    names = np.unique(runs.material)
    every = names if more is None else np.unique([*names, *more.material])
    table_by_gait = tables(gaits)
    together = report("all materials", table_by_gait, runs, every)
    apart = {name: report(name, table_by_gait, runs.of(runs.material == name)) for name in names}
    off = 0.0
    for column in ("frequency", "pressure"):
        value, wide = held_out(table_by_gait, runs, column)
        off = max(off, rms(value - runs.speed))
        print(f"one {column} after the other left out and predicted: "
              f"{rms(value - runs.speed):.2f} mm/s off, "
              f"{np.mean(np.abs(value - runs.speed) <= wide):.0%} within their 95 % intervals"
              )  # fmt: skip
    # between pressures the model's own error counts, which is more than the noise
    trusted = together._replace(noise=max(together.noise, off))
    options.out.mkdir(parents=True, exist_ok=True)
    draw(options.out / "inchworm.png", table_by_gait, together, apart, runs)
    if more is not None:
        for row in zip(more.material, more.pressure, more.frequency,
                       *predictions(table_by_gait, trusted, more), strict=True):  # fmt: skip
            print("{}, {:g} kPa, {:g} Hz: {:+.2f} ± {:.2f} mm/s".format(*row))
    return together


if __name__ == "__main__":
    main()
