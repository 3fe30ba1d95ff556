"""Fast gaits: whether distances that stand without a word are the converged ones.

    python benchmarks/fast_gaits.py [count]

Random gaits of 0.05 to 2 s a ramp, from fixed seeds: of strips, and every third of limbs. Each is
walked as `undulator run` does and told of in the same words; then with one and a half times and
twice the links at a third and a quarter of the time step. It counts as converged where these two
agree. Rows are added to fast_gaits.csv beside this file as they come, and those there are kept.
"""

import csv
import math
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from analytic import Gait, Robot, Surface
from analytic.scene.limbs import as_strip, quadruped
from mjsim.files.files import whole
from mjsim.results.measures import measure
from mjsim.results.record import record
from mjsim.results.status import Status
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Scene
from mjsim.simulation.second_walks import doubts
from mjsim.simulation.simulation import simulate

ROWS = Path(__file__).with_name("fast_gaits.csv")
COUNT = 60
PART, FEW = 0.05, 0.003  # that a distance may be off by, relatively and over L
OF_NUMERICS = ("links", "time step", "limbs sink", *(str(status) for status in Status))


class Row(NamedTuple):
    """A scene: distances per cycle over L, NaN of walks that failed, and words on numerics."""

    seed: int
    robot: str
    ramp: float
    timestep: float
    status: str
    distance: float
    finer: float
    finest: float
    words: str

    @property
    def converged(self) -> bool:
        """Tell whether the two finest walks agree within half of what a distance may be off by."""
        return near(self.finer, self.finest, 0.5)

    @property
    def right(self) -> bool:
        return near(self.distance, self.finest, 1.0)


def near(distance: float, finest: float, part: float) -> bool:
    return abs(distance - finest) <= part * max(PART * abs(finest), FEW)


def scene_of(seed: int) -> Scene:
    """A random fast gait of a strip, or of a quadruped or a tree that is a strip."""
    rng = np.random.default_rng([32, seed])
    peak = float(rng.uniform(0.5, 1.2)) * Robot().peak_pressure
    strip = Robot(weight_per_length=float(rng.uniform(0.7, 2.0)), peak_pressure=peak)
    robot = strip if seed % 3 else as_strip(strip) if seed % 2 else quadruped(strip)
    if not seed % 3:
        robot = replace(robot, peak_pressure=peak)
    chambers, count = len(robot.chambers), int(rng.integers(2, 7))
    middle = [
        rng.choice([0.0, 1.0], (count, chambers)),
        rng.uniform(0, 1, (count, chambers)),
        rng.uniform(0, 1, (count, chambers)) * (rng.random((count, chambers)) < 0.6),
    ][rng.integers(3)].round(2)
    rest = (0.0,) * chambers
    ramp = float(np.exp(rng.uniform(math.log(0.05), math.log(2.0))))
    gait = Gait("any", (rest, *map(tuple, middle.tolist()), rest), ramp)
    tip = 0.034 * float(rng.choice([0.5, 1.0, 3.0]))
    side = 19.6 * float(rng.choice([0.0, 0.5, 1.0, 2.0]))
    return Scene(robot, gait, Surface("any", tip_force=tip, shear_strength=side))


def distance(walk: Trajectory) -> float:
    measures = measure(walk)
    return measures.displacement if measures else math.nan


def row_of(seed: int) -> Row:
    scene = scene_of(seed)
    walk = simulate(scene)
    row = record(walk)
    notes = [*row["prediction_notes"], *doubts(walk, row)]
    words = [note for note in notes if note.startswith(OF_NUMERICS)]
    usual, fine = walk.numerics, []
    for links, part in ((1.5, 3), (2, 4)):
        count = 2 * round(links * usual.links / 2)
        numerics = replace(usual, links=count, timestep=usual.timestep / part)
        fine.append(distance(simulate(scene, numerics)))
    kind = "strip" if not scene.in_space else "tree" if seed % 2 else "quadruped"
    return Row(seed, kind, round(scene.gait.ramp_times[0], 4), usual.timestep, str(walk.status),
               *(round(d, 5) for d in (distance(walk), *fine)), "; ".join(words))  # fmt: skip


def read() -> list[Row]:
    if not ROWS.is_file():
        return []
    with ROWS.open(newline="", encoding="utf-8") as file:
        return [
            Row(int(row["seed"]), row["robot"], float(row["ramp"]), float(row["timestep"]),
                row["status"], *(float(row[name]) for name in ("distance", "finer", "finest")),
                row["words"])
            for row in csv.DictReader(file)
        ]  # fmt: skip


def write(rows: list[Row]) -> None:
    with whole(ROWS) as part, part.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([Row._fields, *sorted(rows)])


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else COUNT
    rows = read()
    todo = set(range(count)) - {row.seed for row in rows}
    with ProcessPoolExecutor(2) as pool:
        for work in as_completed([pool.submit(row_of, seed) for seed in sorted(todo)]):
            rows.append(work.result())
            write(rows)
    walked = [row for row in rows if row.status == "ok"]
    converged = [row for row in walked if row.converged]
    silent = [row for row in walked if not row.words and not row.right]
    print(f"{len(walked)} of {len(rows)} walk, {len(converged)} of them converged")
    print(f"silent and off: {len(silent)}, of them converged "
          f"{sum(row.converged for row in silent)}")  # fmt: skip
    print(f"converged, and with a word on numerics: {sum(bool(row.words) for row in converged)}")
    for row in silent:
        print("  ", *row)


if __name__ == "__main__":
    main()
