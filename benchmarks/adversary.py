"""Search for reward in the holes of the environment's model, and what a finer model pays for it.

    python benchmarks/adversary.py [SEED [PART]]
    python benchmarks/adversary.py again

Looks for the pressures that earn most in an environment as gymnasium.make makes it, and walks the
best of each search again with 24 links and 1 ms. Policies are cycles of pressures, one row per
control period: the paper's wave both ways; bang-bang, chambers fully on or off; random pressures;
and an evolution of whatever cycles earn most, which begins at the best of those and at all rows
that are there. Writes adversary.csv beside this file, one row per cycle, after each search; goes on
where it was stopped. Half an hour per ground and core, or PART of that many tries; `again` walks
all rows anew. Rows of seeds 0 and 1 were found in models of other time steps, which they fooled
most (0: 10 ms and softer contacts; 1, of fewer tries and without evolution: steps that were short
only while contacts changed), and are walked again in the environment as it is; rows of seed 2 were
found in it, with PART 0.15, on gelatin 0.08.
"""

import csv
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.gait import GAITS
from mjsim.env.settings import Settings
from mjsim.env.task import Walker
from mjsim.scene import Numerics

ROWS = Path(__file__).with_name("adversary.csv")
GROUNDS = ("gelatin", "felt", "polyethylene")
FINE = Numerics(links=24, timestep=0.001, contact_path="curved")
LEVELS = "0123456789X"  # tenths of the peak pressure
SEARCHES = {"wave": 6, "bang-bang": 300, "random": 60, "evolution": 900}  # cycles to try
AGAIN = 3  # of the best of each search, how many are walked by the finer model
WITHIN, LEAST = 0.1, 0.006  # of the finer model's reward, and L: a tenth of what the wave earns
_LONGEST = 60  # control periods of a cycle
_PARENTS, _CHILDREN = 12, 24
_KINDS = 5  # of mutations


class Row(NamedTuple):
    """Rewards of a cycle of pressures in an episode, over L, by both models."""

    ground: str
    seed: int
    search: str
    cycle: str
    earned: float
    finer: float
    status: str
    finer_status: str
    sinking: float

    @property
    def holds(self) -> bool:
        """Tell whether both models pay the same."""
        return abs(self.earned - self.finer) <= max(WITHIN * abs(self.finer), LEAST)


Cycle = NDArray[np.int_]


def written(cycle: Cycle) -> str:
    """A cycle (T, S) of tenths as words, one per control period."""
    return " ".join("".join(LEVELS[level] for level in row) for row in cycle)


def read(words: str) -> Cycle:
    """The cycle of words."""
    return np.array([[LEVELS.index(letter) for letter in word] for word in words.split()])


class Judge:
    """Episodes of one environment."""

    def __init__(self, ground: str, numerics: Numerics | None = None) -> None:
        self.settings = Settings(surfaces=(ground,), numerics=numerics)
        self._walker = Walker(self.settings.scene(self.settings.grounds[0]), self.settings)

    def __call__(self, cycle: Cycle) -> tuple[float, str, float]:
        """Reward of an episode, status at its end, and depth to which the robot sank over L."""
        walker, total, depth = self._walker, 0.0, 0.0
        walker.reset()
        for step in range(self.settings.length):
            walker.play(cycle[step % len(cycle)] / 10, self.settings.steps)
            total += walker.reward
            depth = max(depth, walker.info()["sinking"])
            if walker.fallen:
                break
        return total, str(walker.seen.status), depth


def waves() -> Iterator[Cycle]:
    """The paper's wave and its reverse, in ramps of 0.5 to 2 s."""
    for gait in (GAITS["wave"], GAITS["wave"].reversed()):
        for count in (25, 50, 100):
            part = gait.fractions((np.arange(count) + 1) * gait.period / count)
            yield np.rint(10 * part).astype(int)


def bang_bang(rng: np.random.Generator) -> Cycle:
    """Stages of chambers on or off, each as long as the others: 0.1 to 1 s."""
    stages = 10 * rng.integers(0, 2, (int(rng.integers(2, 9)), 3))
    cycle: Cycle = np.repeat(stages, int(rng.integers(1, 11)), axis=0)
    return cycle[:_LONGEST]


def random(rng: np.random.Generator) -> Cycle:
    """Pressures drawn anew in each control period of the whole episode."""
    return rng.integers(0, 11, (200, 3))


def mutated(cycle: Cycle, other: Cycle, rng: np.random.Generator) -> Cycle:
    """A cycle changed in some pressures or its length, or with a part of another."""
    new = cycle.copy()
    kind = int(rng.integers(_KINDS))
    begin = int(rng.integers(len(new)))
    stretch = slice(begin, begin + int(rng.integers(1, 6)))
    if kind == 0:
        new[stretch, rng.integers(3)] = rng.integers(0, 11)
    elif kind == 1:
        mask = rng.random(new.shape) < 0.1
        new[mask] = rng.integers(0, 11, mask.sum())
    elif kind == 2:
        new = np.insert(new, begin, new[stretch], axis=0)[:_LONGEST]
    elif kind == 3 and len(new) > 6:
        new = np.delete(new, stretch, axis=0)
    else:
        count = min(len(new), len(other))
        chamber = int(rng.integers(3))
        new[:count, chamber] = np.roll(other[:count, chamber], int(rng.integers(count)))
    return new


def searched(ground: str, search: str, seed: int, tries: int, before: list[Row]) -> list[Row]:
    """Rows of the best cycles of a search."""
    judge, rng = Judge(ground), np.random.default_rng([seed, list(SEARCHES).index(search)])
    tried: dict[str, float] = {}

    def evaluate(cycle: Cycle) -> None:
        word = written(cycle)
        if word not in tried:
            tried[word] = judge(cycle)[0]

    if search == "wave":
        for cycle in waves():
            evaluate(cycle)
    elif search == "evolution":
        for row in before:
            evaluate(read(row.cycle)[:_LONGEST])
        while len(tried) < tries:
            parents = sorted(tried, key=tried.__getitem__, reverse=True)[:_PARENTS]
            for _ in range(_CHILDREN):
                one, other = (read(parents[i]) for i in rng.integers(len(parents), size=2))
                evaluate(mutated(one, other, rng))
    else:
        draw = bang_bang if search == "bang-bang" else random
        while len(tried) < tries:
            evaluate(draw(rng))
    best = sorted(tried, key=tried.__getitem__, reverse=True)[:AGAIN]
    fine = Judge(ground, FINE)
    return [row_of(judge, fine, (ground, seed, search, word)) for word in best]


def row_of(judge: Judge, fine: Judge, key: tuple[str, int, str, str]) -> Row:
    """Row of a cycle by both models, from its ground, seed, search and words."""
    cycle = read(key[-1])
    earned, status, sinking = judge(cycle)
    finer, finer_status, _ = fine(cycle)
    return Row(*key, round(earned, 5), round(finer, 5), status, finer_status, round(sinking, 5))


def stored() -> list[Row]:
    """Rows that are there."""
    if not ROWS.exists():
        return []
    with ROWS.open(newline="") as file:
        kinds = Row.__annotations__
        return [
            Row(**{name: kinds[name](value) for name, value in line.items()})
            for line in csv.DictReader(file)
        ]


def add(rows: list[Row], again: bool = False) -> None:
    """Append rows, or put them in the place of all rows that are there."""
    new = again or not ROWS.exists()
    with ROWS.open("w" if again else "a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(Row._fields)
        writer.writerows(rows)


def on_ground(ground: str, seed: int, part: float = 1.0) -> None:
    """All searches on a ground that are not there yet, with a part of the tries."""
    for search, tries in SEARCHES.items():
        before = [row for row in stored() if row.ground == ground]
        if not any((row.search, row.seed) == (search, seed) for row in before):
            add(searched(ground, search, seed, round(part * tries), before))


def walked_again(ground: str) -> list[Row]:
    """All rows of a ground by the models as they are."""
    judge, fine = Judge(ground), Judge(ground, FINE)
    return [row_of(judge, fine, row[:4]) for row in stored() if row.ground == ground]


def main() -> None:
    """Search or walk all rows anew, and print what each earned."""
    words = sys.argv[1:]
    with ProcessPoolExecutor() as pool:
        if words == ["again"]:
            add([row for rows in pool.map(walked_again, GROUNDS) for row in rows], again=True)
        else:
            seed, part = int(words[0]) if words else 2, float(words[1]) if words[1:] else 1.0
            count = len(GROUNDS)
            list(pool.map(on_ground, GROUNDS, [seed] * count, [part] * count))
    rows = sorted(stored(), key=lambda row: (GROUNDS.index(row.ground), -row.earned))
    for row in rows:
        print(f"{row.ground:13} {row.seed} {row.search:10} {row.earned:+.4f} {row.finer:+.4f} "
              f"{row.status:8} {row.finer_status:8} sank {row.sinking:.3f} "
              f"{'' if row.holds else 'differs'}")  # fmt: skip
    print(f"{sum(row.holds for row in rows)} of {len(rows)} hold")


if __name__ == "__main__":
    main()
