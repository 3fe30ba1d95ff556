"""TerreSoRo-IV with a memory: a limb that curls has not done so when the next transition starts.

A hub and four contacts. A flat limb touches where its area has its centre in public photographs
(`outline`); a curled one elsewhere, and in between on the line from one to the other by how much
limb k is curled, a_k. At the end of a transition a limb that is to be curled still lacks the part
`lag` of what it lacked before, and one that uncurls has done so. Dry friction is alike at all
contacts, viscous friction is not. Seven numbers are fitted, to single runs of transitions whose
past is known (`memory`).
"""

import csv
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np

from studies import Array
from zoo.comparison import Predicted, Row
from zoo.deciding import errors
from zoo.terresoro_iv.at_once import least_dissipation
from zoo.terresoro_iv.hub import DATA, Gait, gaits, spread_places, turned
from zoo.terresoro_iv.outline import flat_place

FORM = "viscous by state"  # of memory and friction, see `forms`
SCALE = (1.0, 0.1, 0.3, 0.3, 0.3, 0.3, 0.1)  # by which the numbers may differ; chosen
_WIDE = 0.02  # of differences over a scale; wide, since laws have kinks
_PAST = 8  # states before a transition of a gait that count; 0.23 ** 8 is nothing


class Lagged(NamedTuple):
    """The fitted numbers.

    Attributes:
        curled, curled_angle: distance of a curled limb's contact from the hub's centre [cm], and
            its direction from the hub's x, of limb 1 [rad].
        resting, curling, uncurling: logarithms of the viscous resistance of a limb that stays
            curled, that curls and that uncurls, over that of one that stays flat [1].
        viscous: logarithm of the viscous resistance of a flat limb over its dry one, at a slip of
            1 cm in the time of a transition [1].
        lag: part of a curl that lacks after a transition [1].
    """

    curled: float
    curled_angle: float
    resting: float
    curling: float
    uncurling: float
    viscous: float
    lag: float = 0.0

    @property
    def places(self) -> tuple[Array, Array]:
        """Contacts of limbs that are flat, and curled, in the hub's frame, (4, 2) each [cm]."""
        return spread_places(*flat_place()), spread_places(self.curled, self.curled_angle)

    def factors(self, before: Array, after: Array) -> Array:
        """Resistances over that of a flat limb, by states 0 and 1, (..., 4)."""
        still = np.where(before == 1, np.exp(self.resting), 1.0)
        moving = np.exp(np.where(after == 1, self.curling, self.uncurling))
        return np.where(before == after, still, moving)


def amounts(past: Array, after: Array, lag: float, lag_back: float = 0.0) -> tuple[Array, Array]:
    """How much limbs are curled when a transition begins and when it ends, (N, 4) each.

    Args:
        past: states, oldest first, (N, P, 4), the oldest at rest.
        after: state to which it goes, (N, 4).
        lag, lag_back: part of the way that is left, of curling and of uncurling.
    """
    begin = past[:, 0].astype(float)
    for state in np.moveaxis(past[:, 1:], 1, 0):
        begin = state + np.where(state == 1, lag, lag_back) * (begin - state)
    return begin, after + np.where(after == 1, lag, lag_back) * (begin - after)


def moved(
    curled: Sequence[Array], dry: Array, viscous: Array, places: tuple[Array, Array]
) -> Array:
    """Displacement in the hub's frame before and turn of many transitions, (N, 3) [cm, cm, deg].

    Args:
        curled: how much limbs are, at the beginning, perhaps between, and at the end of each
            transition, (N, 4) each, at equal times.
        dry, viscous: bounds of friction, and resistances to a slip of 1 cm in a transition, (N, 4).
        places: of contacts of flat and of curled limbs, (4, 2) each [cm].
    """
    flat, bent = places
    return through([flat + (bent - flat) * one[..., None] for one in curled], dry, viscous)


def through(places: Sequence[Array], dry: Array, viscous: Array) -> Array:
    """Motions of hubs whose contacts go through places at equal times, (N, 3) [cm, cm, deg].

    Args:
        places: of the contacts in the frame of the hub, two or more, (N, 4, 2) each [cm].
        dry, viscous: see `moved`.
    """
    film = viscous * (len(places) - 1)
    shift, turn = np.zeros((len(dry), 2)), np.zeros(len(dry))
    for at, to in pairwise(places):
        motion = least_dissipation(dry, film, 0.5 * (at + to), to - at)
        angle = turn + 0.5 * motion[:, 2]
        c, s = np.cos(angle), np.sin(angle)
        shift[:, 0] += c * motion[:, 0] - s * motion[:, 1]
        shift[:, 1] += s * motion[:, 0] + c * motion[:, 1]
        turn += motion[:, 2]
    return np.column_stack([shift, np.degrees(turn)])


def motions(numbers: Lagged, past: Array, after: Array, parts: int = 1) -> Array:
    """Motions of transitions with a past, (N, 3), see `amounts` and `moved`."""
    begin, end = amounts(past, after, numbers.lag)
    curled = [begin + part / parts * (end - begin) for part in range(parts + 1)]
    factors = numbers.factors(past[:, -1], after)
    viscous = factors * np.exp(numbers.viscous)
    return moved(curled, np.ones_like(factors), viscous, numbers.places)


def steady(states: Sequence[str]) -> tuple[Array, Array]:
    """Pasts (T, 9, 4) and states after (T, 4) of the transitions of a gait that goes on and on."""
    each = np.array([[int(digit) for digit in state] for state in states])
    count = len(each)
    past = [[each[(k - back) % count] for back in range(_PAST, -1, -1)] for k in range(count)]
    return np.array(past), np.roll(each, -1, axis=0)


def together(steps: Array) -> Array:
    """Distance [cm] and turn [deg] of a cycle from the motions of its transitions, (T, 3)."""
    place, heading = np.zeros(2), 0.0
    for step in steps:
        place = place + turned(step[:2], np.radians(heading))
        heading += step[2]
    return np.array([np.hypot(*place), heading])


def cycle(states: Sequence[str], numbers: Lagged, parts: int = 1) -> Array:
    """Distance [cm] and turn [deg] of a cycle of a gait that goes on and on."""
    return together(motions(numbers, *steady(states), parts))


def recut_gaits() -> list[Gait]:
    """The five measured gaits, cut where they are walked (`tracks`)."""
    states = {gait.name: gait.states for gait in gaits()}
    with (DATA / "recut_gaits.csv").open(encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    columns = ("dx [cm]", "dy [cm]", "turn [deg]"), ("dx_sd [cm]", "dy_sd [cm]", "turn_sd [deg]")
    return [
        Gait(line["gait"], states[line["gait"]], int(line["cycles"]),
             *(np.array([float(line[name]) for name in names]) for names in columns))
        for line in lines
    ]  # fmt: skip


def recut() -> tuple[list[tuple[str, str]], Array]:
    """Pairs of states and means of their runs, cut where the robot moves, (240, 3)."""
    with (DATA / "recut.csv").open(encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    names = ("dx [cm]", "dy [cm]", "turn [deg]")
    pairs = [(line["from_limbs"], line["to_limbs"]) for line in lines]
    return pairs, np.array([[float(line[name]) for name in names] for line in lines])


def remembered(form: str = FORM) -> tuple[Array, Array]:
    """Numbers of a form of memory fitted to all runs, (F,), and with parts left out, (8, F)."""
    with (DATA / "remembered.csv").open(encoding="utf-8") as file:
        lines = [line for line in csv.DictReader(file) if line["form"] == form]
    values = np.array([[float(x) for x in line["values"].split()] for line in lines])
    return values[0], values[1:]


def covariance() -> Array:
    """Covariance of the fitted numbers, by kinds of transitions (`memory`), (7, 7)."""
    with (DATA / "covariance.csv").open(encoding="utf-8") as file:
        return np.array(list(csv.reader(file))[1:], dtype=float)


def slopes(function: Callable[[Array], Array], at: Array) -> Array:
    """Central differences of the values of a function by the seven numbers, (..., 7)."""
    steps = _WIDE * np.diag(SCALE)
    return np.stack([(function(at + step) - function(at - step)) / (2 * step.max())
                     for step in steps], axis=-1)  # fmt: skip


def cycles(values: Array) -> Array:
    """Distance [cm] and turn [deg] of a cycle of each of the five gaits, (5, 2)."""
    return np.array([cycle(gait.states, Lagged(*values)) for gait in gaits()])


def predicted() -> dict[str, Predicted]:
    """Distance and turn of the five gaits, which no fit has seen; errors by kinds."""
    values, _ = remembered()
    unsure = errors(covariance(), slopes(cycles, values).reshape(-1, len(values))).reshape(-1, 2)
    return {
        f"gait {gait.name}, {what}": Predicted(value[k], error[k])
        for k, what in enumerate(("distance", "turn"))
        for gait, value, error in zip(gaits(), cycles(values), unsure, strict=True)
    }


def draw(rows: list[Row], path: Path) -> None:
    """Draw the robot and its gaits."""
    from zoo.terresoro_iv import picture  # which draws limbs, that are laid by this module

    picture.draw(rows, path)
