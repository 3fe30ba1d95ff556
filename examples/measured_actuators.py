"""A robot whose three actuators were measured, each on a bench, and walks by what was found.

The logs are made here: pressures that rise and fall, angles with 0.4 degrees of noise and 1.5
degrees of tilt of the camera, of actuators that soften, lag behind rising pressures, and differ by
up to 14 %. The fit gives each segment its curve and hysteresis; the robot then walks by them in
theory and in MuJoCo, beside one by the affine law through the same highest points.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from analytic import Robot
from mjsim import Scene, build, measure, read_tables, simulate
from mjsim.commands import fit
from mjsim.results.prediction import reference

SCALES = {"left": 1.0, "middle": 1.08, "right": 0.94}
HIGHEST = 50.0  # kPa


def log(path, scale, seed):
    """Write what a bench sees of an actuator: 70 p - 15 p^2 degrees and a play."""
    rng = np.random.default_rng(seed)
    corners = HIGHEST * np.array([0.0, 1.0, 0.3, 0.7, 0.0])
    pressure = np.interp(np.linspace(0, 4, 400), np.arange(5), corners)
    state, acting = 0.0, []
    for p in pressure:
        state = min(max(state, p - 6.0), p)
        acting.append(0.75 * p + 0.25 * state)
    x = np.array(acting) / HIGHEST
    angle = scale * (70 * x - 15 * x**2) + rng.normal(0, 0.4, len(x)) + 1.5
    rows = np.stack([0.5 * np.arange(len(x)), pressure, angle], axis=1)
    np.savetxt(path, rows, "%.3f", ",", header="time [s],pressure [kPa],angle [deg]", comments="")


def main(folder=None):
    """Fit, walk, and return the distance over the length by way of finding it."""
    with TemporaryDirectory() as temporary:
        out = Path(folder or temporary)
        out.mkdir(parents=True, exist_ok=True)
        files = [out / f"{name}.csv" for name in SCALES]
        for seed, (file, scale) in enumerate(zip(files, SCALES.values(), strict=True)):
            log(file, scale, seed)
        words = ["--free", "robot.actuator", "--by-chamber", "--zero", "angle"]
        fit.main([*map(str, files), *words, "--surface", "gelatin", "--out", str(out)])
        scene, numerics = build(read_tables(out / "fit.toml"))
    highest = [curve.curvature_at(scene.robot.peak_pressure) for curve in scene.robot.actuators]
    affine = Robot(curvature_per_pressure=float(np.mean(highest)) / scene.robot.peak_pressure)
    distances = {
        "MuJoCo": measure(simulate(scene, numerics)).displacement,
        "theory": float(reference(scene).displacement[0]),
        "affine law, theory": float(reference(Scene(affine, ground="gelatin")).displacement[0]),
    }
    for way, distance in distances.items():
        print(f"{way:20} {distance:+.4f} L")
    return distances


if __name__ == "__main__":
    main(*sys.argv[1:])
