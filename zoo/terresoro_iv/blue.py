"""TerreSoRo-IV once more, on other feet: `python -m zoo.terresoro_iv.blue FOLDER`.

The blue robot has the same limbs and another frictional component; nothing of it was fitted
before. Of its single runs it prints what the orange robot's numbers explain, what is explained when
friction alone is fitted anew, and the lag, and all; each fit also with an eighth of the transitions
left out at a time.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from studies import Array
from zoo.terresoro_iv.fit import FOLDS, explained
from zoo.terresoro_iv.hub import jackknife
from zoo.terresoro_iv.memory import STEP, folds_of, noise
from zoo.terresoro_iv.model import SCALE, Lagged, motions, remembered
from zoo.terresoro_iv.tracks import BLUE, Runs, runs

FREED = {
    "the orange robot's numbers": (),
    "viscous friction fitted": ("resting", "curling", "uncurling", "viscous"),
    "and the lag": ("resting", "curling", "uncurling", "viscous", "lag"),
    "and the curled contact, all 7": Lagged._fields,
}
_TINY = 1e-9  # an error that rounding makes


def fit(freed: tuple[str, ...], of: Runs, kept: Array, start: Lagged) -> Lagged:
    """Numbers of some names by least squares of runs, each over its spread; the others as given."""
    if not freed:
        return start
    spread, scale = of.motion.std(axis=0), dict(zip(Lagged._fields, SCALE, strict=True))

    def left(values: Array) -> Array:
        numbers = start._replace(**dict(zip(freed, values.tolist(), strict=True)))
        return np.asarray(
            ((motions(numbers, of.past[kept], of.after[kept]) - of.motion[kept]) / spread).ravel()
        )

    best = least_squares(left, [getattr(start, name) for name in freed], diff_step=STEP,
                         x_scale=[scale[name] for name in freed], max_nfev=20)  # fmt: skip
    return start._replace(**dict(zip(freed, best.x.tolist(), strict=True)))


def main(folder: str) -> None:
    """Print a row per fit, and the numbers of the last one."""
    of, orange = runs(Path(folder), BLUE), Lagged(*remembered()[0])
    fold, every = folds_of(of), np.ones(len(of.tour), dtype=bool)
    print(f"{len(of.tour)} runs; part of their variance by which runs of one transition differ:",
          noise(of).round(2))  # fmt: skip
    print("| of the blue robot | R2 | held out |")
    print("|---|---|---|")
    for name, freed in FREED.items():
        best, held_out, others = fit(freed, of, every, orange), np.empty_like(of.motion), []
        for k in range(FOLDS):
            here = fold == k
            others.append(fit(freed, of, ~here, best))
            held_out[here] = motions(others[-1], of.past[here], of.after[here])
        r2, seen = (" ".join(f"{x:.2f}" for x in explained(one, of.motion))
                    for one in (motions(best, of.past, of.after), held_out))  # fmt: skip
        print(f"| {name} | {r2} | {seen} |", flush=True)
        shown = zip(Lagged._fields, best, jackknife(np.array(others)), strict=True)
        print("   ", ", ".join(f"{word} {x:.3f} ± {e:.3f}" for word, x, e in shown if e > _TINY))


if __name__ == "__main__":
    main(*sys.argv[1:])
