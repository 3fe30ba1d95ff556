"""Tests on random scenes of what stands beside a distance: `make promises`.

    python benchmarks/promises.py [count]

Scenes of benchmarks/reach.py, ramps of 0.2 to 4 s. Inertia: the distance that its note gives
against that of ramps as many times as slow, and the part that no anchor rule explains against what
they change; where the note speaks. Error bar: that of the reference against one
with twice the links and states. What was measured is kept in build/.
"""

import math
import sys
from dataclasses import replace

import numpy as np
from auto import measured
from reach import draw

from mjsim.results.measures import measure
from mjsim.results.record import record, reference
from mjsim.scene import Numerics, Scene
from mjsim.simulation.second_walks import SLOWER, doubts
from mjsim.simulation.simulation import simulate

COUNT, FIRST = 60, 300_000
FACTOR, PART, FEW = 2.0, 0.05, 1e-3  # of what is compared, relatively and over L


def scene_of(seed: int, slower: float = 1.0) -> tuple[Scene, Numerics, float]:
    rng = np.random.default_rng([78, seed])
    scene, _ = draw(FIRST + seed)
    ramp = float(np.exp(rng.uniform(np.log(0.2), np.log(4.0))))
    scene = replace(scene, friction="constant", gait=replace(scene.gait, ramp_time=slower * ramp))
    links = (16 if scene.between else 12) * len(scene.robot.segments)
    return scene, Numerics(links=links, timestep=0.002 * math.sqrt(slower)), ramp


def slow_row(seed: int) -> list[list]:
    """Seed, displacement at ramps that are slower."""
    scene, numerics, _ = scene_of(seed, SLOWER)
    numbers = measure(simulate(scene, numerics))
    return [[seed, numbers.displacement if numbers else math.nan]]


def row(seed: int) -> list[list]:
    """Seed, ramp, contacts, status, displacement, prediction, its bar, finer, unexplained."""
    scene, numerics, ramp = scene_of(seed)
    walk = simulate(scene, numerics)
    fields = record(walk)
    names = ("displacement_over_L", "predicted_displacement_over_L",
             "prediction_uncertainty_over_L", "unexplained_over_L", "prediction_notes")  # fmt: skip
    fields["prediction_notes"] += doubts(walk, fields)
    moved, predicted, bar, unexplained, notes = (fields[name] for name in names)
    finer = math.nan
    if predicted is not None:
        finer = float(reference(walk, 2).displacement[0])
    return [[seed, ramp, "all" if scene.between else "ends", fields["status"], moved, predicted,
             bar, finer, unexplained, notes]]  # fmt: skip


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
    walked = [r for r in sure if r[4] is not None]
    said = {
        r[0]: float(note.split()[1])
        for r in walked for note in r[9] if note.startswith("inertia") and " L " in note
    }  # fmt: skip
    noticed = [r for r in walked if r[0] in said]
    slow = dict(measured(slow_row, "promises-slow", count, set(said)))
    print(f"{len(walked)} walk, {len(noticed)} with a word of inertia")
    right = [abs(said[i] - slow[i]) <= max(PART * abs(slow[i]), FEW) for i in said]
    print(f"the note's distance is that of {SLOWER:g} times slower ramps within {PART:.0%} or "
          f"{FEW:g} L in {sum(right)} of {len(right)}")  # fmt: skip
    parts = [abs(r[8] / (r[4] - slow[r[0]])) for r in noticed]
    near = [1 / FACTOR < part < FACTOR for part in parts]
    print(f"unexplained is within a factor of {FACTOR:g} of what {SLOWER:g} times slower ramps "
          f"change in {sum(near)} of {len(near)}")  # fmt: skip
    for r in noticed:
        print(
            f"  scene {r[0]}, {r[2]}: ramp {r[1]:.2f} s, {r[4]:+.4f}, reference {r[5]:+.4f}, "
            f"said {said[r[0]]:+.4f}, slow {slow[r[0]]:+.4f}, unexplained {r[8]:+.4f}"
        )


if __name__ == "__main__":
    main()
