"""The numbers of TerreSoRo-IV from its transitions alone: `python -m zoo.terresoro_iv.fit`.

Fits the reduced model and the viscous one, from several starts, to all transitions and with an
eighth of them left out at a time, transitions that differ by quarter turns together; writes
fitted.csv, which it reads where it is there, and prints the README's tables. Half an hour of CPU
without it. Gaits are looked at last.
"""

import csv
import sys
from collections.abc import Sequence
from itertools import combinations, product

import numpy as np
from scipy.optimize import least_squares

from studies import Array
from zoo.terresoro_iv.hub import (
    DATA,
    FREE,
    Law,
    Numbers,
    Pair,
    additive,
    by_friction,
    cycle,
    gaits,
    jackknife,
    measured_cycles,
    smallest,
    together,
    transitions,
)  # fmt: skip

FOLDS = 8
# one for each of the two minima that random starts lead to
STARTS = {
    "dry": (Numbers(8.4, 4.97, 7.6, 5.15, 0.09, 0.75, 0.28),
            Numbers(8.1, 5.92, 8.9, 6.09, 0.03, 0.66, 0.25)),
    "viscous": (Numbers(8.4, 4.97, 7.6, 5.15, 0.09, 0.75, 0.28, 0.0),
                Numbers(8.1, 5.92, 8.9, 6.09, 0.03, 0.66, 0.25, 0.0)),
    "both": (Numbers(10.3, 4.81, 8.8, 5.03, 0.43, 0.55, -0.24, 0.44),
             Numbers(12.4, 5.56, 12.7, 5.78, 0.26, 0.25, -0.49, 0.59)),
}  # fmt: skip
_SCALE = (1.0, 0.1, 1.0, 0.1, 0.3, 0.3, 0.3, 0.3)
_STEP = 3e-3  # of differences, over a number; wide, for the misfit has kinks
_HEAD = ("law", "start", "left out", *Numbers._fields)
_SURE = 2.0  # standard errors


def fit(pairs: Sequence[Pair], measured: Array, start: Numbers, law: str) -> Numbers:
    """Least squares of x, y and turn, each over its spread."""
    spread, free = measured.std(axis=0), FREE[law]

    def left(values: Array) -> Array:
        found = law_of(law, Numbers(*values, *start[free:]))(pairs)
        return np.asarray(((found - measured) / spread).ravel())

    found = least_squares(left, start[:free], x_scale=_SCALE[:free], diff_step=_STEP, max_nfev=25,
                          ftol=1e-5)  # fmt: skip
    return Numbers(*found.x, *start[free:])


def law_of(law: str, numbers: Numbers) -> Law:
    """The law of a kind of friction."""
    return by_friction(numbers, dry=law != "viscous")


def folds(pairs: Sequence[Pair]) -> Array:
    """Which eighth each pair belongs to."""
    alike = sorted({smallest(pair)[0] for pair in pairs})
    order = np.random.default_rng(0).permutation(len(alike))
    of = {pair: number % FOLDS for pair, number in zip(alike, order, strict=True)}
    return np.array([of[smallest(pair)[0]] for pair in pairs])


def all_fits() -> dict[tuple[str, int, int], Numbers]:
    """Fits by law, start and the fold that is left out, -1 for none."""
    path, known = DATA / "fitted.csv", {}
    if path.exists():
        with path.open(encoding="utf-8") as file:
            for line in csv.DictReader(file):
                key = line["law"], int(line["start"]), int(line["left out"])
                known[key] = Numbers(*(float(line[name]) for name in Numbers._fields))
    pairs, measured = transitions()
    fold = folds(pairs)
    for law, start, left_out in product(FREE, range(2), range(-1, FOLDS)):
        if (law, start, left_out) in known:
            continue
        kept = np.flatnonzero(fold != left_out)
        first = known[law, start, -1] if left_out >= 0 else STARTS[law][start]
        known[law, start, left_out] = fit([pairs[k] for k in kept], measured[kept], first, law)
        print(law, start, left_out, known[law, start, left_out], file=sys.stderr, flush=True)
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(_HEAD)
            writer.writerows([*key, *(f"{x:.5g}" for x in row)] for key, row in known.items())
    return known


def explained(found: Array, measured: Array) -> Array:
    """R2 of x, y and turn."""
    return 1 - ((found - measured) ** 2).mean(axis=0) / measured.var(axis=0)


def wrong_order(found: Array, mean: Array, error: Array) -> list[str]:
    """Pairs of gaits whose distances differ surely and are predicted in the wrong order."""
    names, wrong = [gait.name for gait in gaits()], []
    for one, two in combinations(range(len(names)), 2):
        apart = mean[one, 0] - mean[two, 0]
        if (
            abs(apart) > _SURE * np.hypot(error[one, 0], error[two, 0])
            and apart * (found[one, 0] - found[two, 0]) <= 0
        ):
            wrong.append(names[one] + names[two])
    return wrong


def line(name: str, law: Law, held_out: Array | None) -> str:
    """A row of the README's table."""
    pairs, measured = transitions()
    r2 = " ".join(f"{x:.2f}" for x in explained(law(pairs), measured))
    seen = (
        " ".join(f"{x:.2f}" for x in explained(held_out, measured)) if held_out is not None else ""
    )
    mean, error = measured_cycles(gaits())
    found = np.array([cycle(gait.states, law) for gait in gaits()])
    off = np.sqrt(((found - mean) ** 2).mean(axis=0))
    wrong = " ".join(wrong_order(found, mean, error)) or "none"
    return f"| {name} | {r2} | {seen} | {off[0]:.2f} | {off[1]:.1f} | {wrong} |"


def main() -> None:
    """Print the tables."""
    pairs, measured = transitions()
    known, fold = all_fits(), folds(pairs)
    print("| law | R2 of x, y, turn | held out | gaits [cm] | [deg] | wrong pairs |")
    print("|---|---|---|---|---|---|")
    for law, start in product(FREE, range(2)):
        held_out = np.empty_like(measured)
        for k in range(FOLDS):
            here = np.flatnonzero(fold == k)
            held_out[here] = law_of(law, known[law, start, k])([pairs[i] for i in here])
        print(line(f"{law}, minimum {start + 1}", law_of(law, known[law, start, -1]), held_out))
        misses = ((held_out - measured) / measured.std(axis=0)) ** 2
        shares = [misses[fold == k].mean() for k in range(FOLDS)]
        print("    held out, of the variance: " + " ".join(f"{x:.3f}" for x in shares))
    held_out = np.empty_like(measured)
    for k in range(FOLDS):
        kept, here = np.flatnonzero(fold != k), np.flatnonzero(fold == k)
        held_out[here] = additive([pairs[i] for i in kept], measured[kept])(
            [pairs[i] for i in here]
        )
    print(line("additive", additive(pairs, measured), held_out))
    print(line("measured transitions together", together(pairs, measured), None))
    for law, start in product(("dry", "both"), range(2)):
        values = np.array([known[law, start, k][: FREE[law]] for k in range(FOLDS)])
        for name, value, error in zip(Numbers._fields, known[law, start, -1], jackknife(values),
                                      strict=False):  # fmt: skip
            print(f"{law}, minimum {start + 1}: {name} {value:.3f} ± {error:.3f}")


if __name__ == "__main__":
    main()
