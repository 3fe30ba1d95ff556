"""Many scenes on all cores; one that cannot be is a row with its message."""

from dataclasses import replace

import numpy as np

from mjsim import Numerics, Robot, Scene, Trajectory, measure, simulate_all


def main() -> list[float]:
    pressures = np.linspace(20e3, 60e3, 5)
    scenes = [Scene(replace(Robot(), peak_pressure=float(p))) for p in pressures]
    shifts = []
    walks = simulate_all(scenes, Numerics(links=12, timestep=0.01))
    for pressure, walk in zip(pressures, walks, strict=True):
        numbers = measure(walk) if isinstance(walk, Trajectory) else None
        shifts.append(numbers.displacement if numbers else float("nan"))
        print(f"{1e-3 * pressure:4.0f} kPa  {shifts[-1]:+.4f} L")
    return shifts


if __name__ == "__main__":
    main()
