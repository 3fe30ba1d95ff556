"""Single steps of TerreSoRo-IV's gaits, within a cycle: `python -m zoo.terresoro_iv.steps FOLDER`.

A cycle is a small difference of large steps, so cycles that agree say little of steps. Prints by
how much steps differ from predicted ones, and from the tours' means of the same transitions. Each
gait's axes are turned by one angle to fit, since nobody noted how its hub was laid down.
"""

import sys
from itertools import pairwise
from pathlib import Path

import numpy as np

from studies import Array
from zoo.terresoro_iv.hub import gaits
from zoo.terresoro_iv.model import Lagged, motions, recut, remembered, steady
from zoo.terresoro_iv.tracks import gait_steps


def apart(one: Array, other: Array) -> tuple[float, float]:
    """Root mean squares of what steps (T, 3) differ by, the axes of one turned: [cm], [deg]."""
    here, there = (steps[:, :2] @ [1, 1j] for steps in (one, other))
    turn = np.vdot(here, there)
    off = np.abs(there - here * turn / np.abs(turn))
    return float(np.sqrt((off**2).mean())), float(np.sqrt(((one - other)[:, 2] ** 2).mean()))


def main(folder: str) -> None:
    """Print a row per gait."""
    known = dict(zip(*recut(), strict=True))
    numbers = Lagged(*remembered()[0])
    print("| gait | steps [cm] | repeat to | predicted off by | tours' means off by |")
    print("|---|---|---|---|---|")
    for gait in gaits():
        each = gait_steps(Path(folder), gait.name)
        steps = each.mean(axis=0)
        lengths = " ".join(f"{x:.2f}" for x in np.hypot(*steps[:, :2].T))
        repeat = np.sqrt((each.std(axis=0, ddof=1)[:, :2] ** 2).sum(axis=1).mean())
        tours = np.array([known[pair] for pair in pairwise((*gait.states, gait.states[0]))])
        cells = [
            f"{cm:.2f}, {deg:.1f}"
            for cm, deg in (apart(motions(numbers, *steady(gait.states)), steps),
                            apart(tours, steps))
        ]  # fmt: skip
        print(f"| {gait.name} | {lengths} | {repeat:.2f} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
