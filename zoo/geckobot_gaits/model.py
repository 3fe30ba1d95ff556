"""Turns and distances of GeckoBot vS11 by elastic limbs on cups that turn against a spring.

Angles are those that its authors command, no larger than those at which their calibration reaches
the largest pressure. Distances of straight gaits are fitted to nothing. Turns have one fitted
number, the stiffness of a cup over that of a leg: of each step length by the turns at the other
four. Their error is the root mean square of all turns that were left out so.
"""

import csv
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from studies import Array
from studies.drawing import FONT, save
from zoo.comparison import Predicted, Row
from zoo.geckobot_gaits.posture import Gecko, free, stepped

TURNS = Path(__file__).with_name("turns.csv")
LEG, TORSO = 9.1, 10.3  # cm, stated
LARGEST = np.array([137.9, 168.8, 129.1, 135.2, 104.4])  # deg at 1.1 bar, by their polynomials;
SMALLEST = np.array([0.0, 0.0, 0.0, 0.0, -100.7])  # legs in the order of LEGS, and the torso
STEPS = (50.0, 60.0, 70.0, 80.0, 90.0)  # deg
STEERING = (0.1, 0.3, 0.5)  # to either side
GRIPS = np.geomspace(1, 60, 8)  # over a leg's stiffness
_CYCLES = 4
DIAGONALS = (1, 2), (0, 3)  # of feet that are held, by turns


class Cycle(NamedTuple):
    """A cycle.

    Attributes:
        far: distance of the torso's front [cm].
        turn: to the left [deg].
    """

    far: Array
    turn: Array


def asked(step: Array, steering: Array) -> Array:
    """Angles of the legs and the torso that the authors' law of gaits commands, (B, 5) [rad]."""
    swing = 0.5 * (step + np.abs(step) * steering)
    one, other = (np.maximum(0, 45 + way * swing + step * steering) for way in (-1, 1))
    torso = step + np.abs(step) * steering
    angles = np.stack([one, other, one, other, torso], axis=-1)
    return np.radians(np.clip(angles, SMALLEST, LARGEST))


def cycle(grip: Array, step: Array, steering: Array) -> Cycle:
    """The last of a few cycles of gaits, of arrays of one shape.

    Args:
        grip: stiffness of a cup over that of a leg [1].
        step, steering: of the law of gaits, called q1 [deg] and q2 [1] by its authors.
    """
    grip, step, steering = np.broadcast_arrays(grip, step, steering)
    of = Gecko(LEG, TORSO, grip.ravel())
    poses = [asked(way * step.ravel(), steering.ravel()) for way in (1, -1)]
    now = free(of, poses[1])
    for _ in range(_CYCLES):
        before = now
        for held, pose in zip(DIAGONALS, poses, strict=True):
            now = stepped(of, now, held, pose)
    turn = np.angle(np.exp(1j * (now.heading - before.heading)))
    far = np.abs(now.front - before.front)
    return Cycle(far.reshape(grip.shape), np.degrees(turn).reshape(grip.shape))


def measured() -> Array:
    """Mean turns to the side that is steered to, (step lengths, steering) [deg]."""
    with TURNS.open(encoding="utf-8") as file:
        mean_turns = {
            (float(row["step [deg]"]), float(row["steering"])): float(row["turn [deg]"])
            for row in csv.DictReader(file)
        }
    return np.array(
        [[0.5 * (mean_turns[q1, -q2] - mean_turns[q1, q2]) for q2 in STEERING] for q1 in STEPS]
    )


@cache
def turns() -> CubicSpline:
    """Mean turns as those of `measured`, by the logarithm of the stiffness."""
    step, steering = np.meshgrid(STEPS, STEERING, indexing="ij")
    grips = GRIPS[:, None, None]
    left, right = (cycle(grips, step, way * steering).turn for way in (-1, 1))
    return CubicSpline(np.log(GRIPS), 0.5 * (left - right))


def fitted(rows: Sequence[int]) -> float:
    """Logarithm of the stiffness that fits the turns at some step lengths best."""
    chosen = measured()[list(rows)]
    span = float(np.log(GRIPS[0])), float(np.log(GRIPS[-1]))
    minimum = minimize_scalar(lambda x: np.sum((turns()(x)[list(rows)] - chosen) ** 2), span, span,
                            method="bounded")  # fmt: skip
    return float(minimum.x)


def left_out() -> tuple[Array, Array]:
    """Turns at each step length by the other four, and the stiffnesses that those have."""
    every = range(len(STEPS))
    logs = np.array([fitted([other for other in every if other != row]) for row in every])
    unseen = np.array([turns()(log)[row] for row, log in enumerate(logs)])
    return unseen, np.exp(logs)


def predicted() -> dict[str, Predicted]:
    """Turns that were left out [deg] and distances of straight gaits [cm] per cycle."""
    unseen, _ = left_out()
    off = float(np.sqrt(np.mean((unseen - measured()) ** 2)))
    far = cycle(GRIPS[-1], np.array(STEPS), np.zeros(len(STEPS))).far
    named = {f"step {q1:g}, straight": Predicted(float(far[i])) for i, q1 in enumerate(STEPS)}
    for i, q1 in enumerate(STEPS):
        for k, q2 in enumerate(STEERING):
            named[f"step {q1:g}, steered {q2:g}"] = Predicted(float(unseen[i, k]), off)
    return named


def draw(rows: list[Row], path: Path) -> None:
    """Draw distances and turns over the step length, measured and predicted."""
    with mpl.rc_context(FONT):
        figure = Figure(figsize=(8.4, 3.6), layout="constrained", dpi=110)
        straight, steered = figure.subplots(1, 2)
        whole = turns()(fitted(range(len(STEPS))))
        ends = [turns()(np.log(grip)) for grip in GRIPS[[0, -1]]]
        groups = {"straight": (straight, "black", None)} | {
            f"steered {q2:g}": (steered, f"C{k}", k) for k, q2 in enumerate(STEERING)
        }
        for name, (axes, colour, k) in groups.items():
            here = [row for row in rows if row.quantity.endswith(name)]
            errors = [np.nan_to_num(row.measured_error) for row in here]
            axes.errorbar(STEPS, [row.measured for row in here], errors, fmt="s", color=colour,
                          capsize=3, label=f"measured, {name}")  # fmt: skip
            if k is None:
                axes.plot(STEPS, [row.predicted for row in here], "C3o-",
                          label="predicted, nothing fitted")  # fmt: skip
            else:
                axes.fill_between(STEPS, ends[0][:, k], ends[1][:, k], color=colour, alpha=0.12,
                                  lw=0)  # fmt: skip
                axes.plot(STEPS, whole[:, k], color=colour, lw=1.2)
                axes.errorbar(np.array(STEPS) + 0.8, [row.predicted for row in here],
                              [row.predicted_error for row in here], fmt="o", mfc="white",
                              color=colour, capsize=2)  # fmt: skip
        straight.set_ylabel("distance per cycle [cm]")
        straight.set_ylim(0, None)
        steered.set_ylabel("turn per cycle [deg]")
        steered.set_title(
            "lines: one stiffness of cups for all; circles: the others' stiffness;\n"
            "shaded: cups from a leg's stiffness to 60 times that", fontsize=7.5,
        )  # fmt: skip
        for axes in (straight, steered):
            axes.set_xlabel("step length [deg]")
            axes.legend(fontsize=7.5, frameon=False)
        save(figure, path)


def main() -> None:
    """Print the fitted stiffnesses and how far turns that were left out are off."""
    unseen, grips = left_out()
    whole = fitted(range(len(STEPS)))
    published = measured()
    rows = {"all turns fitted": turns()(whole), "each step length left out": unseen,
            "cups as stiff as a leg": turns()(np.log(GRIPS[0])),
            "cups 60 times as stiff": turns()(np.log(GRIPS[-1]))}  # fmt: skip
    print(f"stiffness of a cup over that of a leg: {np.exp(whole):.2f}; with a step length left "
          f"out: {', '.join(f'{grip:.2f}' for grip in grips)}")  # fmt: skip
    print(f"rms of the turns: {np.sqrt(np.mean(published**2)):.1f} deg")
    for name, value in rows.items():
        print(f"{name}: off by {np.sqrt(np.mean((value - published) ** 2)):.2f} deg rms, "
              f"{np.abs(value - published).max():.1f} at most")  # fmt: skip


if __name__ == "__main__":
    main()
