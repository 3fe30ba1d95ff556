"""The numbers of TerreSoRo-IV's limbs from its transitions: `python -m zoo.terresoro_iv.fit_limbs`.

Of many robots, drawn at random and near the best one so far, those numbers of friction are fitted
that cost no new shapes; the best is kept in limbs.csv, with standard errors by the information
matrix. --fit SECONDS [SEED] goes on from there. Prints what limbs explain; gaits come last.
"""

import csv
import sys
import time
from collections.abc import Sequence

import numpy as np
from scipy.optimize import least_squares

from studies import Array
from zoo.terresoro_iv import limbs
from zoo.terresoro_iv.fit import explained, wrong_order
from zoo.terresoro_iv.hub import HERE, Pair, gaits, measured_cycles, smallest, turned
from zoo.terresoro_iv.limbs import Numbers, Walker, cycle, known
from zoo.terresoro_iv.model import recut, recut_gaits

LOW, HIGH = np.array([[5, 3.9, 5.5, 1.3, -1.6], [9, 4.5, 9, 2.2, 1.0]])  # of the first five numbers
NEAR = np.array([0.5, 0.06, 0.5, 0.1, 0.2])  # by which they are changed
_FAR, _LAG, _MOST_LAG = 0.4, 0.04, 0.3  # part that is drawn anew; change and most of the lag
_STEPS = (0.1, 0.02, 0.1, 0.03, 0.05, 0.05, 0.05, 0.05, 0.02)  # of differences
_FRICTION = np.array([-0.3, 1.5, 0.3])  # where those numbers start
_WIDEST = (-3.0, 3.0)


def alike() -> tuple[Array, Array, Array]:
    """Pasts (60, 1, 4), states after (60, 4) and means of alike transitions, (60, 3)."""
    pairs, means = recut()
    rows: dict[Pair, list[Array]] = {}
    for pair, mean in zip(pairs, means, strict=True):
        one, shift = smallest(pair)
        rows.setdefault(one, []).append(np.array([*turned(mean[:2], 0.5 * np.pi * shift), mean[2]]))
    return (
        np.array([[[int(x) for x in before]] for before, _ in rows]),
        np.array([[int(x) for x in after] for _, after in rows]),
        np.array([np.mean(each, axis=0) for each in rows.values()]),
    )


class Misfit:
    """Misses of means over their spreads, by numbers."""

    def __init__(self) -> None:
        past, after, self.means = alike()
        self.walker, self._spread = Walker(past, after), recut()[1].std(axis=0)

    def __call__(self, numbers: Array) -> Array:
        """All of them, (180,)."""
        found = self.walker(Numbers(*numbers))
        return np.asarray(((found - self.means) / self._spread).ravel())

    def with_friction(self, robot: Array, lag: float, start: Array) -> Array:
        """Numbers of a robot with those of friction that fit best, (9,)."""

        def left(friction: Array) -> Array:
            return self(np.array([*robot, *friction, lag]))

        least = least_squares(left, start, diff_step=0.05, max_nfev=8, bounds=_WIDEST, x_scale=1.0)
        return np.array([*robot, *least.x, lag])

    def errors(self, numbers: Array) -> Array:
        """Standard errors by the information matrix, (9,)."""
        columns = []
        for k, step in enumerate(_STEPS):
            ahead, back = (self(numbers + sign * step * np.eye(9)[k]) for sign in (1, -1))
            columns.append((ahead - back) / (2 * step))
        slopes, miss = np.stack(columns, axis=1), self(numbers)
        noise = miss @ miss / (len(miss) - len(numbers))
        return np.asarray(np.sqrt(noise * np.diag(np.linalg.pinv(slopes.T @ slopes))))


def search(seconds: float, seed: int = 0) -> None:
    """Go on from the best numbers and keep better ones."""
    misfit, random, end = Misfit(), np.random.default_rng(seed), time.monotonic() + seconds
    best = np.array(known()[0])
    least = float(np.mean(misfit(best) ** 2))
    while time.monotonic() < end:
        near = random.random() > _FAR
        robot = best[:5] + NEAR * random.normal(size=5) if near else random.uniform(LOW, HIGH)
        lag = float(np.clip(best[8] + _LAG * random.normal(), 0.0, _MOST_LAG))
        misfit.walker.forget()
        try:
            tried = misfit.with_friction(robot, lag, best[5:8] if near else _FRICTION)
        except ValueError:
            continue  # a robot that finds no shape
        if (miss := float(np.mean(misfit(tried) ** 2))) < least:
            best, least = tried, miss
            print(f"{least:.4f}", best.round(3).tolist(), flush=True)
    write(best, misfit.errors(best))


def write(value: Array, error: Array) -> None:
    """Keep numbers and their errors."""
    with (HERE / "limbs.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("", *Numbers._fields))
        for name, row in (("value", value), ("standard error", error)):
            writer.writerow((name, *(f"{x:.5g}" for x in row)))


def main(argv: Sequence[str]) -> None:
    """Print what limbs explain."""
    if argv[:1] == ["--fit"]:
        search(float(argv[1]), int(argv[2]) if argv[2:] else 0)
    numbers, errors = known()
    past, after, means = alike()
    for limbs.STEPS in (2, 4, 8):
        print(limbs.STEPS, "steps: R2 of means",
              explained(Walker(past, after)(numbers), means).round(2))  # fmt: skip
    limbs.STEPS = 2
    mean, error = measured_cycles(recut_gaits())
    found = np.array([cycle(gait.states, numbers) for gait in gaits()])
    print("gaits", np.sqrt(((found - mean) ** 2).mean(axis=0)).round(2),
          wrong_order(found, mean, error), found.round(2).tolist())  # fmt: skip
    for name, value, off in zip(Numbers._fields, numbers, errors, strict=True):
        print(f"{name} {value:.3f} ± {off:.3f}")


if __name__ == "__main__":
    main(sys.argv[1:])
