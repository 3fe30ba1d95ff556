"""A dielectric inchworm from 1 to 20 Hz: `python -m studies.inchworm FILE.png FILE.csv`.

That of Actuators 2022, 11(8), 227 (3.5 g, 110 mm long, 50 mm wide) goes ahead at 1 to 9 Hz and back
above 10 Hz, at 5 kV. Here it is a strip that is arched at rest and that a voltage makes flatter, on
two feet, under friction by load. What is not published is varied, one value at a time, about a set
that turns where it does: rigidity, curvature, amplitude, friction ahead and back of either foot,
shape and damping of the stroke. Rows that the table has are not walked again; all of them take
half an hour of CPU.
"""

import csv
import math
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from analytic import Gait, Robot, Surface
from analytic.locomotion import STANDSTILL
from analytic.scene.feet import Foot
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.results.record import record
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene
from mjsim.simulation.second_walks import doubts
from mjsim.simulation.simulation import simulate
from studies.drawing import FONT, save

LENGTH, WIDTH, MASS = 0.110, 0.050, 3.5e-3  # m, m, kg; published
PEAK = 1e3  # Pa; what stands for the voltage, which is off at the peak
FREQUENCIES = (2, 6, 8, 9, 10, 11, 13, 20)  # Hz
FINELY = (1, 3, 4, 5, 7, 12, 14, 16, 18)  # Hz, of the base besides
SPOKEN = (1, 6, 9, 10, 11)  # Hz, at which the run's own words are printed


@dataclass(frozen=True)
class Values:
    """Values that are not published.

    Attributes:
        rigidity: [N m^2].
        bend: of the strip at rest, all of it [rad].
        flat: part of that which the voltage leaves [1].
        rear: coefficient of the rear foot, ahead and back [1].
        front, front_back: of the front foot [1].
        arched: part of the period at rest, half of both changes included [1].
        change: part of the period that a change takes [1].
        damping: relaxation time of the joints [s].
    """

    rigidity: float = 3e-5
    bend: float = 3.3
    flat: float = 0.48
    rear: float = 0.85
    front: float = 0.5
    front_back: float = 2.0
    arched: float = 0.6
    change: float = 0.15
    damping: float = 1.5e-3


BASE = Values()
VARIED: dict[str, Sequence[float]] = {
    "rigidity": (1e-5, 2e-5, 5e-5, 1e-4, 3e-4),
    "bend": (2.8, 3.8),
    "flat": (0.3, 0.4, 0.56, 0.7),
    "rear": (0.5, 0.7, 1.0, 1.4),
    "front": (0.25, 1.0),
    "front_back": (1.0, 1.5, 3.0),
    "arched": (0.5, 0.7),
    "change": (0.3,),
    "damping": (5e-4, 5e-3),
}
FINER = ((24, 5e-4), (12, 2.5e-4), (24, 2.5e-4))  # links and time steps [s] of the base besides
SHOWN = {  # of these, in the figure
    "rigidity 2e-05": "rigidity 2e-5 N m²", "bend 2.8": "bent by 2.8 rad at rest",
    "flat 0.4": "voltage leaves 0.4 of that", "rear 0.5": "rear foot's friction 0.5",
    "front_back 1.5": "front foot's, back, 1.5", "damping 0.005": "damping time 5 ms",
}  # fmt: skip
_SURE = 2.0  # standard errors
LIGHTER = 10.0  # times less inertia, at the same weight; of 100 times the strip comes not to rest


class Case(NamedTuple):
    """One walk: a name of VARIED with its value or another word, and how it is walked.

    Attributes:
        varied, value: what differs from the base; "base", "numerics" or "inertia", and 0.
        frequency: [Hz].
        links, timestep: of the walk; timestep in s.
        lighter: times less inertia.
        slower: times as slow, as if the mass were its square times as small: joints relax so many
            times as slowly then, since their time counts by the period.
    """

    varied: str
    value: float
    frequency: float
    links: int = 12
    timestep: float = 5e-4
    lighter: float = 1.0
    slower: float = 1.0


class Outcome(NamedTuple):
    """Outcome of a walk.

    Attributes:
        status: of the walk.
        distance, error: mean of the second half of its cycles over L, and its standard error; NaN
            of one that failed.
        hop: height to which all of it leaves the ground [m].
    """

    status: str
    distance: float
    error: float
    hop: float


def cases() -> Iterator[Case]:
    """All walks."""
    for frequency in sorted((*FREQUENCIES, *FINELY)):
        yield Case("base", 0.0, frequency)
    for name, values in VARIED.items():
        for value in values:
            for frequency in FREQUENCIES:
                yield Case(name, value, frequency)
    for links, timestep in FINER:
        for frequency in (6, 8, 9, 10, 11):
            yield Case("numerics", 0.0, frequency, links, timestep)
    for frequency in (9, 10, 11, 20):
        yield Case("inertia", 0.0, frequency, timestep=2e-4, lighter=LIGHTER)
        yield Case("inertia", 0.0, frequency, slower=10.0)


def scene(values: Values, frequency: float, lighter: float = 1.0, cycles: int = 1) -> Scene:
    """The inchworm at a frequency [Hz], its inertia so many times as small at the same weight."""
    period = 1 / frequency
    change = values.change * period
    up, down = values.arched * period - change, (1 - values.arched) * period - change
    gait = Gait("voltage", ((1.0,), (values.flat,), (values.flat,), (1.0,), (1.0,)),
                (change, down, change, up))  # fmt: skip
    robot = Robot(
        length=LENGTH, width=WIDTH, mass=MASS, rigidity=values.rigidity, segments=(1.0,),
        curvature_per_pressure=values.bend / LENGTH / PEAK, peak_pressure=PEAK,
        rigidity_per_pressure=1e-12,  # which voltage does not change
        feet=(Foot(0, 0, values.rear), Foot(1, 1, values.front, values.front_back)),
    )  # fmt: skip
    ground = Surface("bench", friction=1.0, tip_friction=1.0)
    return Scene(robot, gait, ground, cycles, friction="coulomb", gravity=9.81 * lighter)


def walk(case: Case) -> Outcome:
    """Walk from rest for at least eight cycles and a second and a half."""
    values = replace(BASE, **{case.varied: case.value}) if case.varied in VARIED else BASE
    cycles = max(8, math.ceil(1.5 * case.frequency))
    damping = values.damping * case.slower
    numerics = Numerics(case.links, case.timestep, damping_time=damping, hop=0.1)
    what = scene(values, case.frequency / case.slower, case.lighter, cycles)
    return outcome(simulate(what, numerics))


def outcome(walked: Trajectory) -> Outcome:
    """Outcome of a walk, by the second half of its cycles."""
    numbers = measure(walked)
    if numbers is None:
        return Outcome(str(walked.status), math.nan, math.nan, math.nan)
    late = np.array(numbers.by_cycle[len(numbers.by_cycle) // 2 :])
    height = walked.line[walked.start :, :, 2].min(axis=1).max()
    return Outcome("ok", float(late.mean()), float(late.std() / math.sqrt(len(late))),
                   float(height))  # fmt: skip


def rows(path: Path) -> dict[Case, Outcome]:
    """Outcomes of all cases, those of the table first; each is written there as it comes."""
    outcomes: dict[Case, Outcome] = {}
    if path.exists():
        with path.open(newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                value, frequency, links, *more = (float(row[key]) for key in Case._fields[1:])
                case = Case(row["varied"], value, frequency, int(links), *more)
                outcomes[case] = Outcome(
                    row["status"], *(float(row[k]) for k in Outcome._fields[1:])
                )
    left = [case for case in cases() if case not in outcomes]
    with path.open("a", newline="", encoding="utf-8") as file, ProcessPoolExecutor() as pool:
        writer = csv.writer(file)
        if not outcomes:
            writer.writerow([*Case._fields, *Outcome._fields])
        for case, outcome in zip(left, pool.map(walk, left), strict=True):
            outcomes[case] = outcome
            writer.writerow([*case, *outcome])
            file.flush()
    return outcomes


def turn(by_frequency: dict[float, Outcome]) -> tuple[float, float] | None:
    """Frequencies between which it turns from ahead to back, each surely so; None if nowhere."""
    ahead = None
    for frequency, outcome in sorted(by_frequency.items()):
        sure = abs(outcome.distance) > max(_SURE * outcome.error, STANDSTILL)
        if sure and outcome.distance > 0:
            ahead = frequency
        elif sure and ahead is not None:
            return ahead, frequency
    return None


def table(outcomes: dict[Case, Outcome]) -> list[str]:
    """A line per set of values: distances per cycle over L, and where it turns."""
    lines = ["| | " + " | ".join(f"{f:g} Hz" for f in FREQUENCIES) + " | turns at |",
             "|---" * (len(FREQUENCIES) + 2) + "|"]  # fmt: skip
    for words, chosen in _sets(outcomes).items():
        cells = [_cell(chosen.get(frequency)) for frequency in FREQUENCIES]
        range_of_turn = turn(chosen)
        at = f"{range_of_turn[0]:g} to {range_of_turn[1]:g} Hz" if range_of_turn else "-"
        lines.append(f"| {words} | " + " | ".join(cells) + f" | {at} |")
    return lines


def _sets(outcomes: dict[Case, Outcome]) -> dict[str, dict[float, Outcome]]:
    """Outcomes by frequency, under the words of what differs from the base."""
    sets: dict[str, dict[float, Outcome]] = {}
    for case in cases():
        if case.varied == "numerics":
            words = f"{case.links} links, {1e3 * case.timestep:g} ms"
        elif case.varied == "inertia":
            words = f"inertia over {case.lighter * case.slower**2:g}"
        else:
            words = f"{case.varied} {case.value:g}" if case.varied in VARIED else "base"
        sets.setdefault(words, {})[case.frequency] = outcomes[case]
    return sets


def _cell(outcome: Outcome | None) -> str:
    if outcome is None:
        return ""
    return f"{outcome.distance:+.3f}" if outcome.status == "ok" else outcome.status


def said(frequency: float) -> str:
    """Notes of a run of the base, hops as low as runs allow by default."""
    numerics = Numerics(12, 5e-4, damping_time=BASE.damping)
    walked = simulate(scene(BASE, frequency, cycles=max(8, math.ceil(1.5 * frequency))), numerics)
    row = record(walked)
    notes = row["prediction_notes"] + doubts(walked, row)
    shift, predicted = row["displacement_over_L"], row["predicted_displacement_over_L"]
    numbers = "" if shift is None else f"{shift:+.4f} beside {predicted:+.4f}, "
    return f"{frequency:g} Hz: {numbers}{row['status']} ({'; '.join(notes)})"


def draw(outcomes: dict[Case, Outcome], theory: float, path: Path) -> None:
    """Distance over frequency: the base, less inertia, finer numerics, and other values."""
    plt.rcParams.update(FONT)
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.8), sharey=True,
                                         layout="constrained")  # fmt: skip
    sets = _sets(outcomes)
    base = sorted(sets["base"].items())
    for axes in (left, right):
        axes.errorbar([f for f, _ in base], [o.distance for _, o in base],
                      [_SURE * o.error for _, o in base], color="black", marker="o", markersize=3,
                      label="base", zorder=3)  # fmt: skip
        axes.axhline(0, color="0.7", linewidth=0.8, zorder=0)
        axes.axvspan(9, 10, color="0.9", zorder=0)
        axes.set_xlabel("frequency [Hz]")
    left.axhline(theory, color="C0", linestyle="dashed", label="quasi-static")
    for number, (links, timestep) in enumerate(FINER):
        words = f"{links} links, {1e3 * timestep:g} ms"
        _line(left, sets[words], words, f"C{number + 1}", "x")
    for words in (key for key in sets if key.startswith("inertia")):
        _line(left, sets[words], words, "C4" if words.endswith(" 10") else "C5", "s")
    for number, (words, told) in enumerate(SHOWN.items()):
        _line(right, sets[words], told, f"C{number}", ".")
    left.set_ylabel("distance per cycle over length")
    figure.suptitle("Ahead at few hertz, back at many: inertia turns it round (grey: as measured)",
                    fontsize=9.5)  # fmt: skip
    for axes in (left, right):
        axes.legend(frameon=False, fontsize=7)
    left.set_title("finer numerics; less inertia", fontsize=9)
    right.set_title("other values of what is not published", fontsize=9)
    save(figure, path, dpi=110, format="png")


def _line(axes: Axes, outcomes: dict[float, Outcome], words: str, color: str, marker: str) -> None:
    fine = sorted((f, o.distance) for f, o in outcomes.items() if o.status == "ok")
    axes.plot([f for f, _ in fine], [d for _, d in fine], marker, linestyle="-", linewidth=0.8,
              color=color, markersize=4, label=words)  # fmt: skip


def main() -> None:
    """Walk all, print a table and a run's words, and draw."""
    outcomes = rows(Path(sys.argv[2]))
    theory = float(reference(scene(BASE, 1.0)).displacement[0])
    print(*table(outcomes), sep="\n")
    print(f"quasi-static {theory:+.4f}")
    draw(outcomes, theory, Path(sys.argv[1]))
    for frequency in SPOKEN:
        print(said(frequency), flush=True)


if __name__ == "__main__":
    main()
