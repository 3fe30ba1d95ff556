"""Whether what stands beside a distance holds on random scenes: `make promises`.

    python benchmarks/promises.py [count]

Scenes of benchmarks/reach.py, ramps of 0.2 to 4 s. Inertia: the part that no anchor rule explains
against how far MuJoCo is from the quasi-static reference, where that is more than 0.001 L. Error
bar: that of the reference against one with twice the links and states. What was measured is kept
in build/.
"""

import math
import sys
from dataclasses import replace

import numpy as np
from auto import measured
from reach import draw

from mjsim.report import record, reference
from mjsim.scene import Numerics
from mjsim.simulation.simulation import simulate

COUNT, FIRST = 60, 300_000
NOTICED = 1e-3  # of the length
FACTOR = 2.0


def row(seed: int) -> list[list]:
    """Seed, ramp, contacts, status, displacement, prediction, its bar, finer, unexplained."""
    rng = np.random.default_rng([78, seed])
    scene, _ = draw(FIRST + seed)
    ramp = float(np.exp(rng.uniform(np.log(0.2), np.log(4.0))))
    scene = replace(scene, friction="constant", gait=replace(scene.gait, ramp_time=ramp))
    links = (16 if scene.between else 12) * len(scene.robot.segments)
    walk = simulate(scene, Numerics(links=links, timestep=0.002))
    found = record(walk)
    names = ("displacement_over_L", "predicted_displacement_over_L",
             "prediction_uncertainty_over_L", "unexplained_over_L", "prediction_notes")  # fmt: skip
    moved, predicted, bar, unexplained, notes = (found[name] for name in names)
    finer = math.nan
    if predicted is not None:
        finer = reference(walk, 2).locomotion.per_cycle / scene.robot.length
    return [[seed, ramp, "all" if scene.between else "ends", found["status"], moved, predicted, bar,
             finer, unexplained, notes]]  # fmt: skip


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else COUNT
    rows = sorted(measured(row, "promises", count))
    sure = [r for r in rows if r[5] is not None]
    ended = [r for r in sure if not math.isnan(r[7])]
    held = [abs(r[7] - r[5]) <= r[6] for r in ended]
    print(
        f"error bar of the reference holds in {sum(held)} of {len(held)}; for "
        f"{len(rows) - len(sure)} there is none, for {len(sure) - len(ended)} not by the finer"
    )
    for r, ok in zip(ended, held, strict=True):
        if not ok:
            print(f"  scene {r[0]}: {r[5]:+.4f} ± {r[6]:.4f}, finer {r[7]:+.4f}")
    for contacts in ("ends", "all"):
        walked = [r for r in sure if r[4] is not None and r[2] == contacts]
        off = np.array([r[4] - r[5] for r in walked])
        told = np.array([r[8] for r in walked])
        big = np.maximum(np.abs(off), np.abs(told)) > NOTICED
        part = np.abs(told[big]) / np.abs(off[big])
        near = (part > 1 / FACTOR) & (part < FACTOR)
        print(f"friction {contacts}: {len(walked)} walk, {big.sum()} with inertia beyond {NOTICED} "
              f"L; what is said of it is within a factor {FACTOR:g} in {near.sum()}")  # fmt: skip
        for r, ok in zip([r for r, b in zip(walked, big, strict=True) if b], near, strict=True):
            if not ok:
                print(f"  scene {r[0]}: ramp {r[1]:.2f} s, error {r[4] - r[5]:+.4f}, unexplained "
                      f"{r[8]:+.4f}, {r[9]}")  # fmt: skip


if __name__ == "__main__":
    main()
