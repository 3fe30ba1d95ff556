"""TerreSoRo-IV as a hub and four contacts that move in its frame.

Limb k, at a quarter turn to the right of limb k - 1, touches the ground at one place when it is
flat and at another when it is curled, both fixed in the hub's frame. While limbs curl and uncurl
their contacts go from one to the other along a line, and the hub moves so that the sum of the
bounds of the contacts times their slips is least. A resting flat limb has the bound 1. Where
friction is viscous too, half the resistance times the square of the slip is added. Lengths in cm.
"""

import csv
import math
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from analytic.friction.dissipation_in_plane import least_dissipation_in_plane
from studies import Array

HERE = Path(__file__).parent
DATA = HERE / "data"
LIMBS = 4
PARTS = 1  # steps of a transition; 6 change a gait by 0.003 cm and 0.03 degrees at most
FREE = {"dry": 7, "viscous": 7, "both": 8}  # numbers that are fitted, by kind of friction
Pair = tuple[str, str]  # states before and after, limb 1 first, as "0110"
Law = Callable[[Sequence[Pair]], Array]  # displacement (2,) [cm] and turn [deg] of each pair


class Numbers(NamedTuple):
    """The fitted numbers.

    Attributes:
        flat, curled: distance of a limb's contact from the hub's centre [cm].
        flat_angle, curled_angle: its direction from the hub's x, of limb 1 [rad].
        resting, curling, uncurling: logarithms of the bound of a limb that stays curled, that curls
            and that uncurls, over that of one that stays flat [1].
        viscous: logarithm of the viscous resistance over the bound, at a slip of 1 cm in the time
            of a transition [1]; none by default.
    """

    flat: float
    flat_angle: float
    curled: float
    curled_angle: float
    resting: float
    curling: float
    uncurling: float
    viscous: float = -math.inf

    @property
    def places(self) -> tuple[Array, Array]:
        """Contacts of limbs that are flat, and curled, in the hub's frame, (4, 2) each [cm]."""
        return (
            spread_places(self.flat, self.flat_angle),
            spread_places(self.curled, self.curled_angle),
        )

    def bounds(self, before: Array, after: Array) -> Array:
        """Bounds of friction over that of a flat limb, by states 0 and 1, (..., 4)."""
        still = np.where(before == 1, np.exp(self.resting), 1.0)
        moving = np.exp(np.where(after == 1, self.curling, self.uncurling))
        return np.where(before == after, still, moving)


def spread_places(distance: float, angle: float) -> Array:
    """Places of four limbs at quarter turns, of which the first is at an angle [rad], (4, 2)."""
    angles = angle - 0.5 * np.pi * np.arange(LIMBS)
    return distance * np.stack([np.cos(angles), np.sin(angles)], axis=1)


class Gait(NamedTuple):
    """A measured gait: states, cycles, and displacement [cm] and turn [deg] of a cycle with sd."""

    name: str
    states: tuple[str, ...]
    cycles: int
    mean: Array
    sd: Array


def transitions() -> tuple[list[Pair], Array]:
    """Pairs of states and what was measured, (240, 3) [cm, cm, deg]."""
    with (DATA / "transitions.csv").open(encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    pairs = [(line["from_limbs"], line["to_limbs"]) for line in lines]
    return pairs, np.array([[float(line[key]) for key in _COLUMNS] for line in lines])


_COLUMNS = ("dx [cm]", "dy [cm]", "turn [deg]")
_SDS = ("dx_sd [cm]", "dy_sd [cm]", "turn_sd [deg]")


def gaits() -> list[Gait]:
    """The five measured gaits."""
    with (DATA / "gaits.csv").open(encoding="utf-8") as file:
        return [
            Gait(line["gait"], tuple(format(int(n) - 1, "04b") for n in line["states"].split()),
                 int(line["cycles"]), np.array([float(line[key]) for key in _COLUMNS]),
                 np.array([float(line[key]) for key in _SDS])) for line in csv.DictReader(file)
        ]  # fmt: skip


def turned(plane: Array, angle: float) -> Array:
    """Vectors in the plane, (..., 2), turned to the left by an angle [rad]."""
    c, s = np.cos(angle), np.sin(angle)
    return plane @ np.array([[c, s], [-s, c]])


def smallest(pair: Pair) -> tuple[Pair, int]:
    """The first of the four alike pairs in order, and by how many limbs it is shifted."""
    shifted = [(tuple(s[k:] + s[:k] for s in pair), k) for k in range(LIMBS)]
    (before, after), shift = min(shifted)
    return (before, after), shift


def by_friction(numbers: Numbers, dry: bool = True, parts: int = PARTS) -> Law:
    """The law of least dissipation: dry and viscous friction by the numbers, or not the dry one."""
    known: dict[Pair, Array] = {}

    def law(pairs: Sequence[Pair]) -> Array:
        found = np.empty((len(pairs), 3))
        for row, pair in enumerate(pairs):
            alike, shift = smallest(pair)
            if alike not in known:
                known[alike] = _transition(alike, numbers, dry, parts)
            motion = known[alike]
            found[row] = *turned(motion[:2], -0.5 * np.pi * shift), motion[2]
        return found

    return law


def _transition(pair: Pair, numbers: Numbers, dry: bool, parts: int) -> Array:
    """Displacement of the hub [cm] in its frame before, and its turn [deg]."""
    before, after = (np.array([digit == "1" for digit in state]) for state in pair)
    flat, curled = numbers.places
    bounds = numbers.bounds(before, after)
    start, end = (np.where(state[:, None], curled, flat) for state in (before, after))
    film = bounds * np.exp(numbers.viscous) * parts
    bounds = bounds if dry else np.zeros(LIMBS)
    shift, turn = np.zeros(2), 0.0
    for part in range(parts):
        places = start + (part + 0.5) / parts * (end - start)
        motion = least_dissipation_in_plane(bounds, places, (end - start) / parts, film)
        shift = shift + turned(motion.shift, turn + 0.5 * motion.turn)
        turn += motion.turn
    return np.array([*shift, np.degrees(turn)])


def additive(pairs: Sequence[Pair], measured: Array) -> Law:
    """The law in which each limb that curls or uncurls adds a motion of its own: 6 numbers."""

    def columns(some: Sequence[Pair]) -> tuple[Array, Array]:
        plane, turn = np.zeros((len(some), 2, 4)), np.zeros((len(some), 2))
        for row, (before, after) in enumerate(some):
            for limb in range(LIMBS):
                change = int(after[limb]) - int(before[limb])
                if change:
                    way = 0 if change > 0 else 1
                    plane[row, :, 2 * way : 2 * way + 2] += turned(np.eye(2), -0.5 * np.pi * limb).T
                    turn[row, way] += 1
        return plane, turn

    plane, turn = columns(pairs)
    vectors = np.linalg.lstsq(plane.reshape(-1, 4), measured[:, :2].ravel(), rcond=None)[0]
    turns = np.linalg.lstsq(turn, measured[:, 2], rcond=None)[0]

    def law(some: Sequence[Pair]) -> Array:
        along, angle = columns(some)
        return np.column_stack([along @ vectors, angle @ turns])

    return law


def together(pairs: Sequence[Pair], measured: Array) -> Law:
    """The measured transitions themselves."""
    known = dict(zip(pairs, measured, strict=True))
    return lambda some: np.array([known[pair] for pair in some])


def cycle(states: Sequence[str], law: Law) -> Array:
    """Distance [cm] and turn [deg] of a cycle of a gait by a law."""
    pairs = list(zip(states, (*states[1:], states[0]), strict=True))
    place, heading = np.zeros(2), 0.0
    for motion in law(pairs):
        place = place + turned(motion[:2], np.radians(heading))
        heading += motion[2]
    return np.array([np.hypot(*place), heading])


def measured_cycles(some: Iterable[Gait]) -> tuple[Array, Array]:
    """Distance [cm] and turn [deg] of measured gaits, and their standard errors, (G, 2)."""
    means, errors = [], []
    for gait in some:
        distance = float(np.hypot(*gait.mean[:2]))
        along = np.hypot(*(gait.mean[:2] * gait.sd[:2])) / distance
        means.append([distance, gait.mean[2]])
        errors.append(np.array([along, gait.sd[2]]) / np.sqrt(gait.cycles))
    return np.array(means), np.array(errors)


def fitted(minimum: int = 0, law: str = "both") -> tuple[Numbers, Array]:
    """A fit to all transitions, and those with a part of them left out, (folds, 7 or 8).

    Under "dry" friction or "both" kinds. The misfit has two minima: 0 is the lower one.
    """
    with (DATA / "fitted.csv").open(encoding="utf-8") as file:
        lines = [
            line
            for line in csv.DictReader(file)
            if (line["law"], line["start"]) == (law, str(minimum))
        ]
    numbers = [Numbers(*(float(line[key]) for key in Numbers._fields)) for line in lines]
    return numbers[0], np.array([row[: FREE[law]] for row in numbers[1:]])


def jackknife(values: Array) -> Array:
    """Standard errors from values with a part left out each, (folds, ...)."""
    folds = len(values)
    return np.asarray(np.sqrt((folds - 1) / folds * ((values - values.mean(axis=0)) ** 2).sum(0)))


def clustered(slopes: Array, left: Array, kinds: Array) -> Array:
    """Covariance of fitted numbers where errors of rows of one kind share a cause, (F, F).

    The sandwich by clusters, which needs no choice of parts to leave out (Liang, Zeger 1986).

    Args:
        slopes: of what is fitted by the numbers, (N, F).
        left: what is left of each row, (N,).
        kinds: 0 to K - 1, (N,).
    """
    count = int(kinds.max()) + 1
    pulls = np.array([slopes[kinds == k].T @ left[kinds == k] for k in range(count)])
    bread = np.linalg.inv(slopes.T @ slopes)
    few = count / (count - slopes.shape[1])
    return np.asarray(few * bread @ (pulls.T @ pulls) @ bread)
