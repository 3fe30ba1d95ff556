"""TerreSoRo-IV with a memory: a limb that curls has not done so when the next transition starts.

The hub and four contacts of `hub`, but how much limb k is curled, a_k, goes on: at the end of a
transition a limb that is to be curled still lacks the part `lag` of what it lacked before, and one
that uncurls has done so. Contacts lie between their places by a_k. One number more; it is fitted,
with the other eight, to single runs of transitions whose past is known (`memory`).
"""

import csv
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from studies import Array
from zoo.comparison import Predicted
from zoo.terresoro_iv.at_once import least_dissipation
from zoo.terresoro_iv.hub import (
    HERE,
    Gait,
    Numbers,
    gaits,
    jackknife,
    turned,
)

_PAST = 8  # states before a transition of a gait that count; 0.23 ** 8 is nothing


class Lagged(NamedTuple):
    """The fitted numbers: those of `hub.Numbers`, and the lag of curling [1]."""

    flat: float
    flat_angle: float
    curled: float
    curled_angle: float
    resting: float
    curling: float
    uncurling: float
    viscous: float
    lag: float = 0.0

    @property
    def hub(self) -> Numbers:
        """The numbers but for the lag."""
        return Numbers(*self[:-1])


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


def moved(curled: Sequence[Array], bounds: Array, numbers: Lagged) -> Array:
    """Displacement in the hub's frame before and turn of many transitions, (N, 3) [cm, cm, deg].

    Args:
        curled: how much limbs are, at the beginning, perhaps between, and at the end of each
            transition, (N, 4) each, at equal times.
        bounds: of friction, (N, 4).
        numbers: places of contacts, and the viscous part.
    """
    flat, bent = numbers.hub.places
    film = bounds * np.exp(numbers.viscous) * (len(curled) - 1)
    places = [flat + (bent - flat) * one[..., None] for one in curled]
    shift, turn = np.zeros((len(bounds), 2)), np.zeros(len(bounds))
    for at, to in pairwise(places):
        motion = least_dissipation(bounds, film, 0.5 * (at + to), to - at)
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
    return moved(curled, numbers.hub.bounds(past[:, -1], after), numbers)


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
    with (HERE / "recut_gaits.csv").open(encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    columns = ("dx [cm]", "dy [cm]", "turn [deg]"), ("dx_sd [cm]", "dy_sd [cm]", "turn_sd [deg]")
    return [
        Gait(line["gait"], states[line["gait"]], int(line["cycles"]),
             *(np.array([float(line[name]) for name in names]) for names in columns))
        for line in lines
    ]  # fmt: skip


def recut() -> tuple[list[tuple[str, str]], Array]:
    """Pairs of states and means of their runs, cut where the robot moves, (240, 3)."""
    with (HERE / "recut.csv").open(encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    names = ("dx [cm]", "dy [cm]", "turn [deg]")
    pairs = [(line["from_limbs"], line["to_limbs"]) for line in lines]
    return pairs, np.array([[float(line[name]) for name in names] for line in lines])


def remembered(form: str = "lag of curling") -> tuple[Array, Array]:
    """Numbers of a form of memory fitted to all runs, (F,), and with parts left out, (8, F)."""
    with (HERE / "remembered.csv").open(encoding="utf-8") as file:
        lines = [line for line in csv.DictReader(file) if line["form"] == form]
    values = np.array([[float(x) for x in line["values"].split()] for line in lines])
    return values[0], values[1:]


def predicted() -> dict[str, Predicted]:
    """Distance and turn of the five gaits, which no fit has seen; the error by the jackknife."""
    values, left_out = remembered()
    found = {}
    for gait in recut_gaits():
        value, *others = (cycle(gait.states, Lagged(*row)) for row in (values, *left_out))
        errors = jackknife(np.array(others))
        found[f"gait {gait.name}, distance"] = Predicted(value[0], errors[0])
        found[f"gait {gait.name}, turn"] = Predicted(value[1], errors[1])
    return found
