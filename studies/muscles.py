"""Measured actuators against fitted ones: `python -m studies.muscles [--out docs]`.

Layouts of pneu-nets with the top third of their points left out; six actuators of one robot with a
point left out each, and by how much they differ; loops that an independent Prandtl-Ishlinskii model
makes, with noise. Prints the numbers of docs/muscles.md and draws docs/muscles.png.
"""

import argparse
import csv
from collections.abc import Iterator, Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from analytic.fitting.actuator import ActuatorFit, fit_actuator
from analytic.fitting.bench import Bench
from analytic.fitting.laws import LawName
from studies import Array
from studies.drawing import FONT, save

DATA = Path(__file__).parent / "data"
WITHIN = (1.0, 2.0, 3.0)  # deg
LOOPS = ((0.004, 0.03, 0.13), (0.02, 0.1, 0.2), (0.08, 0.25, 0.32))  # size, width and share [range]
NOISE = 0.005  # of the range
_SEEDS = 20
LAWS: tuple[LawName | None, ...] = (None, "quadratic", "power", "affine")


def layouts() -> dict[str, tuple[Array, Array]]:
    """Pressures [kPa] and angles [deg] of each layout."""
    points: dict[str, list[tuple[float, float]]] = {}
    with (DATA / "pneunet_bending.csv").open() as file:
        for name, pressure, angle in list(csv.reader(file))[1:]:
            points.setdefault(name, []).append((float(pressure), float(angle)))
    return {name: (np.array(part)[:, 0], np.array(part)[:, 1]) for name, part in points.items()}


def one_robot() -> tuple[list[str], Array, Array]:
    """Names of six actuators, their pressures (6, 4) [kPa], and the angles there, (4,) [deg]."""
    with (DATA / "pneunet_pressure_angle.csv").open() as file:
        rows = list(csv.reader(file))[1:]
    pressures = 100 * np.array([[float(cell) for cell in row[1:]] for row in rows])
    return [row[0] for row in rows], pressures, np.array([0.0, 30.0, 60.0, 90.0])


def without_top_third(
    p: Array, angle: Array, law: LawName | None = None
) -> tuple[ActuatorFit, float]:
    """A fit to all but the top third of the points, and its largest error at those [deg]."""
    kept = len(p) - len(p) // 3
    fit = fit_actuator([Bench("layout", p[:kept], angle[:kept], "deg")], law=law)
    return fit, float(np.abs(fit.bend(p[kept:]) - angle[kept:]).max())


def without_point(p: Array, angle: Array, left_out: int, law: LawName | None = None) -> float:
    """Error at a point that a fit has not seen [deg]."""
    kept = np.arange(len(p)) != left_out
    fit = fit_actuator([Bench("actuator", p[kept], angle[kept], "deg")], law=law)
    return float(abs(fit.bend(p[left_out]) - angle[left_out]))


def loop(width: float, share: float, seed: int) -> tuple[Array, Array]:
    """Pressures and bends of order 1 of two loops, one with a loop inside, and noise.

    By plays that stay within half a width of the pressure, as is usual; what they leave at rest is
    taken off.
    """
    corners = np.array([0.0, 1.0, 0.4, 0.8, 0.0, 1.0, 0.0])
    path = np.interp(np.linspace(0, 6, 361), np.arange(7), corners)
    state, acting = 0.5 * width, []
    for p in path.tolist():
        state = min(max(state, p - 0.5 * width), p + 0.5 * width)
        acting.append(p - share * (p - state) - 0.5 * share * width)
    x = np.array(acting)
    noise = np.random.default_rng(seed).normal(0.0, NOISE, len(x))
    return path, 1.3 * x - 0.3 * x**2 + noise


def lines() -> Iterator[str]:
    """Sentences of docs/muscles.md."""
    for law in LAWS:
        errors = np.array([without_top_third(*points, law)[1] for points in layouts().values()])
        counts = " / ".join(f"{(errors <= limit).sum()}" for limit in WITHIN)
        yield (f"top third left out, {law or 'law by the data'}: {counts} of {len(errors)} layouts "
               f"within {' / '.join(f'{limit:g}' for limit in WITHIN)} degrees")  # fmt: skip
    names, pressures, angle = one_robot()
    for law in LAWS:
        worst = [max(without_point(p, angle, left_out, law) for p in pressures)
                 for left_out in (1, 2)]  # fmt: skip
        yield (f"six actuators, {law or 'law by the data'}: a point left out at 30 degrees is "
               f"missed by {worst[0]:.1f} at most, at 60 degrees by {worst[1]:.1f}")  # fmt: skip
    fits = [fit_actuator([Bench(name, p, angle, "deg")])
            for name, p in zip(names, pressures, strict=True)]  # fmt: skip
    at = np.linspace(20.0, min(p.max() for p in pressures), 200)
    bends = np.array([fit.bend(at) for fit in fits])
    most = np.ptp(bends, axis=0)
    yield (f"they differ by {most.max():.1f} degrees at {at[most.argmax()]:.0f} kPa, "
           f"and by {np.abs(bends - bends.mean(axis=0)).max():.1f} from their mean")  # fmt: skip
    for size, width, share in LOOPS:
        loops = [Bench("loop", *loop(width, share, seed), "1") for seed in range(_SEEDS)]
        loop_fits = [fit_actuator([bench]) for bench in loops]
        one = [fit for fit in loop_fits if len(fit.play) == 1]
        inside = [all(number.interval[0] <= true <= number.interval[1]
                      for number, true in ((fit.numbers[2], width), (fit.numbers[3], share))
                      if number.interval) for fit in one]  # fmt: skip
        error = np.mean([abs(fit.play[0] * fit.share[0] / (width * share) - 1) for fit in one])
        yield (f"loops of {100 * size:g} % of the range, noise of {100 * NOISE:g} %: one play in "
               f"{len(one)} of {_SEEDS}, both numbers within their intervals in {sum(inside)}, the "
               f"gap {100 * error:.1f} % off on average")  # fmt: skip


def draw(path: Path) -> None:
    """Draw measured points and fitted curves of all three kinds."""
    with mpl.rc_context(FONT):
        figure = Figure(figsize=(10.5, 3.4), layout="constrained", dpi=130)
        left, middle, right = figure.subplots(1, 3)
        for number, (name, (p, angle)) in enumerate(list(layouts().items())[::11]):
            fit, _ = without_top_third(p, angle)
            kept, colour = len(p) - len(p) // 3, f"C{number}"
            at = np.linspace(0, p.max(), 100)
            left.plot(p[:kept], angle[:kept], "o", color=colour, ms=4, label=name)
            left.plot(p[kept:], angle[kept:], "o", color=colour, ms=4, mfc="white")
            left.plot(at, fit.bend(at), "-", color=colour, lw=1)
        left.set_title("open points were not fitted")
        names, pressures, angle = one_robot()
        for number, (name, p) in enumerate(zip(names, pressures, strict=True)):
            fit = fit_actuator([Bench(name, p, angle, "deg")])
            at = np.linspace(p.min(), p.max(), 100)
            middle.plot(p, angle, "o", color=f"C{number}", ms=4)
            middle.plot(at, fit.bend(at), "-", color=f"C{number}", lw=1, label=name)
        middle.set_title("six actuators of one robot")
        size, width, share = LOOPS[-1]
        p, bend = loop(width, share, 0)
        fit = fit_actuator([Bench("loop", p, bend, "1")])
        line = fit_actuator([Bench("loop", p, bend, "1")], law="affine", plays=0)
        right.plot(p, bend, ".", color="0.6", ms=3, label="made with noise")
        right.plot(p, fit.along(p), "-", color="C0", lw=1, label="quadratic, one play")
        right.plot(p, line.bend(p), "--", color="C1", lw=1, label="affine")
        right.set_title(f"a loop of {100 * size:g} % of the range")
        for axes, words in ((left, "angle [deg]"), (middle, "angle [deg]"),
                            (right, "bend over the largest")):  # fmt: skip
            axes.set_xlabel("pressure [kPa]" if axes is not right else "pressure over the highest")
            axes.set_ylabel(words)
            axes.legend(fontsize=7)
        save(figure, path)


def main(argv: Sequence[str] | None = None) -> None:
    """Print the numbers and draw the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("docs"))
    options = parser.parse_args(argv)
    for line in lines():
        print(line)
    draw(options.out / "muscles.png")


if __name__ == "__main__":
    main()
