"""Random trees of limbs: MuJoCo by default against finer MuJoCo and against a finer reference.

    python benchmarks/trees.py [count] [processes]

Trees of 2 to 8 limbs, with angles, lengths, widths, weights, gaits, both friction laws and four
grounds at random, each a function of its seed alone: by default numerics; by twice the links at
half and at a quarter of the step; by the reference, the coarser one of its error bar, and by the
reference of twice the links and states. Rows are added to trees.csv beside this file as they come,
and those there are kept. Prints how many agree within 5 % or 0.003 L and within 5 % or 0.3 degrees,
a walk or a reference that fails being a miss, and how many error bars cover what the finer one
changes. A tree takes 5 to 120 s of CPU time.
"""

import csv
import itertools
import sys
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.gait import Gait
from analytic.scene.limbs import Limb, LimbedRobot
from analytic.scene.robot import Robot
from analytic.scene.surface import FRICTION, SHEAR_STRENGTH, SURFACES, TIP_FORCE, Surface
from mjsim.files.files import whole
from mjsim.results.measures import measure
from mjsim.results.prediction import HALF, Reference, error_bars, reference
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.second_walks import changes
from mjsim.simulation.simulation import simulate

Array = NDArray[np.float64]

ROWS = Path(__file__).with_name("trees.csv")
COUNT = 60
MIXED = Surface("mixed", 0.7 * TIP_FORCE, 0.5 * SHEAR_STRENGTH, 0.5 * FRICTION, 0.7 * FRICTION)
GROUNDS = (*SURFACES.values(), MIXED)
WITHIN, WITHIN_LENGTH, WITHIN_TURN = 0.05, 0.003, 0.3  # relative, L, degrees
RAMP = 4.0  # s
MOVES = ("walk", "half", "quarter", "theory", "coarse", "fine")
PARTS = ("ahead", "aside", "turn")
BARS = ("walk_bar", "theory_bar")


class Row(NamedTuple):
    """A tree: moves, and error bars of a walk and of its reference; NaN of what failed.

    Moves are ahead and aside over L and a turn in degrees, (3,); bars over L and in degrees, (2,).
    """

    seed: int
    limbs: int
    ground: str
    friction: str
    walk: Array
    half: Array
    quarter: Array
    walk_bar: Array
    theory: Array
    coarse: Array
    fine: Array
    theory_bar: Array
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


def moved(walk: Trajectory) -> Array:
    """Move of a walk in MuJoCo, (3,); NaN if it failed."""
    numbers = measure(walk)
    if numbers is None:
        return np.full(3, np.nan)
    return np.array([numbers.displacement, numbers.aside, np.degrees(numbers.turn)])


def predicted(theory: Reference) -> Array:
    """Move by a reference, (3,)."""
    return np.array([*theory.displacement, np.degrees(theory.turn)])


def row_of(seed: int) -> Row:
    scene, begin = draw(seed), time.process_time()
    usual = resolved(scene)
    walk, half, quarter = (
        simulate(scene, Numerics(links=links * usual.links, timestep=usual.timestep / part))
        for links, part in ((1, 1), (2, 2), (2, 4))
    )
    moves = [moved(each) for each in (walk, half, quarter)]
    ended = not np.isnan(moves[:2]).any()
    walk_bar = np.array(changes(walk, half) if ended else (np.nan, np.nan))
    theory, coarse, fine = (reference(scene, finer=finer) for finer in (1, HALF, 2))
    bar, turn_bar = error_bars(scene, theory, coarse)
    theory_bar = np.array([np.nan if bar is None else bar, np.degrees(turn_bar)])
    flags = [f"{name} {flag}" for name, each in (("theory", theory), ("fine", fine))
             for flag in each.flags]  # fmt: skip
    return Row(seed, len(scene.robot.limbs), scene.ground.name, scene.friction, *moves, walk_bar,
               *map(predicted, (theory, coarse, fine)), theory_bar, "; ".join(flags),
               time.process_time() - begin)  # fmt: skip


def apart(one: Array, other: Array) -> Array:
    """Distance between two moves, over L and in degrees, (2,)."""
    return np.array([np.hypot(*(one - other)[:2]), abs(one[2] - other[2])])


def agrees(one: Array, other: Array) -> bool:
    """Tell whether both displacement and turn do, by the size of the other."""
    size = np.array([np.hypot(*other[:2]), abs(other[2])])
    allowed = np.maximum(WITHIN * size, (WITHIN_LENGTH, WITHIN_TURN))
    return bool((apart(one, other) <= allowed).all())


def covers(bar: Array, one: Array, other: Array) -> bool:
    return bool((apart(one, other) <= bar).all())


CLAIMS: dict[str, Callable[[Row], bool]] = {
    "MuJoCo as by twice the links and a quarter of the step": lambda r: agrees(r.walk, r.quarter),
    "MuJoCo as the reference by twice the links and states": lambda r: agrees(r.walk, r.fine),
    "reference as by twice the links and states": lambda r: agrees(r.theory, r.fine),
    "finest MuJoCo as the finest reference": lambda r: agrees(r.quarter, r.fine),
    "bar of MuJoCo covers a quarter of the step": lambda r: covers(r.walk_bar, r.walk, r.quarter),
    "bar of the reference covers the finest": lambda r: covers(r.theory_bar, r.theory, r.fine),
    "both bars cover MuJoCo and the finest reference": lambda r: covers(
        r.walk_bar + r.theory_bar, r.walk, r.fine
    ),
}


def columns(name: str) -> list[str]:
    """Columns of a field of a row."""
    parts = PARTS if name in MOVES else ("over_L", "deg") if name in BARS else ()
    return [f"{name}_{part}" for part in parts] or [name]


def read() -> list[Row]:
    if not ROWS.is_file():
        return []
    with ROWS.open(newline="", encoding="utf-8") as file:
        return [
            Row(*(
                np.array([float(row[column]) for column in columns(name)])
                if name in MOVES + BARS else kind(row[name])
                for name, kind in Row.__annotations__.items()
            )) for row in csv.DictReader(file)
        ]  # fmt: skip


def write(rows: list[Row]) -> None:
    with whole(ROWS) as part, part.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow([column for name in Row._fields for column in columns(name)])
        for row in sorted(rows, key=lambda row: row.seed):
            values = (v.tolist() if isinstance(v, np.ndarray) else [v] for v in row)
            cells = itertools.chain.from_iterable(values)
            table.writerow([f"{cell:.6g}" if isinstance(cell, float) else cell for cell in cells])


def main() -> None:
    count = int(sys.argv[1]) if sys.argv[1:] else COUNT
    rows = read()
    todo = set(range(count)) - {row.seed for row in rows}
    with ProcessPoolExecutor(int(sys.argv[2]) if sys.argv[2:] else 2) as pool:
        for work in as_completed([pool.submit(row_of, seed) for seed in sorted(todo)]):
            rows.append(work.result())
            write(rows)
    for name, claim in CLAIMS.items():
        missed = [row for row in rows if not claim(row)]
        print(f"{len(rows) - len(missed)} of {len(rows)}: {name}")
        for row in missed:
            print(f"  {row.seed}, {row.limbs} limbs, {row.ground}, {row.friction} {row.flags}")
            for part in (*MOVES, *BARS):
                print(f"    {part:10}", *(f"{number:+.4f}" for number in getattr(row, part)))


if __name__ == "__main__":
    main()
