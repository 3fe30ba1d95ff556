"""TerreSoRo-IV's single runs from its marker tracks: `python -m zoo.terresoro_iv.tracks FOLDER`.

FOLDER is demos/data/visualtracking of clfreeman7/Path_Planning (commit b9acea9), which states no
licence: it is read where it lies. Five tours go through all 240 transitions, one after the other,
so each run has a known past. Runs are cut where the robot starts to move, which is found in each
track; a tour whose track has lost transitions, or has one too many, is set right by the other four,
and axes are those of the hub, which was placed otherwise in each tour. Prints what was found and
writes the means, recut.csv, recut_blue.csv and recut_gaits.csv.
"""

import csv
import sys
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.io import loadmat

from studies import Array
from zoo.terresoro_iv.hub import DATA, LIMBS, turned

FRAMES = 13.5  # of a transition, 0.45 s at 30 per second


class Experiment(NamedTuple):
    """Five tours of a robot.

    Attributes:
        order: name of the file with the order of their states.
        first: number of each tour, and frame of the transition before its first.
        pixel: [cm].
    """

    order: str
    first: dict[int, int]
    pixel: float


# the orange robot, and the blue one with another frictional component, whose first frames are a
# transition later there (demo2_PrimitivesTest.m, demo_PrimitivesTest.m, README)
ORANGE = Experiment("state_order_2", {7: 76, 8: 286, 9: 257, 10: 404, 11: 808}, 0.23898)
BLUE = Experiment("state_order", {1: 193, 2: 129, 3: 247, 4: 350, 5: 303}, 0.2426)
GAITS = {"A": (607, 3), "B": (103, 5), "C": (176, 3), "D": (226, 2), "E": (368, 3)}  # first, states
# robot B stands still after its first cycle and starts again so many transitions after its first
AGAIN = {"B": 28}
CYCLES, PAST = 30, 4
_HEAD = ("dx [cm]", "dx_sd [cm]", "dy [cm]", "dy_sd [cm]", "turn [deg]", "turn_sd [deg]")
_BLOCK = 10  # transitions whose start is found together, and whose place in the tour is
_SKIPS, _NEAR = range(-3, 4), 6.0  # transitions, frames
_SCALE = np.array([0.8, 0.8, 5.0])  # cm, cm, degrees: what transitions differ by; chosen
_TURN_COUNTS = 8.0  # cm per radian, so that turning counts as motion


class Track(NamedTuple):
    """Places of the hub's centre, (F, 2) [cm], and its headings, (F,) [rad], by frame."""

    place: Array
    heading: Array


class Runs(NamedTuple):
    """Single runs of transitions.

    Attributes:
        past: states before, oldest first, the last is that from which it goes, (N, 1 + PAST, 4).
        after: state to which it goes, (N, 4).
        motion: displacement in the hub's frame before, and turn, (N, 3) [cm, cm, deg].
        tour: which tour it is of, (N,).
    """

    past: Array
    after: Array
    motion: Array
    tour: Array


def track(path: Path, pixel: float = ORANGE.pixel) -> Track:
    """The hub's motion from a file of markers and of the rotation that was found from them."""
    table = loadmat(path)["all_pt"]
    first = table[0, :24].reshape(8, 3).mean(axis=0)
    rotation = table[:, 36:45].reshape(-1, 3, 3).transpose(0, 2, 1)
    place = rotation @ first + table[:, 45:48]
    place[0] = first
    return Track(pixel * place[:, :2], np.unwrap(np.arctan2(rotation[:, 1, 0], rotation[:, 0, 0])))


def markers(frame: Array) -> Array:
    """Places of the eight markers in a frame, columns and rows of its pixels, (8, 2)."""
    return frame[:24].reshape(8, 3)[:, :2]


def axes(folder: Path, of: Experiment = ORANGE) -> Array:
    """By how much the hub was turned when each tour began, (5,) [rad].

    Over the mean of the orange robot's tours. Headings count from a tour's first frame, in which
    the hub was placed by hand. Its eight markers are at nearly equal angles.
    """
    each, orange = (
        np.array([axis(markers(loadmat(folder / f"Euler {tour}.mat")["all_pt"][0]))
                  for tour in some.first])
        for some in (of, ORANGE)
    )  # fmt: skip
    return np.asarray(each - orange.mean())


def axis(spokes: Array) -> float:
    """Mean direction of markers (8, 2) about their middle, within an eighth of a turn [rad]."""
    along = (spokes - spokes.mean(axis=0)) @ [1, 1j]
    return float(np.angle(((along / np.abs(along)) ** len(spokes)).mean())) / len(spokes)


def starts(of: Track, first: float, count: int, block: int = _BLOCK) -> Array:
    """Frames at which transitions begin and the last one ends, (count + 1,).

    In each block of them where two quiet frames are followed by two lively ones; near the block
    before, since a track drifts.
    """
    step = np.hypot(*np.diff(of.place, axis=0).T) + _TURN_COUNTS * np.abs(np.diff(of.heading))
    number, late, found = np.arange(count + 1), 0.0, np.empty(count + 1, dtype=int)
    for begin in range(0, count, block):
        here = number[begin : begin + block]
        offers = late + np.arange(-_NEAR, _NEAR + 0.1, 0.5)
        frames = [np.round(first + FRAMES * here + offer).astype(int) for offer in offers]
        rise = [(step[f] + step[f + 1] - step[f - 1] - step[f - 2]).sum() for f in frames]
        late = offers[int(np.argmax(rise))]
        found[begin:] = np.round(first + FRAMES * number[begin:] + late)
    return found


def motions(of: Track, frames: Array) -> Array:
    """Displacements in the frame of the hub before, and turns, between frames, (N, 3)."""
    rows = []
    for begin, end in pairwise(frames.tolist()):
        shift = turned(of.place[end] - of.place[begin], -of.heading[begin])
        rows.append([*shift, np.degrees(of.heading[end] - of.heading[begin])])
    return np.array(rows)


def lost(moves: list[Array], orders: Array) -> Array:
    """How many transitions each tour's track has lost before each block, (5, blocks).

    The number with which a block's motions are most like the medians of all tours; negative where
    the track has more of them than the order.
    """
    count = len(moves[0])
    known: dict[tuple[int, int], list[Array]] = {}
    for moved, order in zip(moves, orders, strict=True):
        for number in range(count):
            known.setdefault(tuple(order[number : number + 2]), []).append(moved[number])
    usual = {pair: np.median(rows, axis=0) for pair, rows in known.items()}
    found = np.empty((len(moves), count // _BLOCK), dtype=int)
    for tour, (moved, order) in enumerate(zip(moves, orders, strict=True)):
        for block in range(count // _BLOCK):
            here = np.arange(block * _BLOCK, (block + 1) * _BLOCK)
            misses = []
            for skip in _SKIPS:
                rows = here[(here + skip >= 0) & (here + skip < count)]
                like = np.array([usual[tuple(order[k + skip : k + skip + 2])] for k in rows])
                misses.append(float((np.abs(moved[rows] - like) / _SCALE).mean()))
            found[tour, block] = _SKIPS[int(np.argmin(misses))]
    return found


def runs(folder: Path, of: Experiment = ORANGE) -> Runs:
    """All runs but those in blocks where a track loses some, and the first of each tour."""
    orders = loadmat(folder / f"{of.order}.mat")[of.order].astype(int) - 1
    moves = []
    for tour, first in of.first.items():
        hub = track(folder / f"Euler {tour}.mat", of.pixel)
        moves.append(motions(hub, starts(hub, first + FRAMES - 1.5, orders.shape[1] - 1)))
    skips = lost(moves, orders)
    for moved, angle in zip(moves, axes(folder, of), strict=True):
        moved[:, :2] = turned(moved[:, :2], -angle)
    rows: list[tuple[Array, Array, Array, int]] = []
    for tour, order in enumerate(orders):
        states = (order[:, None] >> np.arange(LIMBS)[::-1]) & 1
        for number in range(1, len(order) - 1):
            block = number // _BLOCK
            skip = skips[tour, block]
            known = 0 < number + skip < len(order) - 1
            if skip != skips[tour, max(block - 1, 0)] or not known:
                continue
            at = number + skip
            past = states[np.maximum(np.arange(at - PAST, at + 1), 0)]
            rows.append((past, states[at + 1], moves[tour][number], tour))
    for tour, row in zip(of.first, skips, strict=True):
        last = row[-1]
        if last:
            begin = _BLOCK * (1 + int(np.flatnonzero(row != last)[-1]))
            print(
                f"tour {tour}: its track has {abs(last)} transitions "
                f"{'fewer' if last > 0 else 'more'} than its order from number {begin} on"
            )
    past, after, motion, tours = (np.array(column) for column in zip(*rows, strict=True))
    return Runs(past, after, motion, tours)


def gait(folder: Path, name: str) -> Array:
    """Cycles of a gait but the first, from the state that its name begins with, (29, 3)."""
    of, frames, states = _cut(folder, name)
    return motions(of, frames[::states])[1:]


def gait_steps(folder: Path, name: str) -> Array:
    """Transitions of the same cycles, (29, T, 3)."""
    of, frames, states = _cut(folder, name)
    return motions(of, frames).reshape(CYCLES, states, 3)[1:]


def _cut(folder: Path, name: str) -> tuple[Track, Array, int]:
    """A gait's track, the frames at which its transitions begin, and how many a cycle has."""
    first, states = GAITS[name]
    of = track(folder / f"Gait {name}.mat")
    begin = first + FRAMES - 1.5 + FRAMES * AGAIN.get(name, 0)
    return of, starts(of, begin, CYCLES * states, 2 * states), states


def write_means(of: Runs, path: Path) -> None:
    """Write means and standard deviations of the runs of each transition, and print the latter."""
    text = ["".join(map(str, state)) for state in (*of.past[:, -1], *of.after)]
    pairs = list(zip(text[: len(of.after)], text[len(of.after) :], strict=True))
    spread = []
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("from_limbs", "to_limbs", "repeats", *_HEAD))
        for pair in sorted(set(pairs)):
            here = of.motion[[one == pair for one in pairs]]
            sd = here.std(axis=0, ddof=1)
            spread.append(sd)
            cells = np.column_stack([here.mean(axis=0), sd]).ravel()
            writer.writerow((*pair, len(here), *(f"{x:.3f}" for x in cells)))
    print("runs of a transition differ by", np.sqrt((np.array(spread) ** 2).mean(axis=0)).round(2))


def main(folder: str) -> None:
    """Write the means."""
    write_means(runs(Path(folder)), DATA / "recut.csv")
    write_means(runs(Path(folder), BLUE), DATA / "recut_blue.csv")
    with (DATA / "recut_gaits.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("gait", "cycles", *_HEAD))
        for name in GAITS:
            here = gait(Path(folder), name)
            cells = np.column_stack([here.mean(axis=0), here.std(axis=0, ddof=1)]).ravel()
            writer.writerow((name, len(here), *(f"{x:.3f}" for x in cells)))


if __name__ == "__main__":
    main(*sys.argv[1:])
