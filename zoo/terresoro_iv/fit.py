"""The numbers of TerreSoRo-IV from its transitions alone: `python -m zoo.terresoro_iv.fit`.

Fits the reduced model and the viscous one, from several starts, to all transitions and with an
eighth of them left out at a time, transitions that differ by quarter turns together; writes
fitted.csv, which it reads where it is there, and prints the README's tables. Half an hour of CPU
without it. Gaits are looked at last.
"""

import csv
import sys
from collections.abc import Sequence
from itertools import combinations

import numpy as np
from scipy.optimize import least_squares

from studies import Array
from zoo.terresoro_iv.model import (
    HERE,
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
STARTS = (Numbers(8.4, 4.97, 7.6, 5.15, 0.09, 0.75, 0.28),
          Numbers(8.1, 5.92, 8.9, 6.09, 0.03, 0.66, 0.25))  # fmt: skip
_SCALE = (1.0, 0.1, 1.0, 0.1, 0.3, 0.3, 0.3)
_STEP = 3e-3  # of differences, over a number; wide, for the misfit has kinks
_HEAD = ("law", "start", "left out", *Numbers._fields)
_SURE = 2.0  # standard errors


def fit(pairs: Sequence[Pair], measured: Array, start: Numbers, viscous: bool) -> Numbers:
    """Least squares of x, y and turn, each over its spread."""
    spread = measured.std(axis=0)

    def left(values: Array) -> Array:
        law = by_friction(Numbers(*values), viscous)
        return np.asarray(((law(pairs) - measured) / spread).ravel())

    found = least_squares(left, start, x_scale=_SCALE, diff_step=_STEP, max_nfev=25, ftol=1e-5)
    return Numbers(*found.x)


def folds(pairs: Sequence[Pair]) -> Array:
    """Which eighth each pair belongs to."""
    alike = sorted({smallest(pair)[0] for pair in pairs})
    order = np.random.default_rng(0).permutation(len(alike))
    of = {pair: number % FOLDS for pair, number in zip(alike, order, strict=True)}
    return np.array([of[smallest(pair)[0]] for pair in pairs])


def all_fits() -> dict[tuple[str, int, int], Numbers]:
    """Fits by law, start and the fold that is left out, -1 for none."""
    path, known = HERE / "fitted.csv", {}
    if path.exists():
        with path.open(encoding="utf-8") as file:
            for line in csv.DictReader(file):
                key = line["law"], int(line["start"]), int(line["left out"])
                known[key] = Numbers(*(float(line[name]) for name in Numbers._fields))
    pairs, measured = transitions()
    fold = folds(pairs)
    for law, start, left_out in (
        (law, start, k)
        for law in ("dry", "viscous")
        for start in range(len(STARTS))
        for k in range(-1, FOLDS)
    ):
        if (law, start, left_out) in known:
            continue
        kept = np.flatnonzero(fold != left_out)
        first = known[law, start, -1] if left_out >= 0 else STARTS[start]
        known[law, start, left_out] = fit([pairs[k] for k in kept], measured[kept], first,
                                          law == "viscous")  # fmt: skip
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
    for law in ("dry", "viscous"):
        for start in range(len(STARTS)):
            held_out = np.empty_like(measured)
            for k in range(FOLDS):
                here = np.flatnonzero(fold == k)
                held_out[here] = by_friction(known[law, start, k], law == "viscous")(
                    [pairs[i] for i in here])  # fmt: skip
            print(line(f"{law}, minimum {start + 1}",
                       by_friction(known[law, start, -1], law == "viscous"), held_out))  # fmt: skip
    held_out = np.empty_like(measured)
    for k in range(FOLDS):
        kept, here = np.flatnonzero(fold != k), np.flatnonzero(fold == k)
        held_out[here] = additive([pairs[i] for i in kept], measured[kept])(
            [pairs[i] for i in here]
        )
    print(line("additive", additive(pairs, measured), held_out))
    print(line("measured transitions together", together(pairs, measured), None))
    for start in range(len(STARTS)):
        values = np.array([known["dry", start, k] for k in range(FOLDS)])
        for name, value, error in zip(Numbers._fields, known["dry", start, -1], jackknife(values),
                                      strict=True):  # fmt: skip
            print(f"minimum {start + 1}: {name} {value:.3f} ± {error:.3f}")


if __name__ == "__main__":
    main()
