"""What TerreSoRo-IV remembers: `python -m zoo.terresoro_iv.memory [FOLDER]`.

Fits each form of memory to single runs whose past is known, from its tracks in FOLDER (see
`tracks`), all of them and with an eighth of the transitions left out at a time, those alike by
quarter turns together; writes remembered.csv and prints the README's table. Gaits are looked at
last. Without FOLDER the gaits of what was fitted are printed, and what they change by sub-steps.
"""

import csv
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from studies import Array
from zoo.deciding import errors
from zoo.terresoro_iv.fit import FOLDS, explained, folds, wrong_order
from zoo.terresoro_iv.forms import FORMS
from zoo.terresoro_iv.hub import (
    DATA,
    by_friction,
    clustered,
    fitted,
    gaits,
    jackknife,
    measured_cycles,
    smallest,
    transitions,
)
from zoo.terresoro_iv.hub import cycle as cycle_of_pairs
from zoo.terresoro_iv.hub import together as measured_together
from zoo.terresoro_iv.model import (
    FORM,
    SCALE,
    Lagged,
    cycle,
    cycles,
    recut,
    recut_gaits,
    remembered,
    slopes,
    steady,
    together,
)  # fmt: skip
from zoo.terresoro_iv.tracks import Runs, runs

START = (7.5, 4.9, 0.9, 0.7, -0.35, 0.7, 0.2)
_MORE = {"free flat contact": (1.0, 0.1)}  # scales of further values; 0.1 of others
STEP, _MOST = 3e-3, 15  # of differences, over a number; evaluations with slopes


def fit(name: str, found: Runs, rows: NDArray[np.intp], start: Array) -> Array:
    """Least squares of x, y and turn of runs, each over its spread."""
    spread = found.motion.std(axis=0)
    past, after, motion = found.past[rows], found.after[rows], found.motion[rows]

    def left(values: Array) -> Array:
        return np.asarray(((FORMS[name].law(values, past, after) - motion) / spread).ravel())

    scale = np.array([*SCALE, *_MORE.get(name, (0.1, 0.1, 0.1))])[: len(start)]
    return np.asarray(least_squares(left, start, x_scale=scale, diff_step=STEP, max_nfev=_MOST,
                                    ftol=1e-5).x)  # fmt: skip


def folds_of(found: Runs) -> Array:
    """Which eighth each run belongs to."""
    pairs, _ = transitions()
    known = dict(zip(pairs, folds(pairs), strict=True))
    text = [["".join(map(str, state)) for state in states]
            for states in (found.past[:, -1], found.after)]  # fmt: skip
    return np.array([known[pair] for pair in zip(*text, strict=True)])


def kinds_of(found: Runs) -> Array:
    """Of which kind each run is: transitions that are alike by quarter turns are of one."""
    text = [["".join(map(str, state)) for state in states]
            for states in (found.past[:, -1], found.after)]  # fmt: skip
    alike = [smallest(pair)[0] for pair in zip(*text, strict=True)]
    each = {kind: number for number, kind in enumerate(sorted(set(alike)))}
    return np.array([each[kind] for kind in alike])


def covariance_of(found: Runs, values: Array) -> Array:
    """Covariance of the fitted numbers by kinds of transitions, (7, 7)."""
    spread, law = found.motion.std(axis=0), FORMS[FORM].law
    by_number = slopes(lambda at: law(at, found.past, found.after) / spread, values)
    left = (law(values, found.past, found.after) - found.motion) / spread
    kinds = np.repeat(kinds_of(found), left.shape[1])
    return clustered(by_number.reshape(-1, len(values)), left.ravel(), kinds)


def keep_errors(found: Runs, values: Array) -> None:
    """Write the covariance by kinds and print standard errors of numbers and gaits."""
    covariance = covariance_of(found, values)
    with (DATA / "covariance.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(Lagged._fields)
        writer.writerows([f"{x:.5g}" for x in row] for row in covariance)
    print("errors by kinds:", np.sqrt(np.diag(covariance)).round(3))
    of_gaits = errors(covariance, slopes(cycles, values).reshape(-1, len(values)))
    print("errors of the gaits by kinds [cm, deg]:", of_gaits.reshape(-1, 2).round(3).T.tolist())


def noise(found: Runs) -> Array:
    """Part of the variance of runs in x, y and turn by which those of one transition differ."""
    keys = [(tuple(a), tuple(b)) for a, b in zip(found.past[:, -1], found.after, strict=True)]
    groups = [found.motion[[key == one for key in keys]] for one in sorted(set(keys))]
    return np.asarray(np.mean([g.var(axis=0, ddof=1) for g in groups], axis=0)
                      / found.motion.var(axis=0))  # fmt: skip


def start_of(name: str, lagged: Array) -> Array:
    """Where a form's fit begins: at the lagged hub, which most contain."""
    form = FORMS[name]
    if name == "no memory":
        return lagged[:6]
    if form.extends or not form.neutral:
        return np.array([*lagged, *form.neutral])
    return np.array(form.neutral)


def gaits_of(name: str, values: Array) -> Array:
    """Distance [cm] and turn [deg] of the five gaits."""
    return np.array([together(FORMS[name].law(values, *steady(gait.states))) for gait in gaits()])


def fit_all(folder: Path) -> None:
    """Fit every form and print what it explains of transitions."""
    found, lines, misses = runs(folder), [], {}
    fold, every = folds_of(found), np.flatnonzero(found.tour >= 0)
    spread, lagged = found.motion.std(axis=0), np.array(START)
    print(f"{len(every)} runs; of their variance runs of one transition differ by",
          noise(found).round(3), noise(found).mean().round(4))  # fmt: skip
    kinds = kinds_of(found)
    for name in (FORM, *(name for name in FORMS if name != FORM)):
        form = FORMS[name]
        values = fit(name, found, every, np.array(START) if name == FORM else
                     start_of(name, lagged))  # fmt: skip
        if name == FORM:
            lagged = values
            keep_errors(found, values)
        held_out, fits = np.empty_like(found.motion), [values]
        for k in range(FOLDS):
            here = fold == k
            fits.append(fit(name, found, np.flatnonzero(~here), values))
            held_out[here] = form.law(fits[-1], found.past[here], found.after[here])
        lines += [(name, number - 1, " ".join(f"{x:.6g}" for x in row))
                  for number, row in enumerate(fits)]  # fmt: skip
        share = (((held_out - found.motion) / spread) ** 2).mean(axis=1)
        misses[name] = share
        less = misses[FORM] - misses[name]
        by_fold = np.array([less[fold == k].mean() for k in range(FOLDS)])
        by_kind = clustered(np.ones((len(less), 1)), less - less.mean(), kinds)
        r2, seen = (" ".join(f"{x:.2f}" for x in explained(one, found.motion))
                    for one in (form.law(values, found.past, found.after), held_out))  # fmt: skip
        print(
            f"| {name}, {form.numbers} numbers | {r2} | {seen} | {share.mean():.4f} | "
            f"{-by_fold.mean():+.4f} ± {by_fold.std(ddof=1) / FOLDS**0.5:.4f} |"
            f" by kinds ± {by_kind.item() ** 0.5:.4f}",
            flush=True,
        )
        with (DATA / "remembered.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerows([("form", "left out", "values"), *lines])


def main(folder: str | None = None) -> None:
    """Print the tables."""
    if folder:
        fit_all(Path(folder))
    pairs, means = recut()
    cuts = {"as published": gaits(), "recut": recut_gaits()}
    for cut, measured in cuts.items():
        mean, error = measured_cycles(measured)
        print(f"gaits {cut}: rms [cm, deg], pairs in the wrong order, distances, turns")
        print("   measured", mean.round(2).T.tolist())
        for name in FORMS:
            found = gaits_of(name, remembered(name)[0])
            _line(name, found, mean, error)
        law = measured_together(pairs, means)
        found = np.array([cycle_of_pairs(gait.states, law) for gait in gaits()])
        _line("recut transitions together", found, mean, error)
        for minimum in (0, 1):
            law = by_friction(fitted(minimum)[0])
            found = np.array([cycle_of_pairs(gait.states, law) for gait in gaits()])
            _line(f"no memory, published cut, minimum {minimum + 1}", found, mean, error)
    values, left_out = remembered()
    numbers = Lagged(*values)
    past = np.array([[[int(x) for x in before]] for before, _ in pairs])
    after = np.array([[int(x) for x in state] for _, state in pairs])
    rest = FORMS[FORM].law(values, past, after)
    print("means of transitions from rest explained:", explained(rest, means).round(2))
    fine = [np.array([cycle(g.states, numbers, parts) for g in gaits()]) for parts in (1, 6, 24)]
    print("6 and 24 sub-steps change the gaits by at most",
          *(np.abs(one - fine[0]).max(axis=0).round(4) for one in fine[1:]))  # fmt: skip
    for name, value, error in zip(Lagged._fields, values, jackknife(left_out), strict=True):
        print(f"{name} {value:.3f} ± {error:.3f}")


def _line(name: str, found: Array, mean: Array, error: Array) -> None:
    off = np.sqrt(((found - mean) ** 2).mean(axis=0))
    wrong = " ".join(wrong_order(found, mean, error)) or "none"
    print(f"   {name}: {off[0]:.2f}, {off[1]:.1f}, {wrong}; {found[:, 0].round(2).tolist()} "
          f"{found[:, 1].round(1).tolist()}")  # fmt: skip


if __name__ == "__main__":
    main(*sys.argv[1:])
