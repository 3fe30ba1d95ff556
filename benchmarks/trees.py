"""Random trees of limbs: MuJoCo by default against finer MuJoCo and against a finer reference.

    python benchmarks/trees.py [count] [processes]

Trees of 2 to 8 limbs, with angles, lengths, widths, weights, gaits, both friction laws and four
grounds at random, each a function of its seed alone: by default numerics; by half and a quarter of
the step and twice the links; by the reference of the walk, of its error bar, and with twice the
links and states. Rows are added to trees.csv beside this file as they come, and those there are
kept. Prints how many agree within 5 % or 0.003 L and within 5 % or 0.3 degrees, a walk or a
reference that fails being a miss, and how many error bars cover.
"""

import csv
import sys
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import NamedTuple

import numpy as np

from analytic.scene.gait import Gait
from analytic.scene.limbs import Limb, LimbedRobot
from analytic.scene.robot import Robot
from analytic.scene.surface import FRICTION, SHEAR_STRENGTH, SURFACES, TIP_FORCE, Surface
from mjsim.files.files import whole
from mjsim.results.measures import measure
from mjsim.results.prediction import HALF, Reference, error_bars, reference
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import simulate

ROWS = Path(__file__).with_name("trees.csv")
COUNT = 60
MIXED = Surface("mixed", 0.7 * TIP_FORCE, 0.5 * SHEAR_STRENGTH, 0.5 * FRICTION, 0.7 * FRICTION)
GROUNDS = (*SURFACES.values(), MIXED)
WITHIN, WITHIN_LENGTH, WITHIN_TURN = 0.05, 0.003, 0.3  # relative, L, degrees
RAMP = 4.0  # s

Array = np.ndarray
MOVES = ("walk", "half", "quarter", "theory", "coarse", "fine")
PARTS = ("ahead", "aside", "turn")


class Row(NamedTuple):
    """A tree; moves are ahead and aside over L and a turn in degrees, (3,), NaN of what failed."""

    seed: int
    limbs: int
    ground: str
    friction: str
    walk: Array
    half: Array
    quarter: Array
    theory: Array
    coarse: Array
    fine: Array
    bar: float
    turn_bar: float
    flags: str
    seconds: float


def draw(seed: int) -> Scene:
    """A random tree and its gait."""
    rng = np.random.default_rng(seed)

    def strip(short: float, width: tuple[float, float]) -> Robot:
        return Robot(length=float(rng.uniform(short, 0.06)), width=float(rng.uniform(*width)),
                     weight_per_length=float(rng.uniform(0.5, 2.0)), segments=(1.0,))  # fmt: skip

    limbs = [Limb("trunk", strip(0.04, (0.02, 0.035)))]
    for number in range(int(rng.integers(1, 8))):
        longer = number and rng.random() < 0.25  # a limb that goes on from another
        on = str(rng.choice([limb.name for limb in limbs[1:]])) if longer else "trunk"
        carrier = next(limb for limb in limbs if limb.name == on)
        at = "end" if longer or rng.random() < 0.5 else "begin"
        turn = rng.uniform(-30, 30) if longer else rng.uniform(-80, 80) + 180 * (at == "begin")
        limbs.append(Limb(f"limb-{number}", strip(0.03, (0.012, 0.018)), on, at,
                          carrier.angle + float(np.radians(turn))))  # fmt: skip
    count = len(limbs)
    rows = np.round(rng.uniform(0.4, 1, (3, count)) * (rng.random((3, count)) < 0.6), 2)
    stages = ((0.0,) * count, *map(tuple, rows.tolist()), (0.0,) * count)
    law = "coulomb" if rng.random() < 0.5 else "constant"
    ground = GROUNDS[int(rng.integers(3 if law == "constant" else 4))]
    if law == "constant" and rng.random() < 0.25:
        ground = MIXED
    return Scene(LimbedRobot(tuple(limbs)), Gait("random", stages, RAMP), ground, friction=law)


def walked(scene: Scene, numerics: Numerics) -> Array:
    """Move of a walk in MuJoCo, (3,); NaN if it failed."""
    numbers = measure(simulate(scene, numerics))
    if numbers is None:
        return np.full(3, np.nan)
    return np.array([numbers.displacement, numbers.aside, np.degrees(numbers.turn)])


def predicted(theory: Reference) -> Array:
    """Move by a reference, (3,)."""
    return np.array([*theory.displacement, np.degrees(theory.turn)])


def row_of(seed: int) -> Row:
    scene, begin = draw(seed), time.process_time()
    usual = resolved(scene)
    walks = [walked(scene, Numerics())] + [
        walked(scene, Numerics(links=2 * usual.links, timestep=usual.timestep / part))
        for part in (2, 4)
    ]
    theory, coarse, fine = (reference(scene, finer=finer) for finer in (1, HALF, 2))
    bar, turn_bar = error_bars(scene, theory, coarse)
    flags = [f"{flag} {name}" for name, each in (("theory", theory), ("fine", fine))
             for flag in each.flags]  # fmt: skip
    return Row(seed, len(scene.robot.limbs), scene.ground.name, scene.friction, *walks,
               *map(predicted, (theory, coarse, fine)), np.nan if bar is None else bar,
               float(np.degrees(turn_bar)), "; ".join(flags), time.process_time() - begin)  # fmt: skip


def off(one: Array, other: Array) -> tuple[float, float]:
    """How far apart two moves are, over L and in degrees."""
    return float(np.hypot(*(one - other)[:2])), float(abs(one[2] - other[2]))


def agrees(one: Array, other: Array) -> bool:
    """Tell whether both displacement and turn do, by the size of the other."""
    apart, turned = off(one, other)
    far = float(np.hypot(*other[:2]))
    near = apart <= max(WITHIN * far, WITHIN_LENGTH)
    return near and turned <= max(WITHIN * float(abs(other[2])), WITHIN_TURN)


def covers(row: Row) -> bool:
    apart, turned = off(row.theory, row.fine)
    return apart <= row.bar and turned <= row.turn_bar


CLAIMS: dict[str, Callable[[Row], bool]] = {
    "MuJoCo as by twice the links and a quarter of the step": lambda r: agrees(r.walk, r.quarter),
    "MuJoCo as the reference by twice the links and states": lambda r: agrees(r.walk, r.fine),
    "reference as by twice the links and states": lambda r: agrees(r.theory, r.fine),
    "finest MuJoCo as the finest reference": lambda r: agrees(r.quarter, r.fine),
    "error bar of the reference covers": covers,
}


def read() -> list[Row]:
    if not ROWS.is_file():
        return []
    with ROWS.open(newline="", encoding="utf-8") as file:
        return [
            Row(int(row["seed"]), int(row["limbs"]), row["ground"], row["friction"],
                *(np.array([float(row[f"{name}_{part}"]) for part in PARTS]) for name in MOVES),
                float(row["bar"]), float(row["turn_bar"]), row["flags"], float(row["seconds"]))
            for row in csv.DictReader(file)
        ]  # fmt: skip


def write(rows: list[Row]) -> None:
    names = [name for field in Row._fields
             for name in ([f"{field}_{part}" for part in PARTS] if field in MOVES else [field])]  # fmt: skip
    with whole(ROWS) as part, part.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(names)
        for row in sorted(rows, key=lambda row: row.seed):
            flat = [value for cell in row for value in (cell if isinstance(cell, Array) else [cell])]
            table.writerow([f"{cell:.6g}" if isinstance(cell, float) else cell for cell in flat])


def main() -> None:
    count = int(sys.argv[1]) if sys.argv[1:] else COUNT
    rows = read()
    todo = set(range(count)) - {row.seed for row in rows}
    with ProcessPoolExecutor(int(sys.argv[2]) if sys.argv[2:] else 2) as pool:
        for work in as_completed([pool.submit(row_of, seed) for seed in sorted(todo)]):
            rows.append(work.result())
            write(rows)
    for row in sorted(rows, key=lambda row: row.seed):
        marks = "".join("." if claim(row) else "X" for claim in CLAIMS.values())
        numbers = (np.array2string(getattr(row, name), precision=4, suppress_small=True, sign="+")
                   for name in MOVES)  # fmt: skip
        print(f"{row.seed:3d} {row.limbs} {row.ground:12s} {row.friction:8s}", *numbers,
              f"±{row.bar:.4f} ±{row.turn_bar:.2f} {row.flags} {row.seconds:.0f}s {marks}")  # fmt: skip
    for name, claim in CLAIMS.items():
        print(f"{sum(map(claim, rows))} of {len(rows)}: {name}")


if __name__ == "__main__":
    main()
