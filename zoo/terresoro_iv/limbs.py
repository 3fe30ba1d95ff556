"""TerreSoRo-IV as a robot of limbs, whose numbers `fit_limbs` finds.

A hub with four limbs at quarter turns, which bend in upright planes, rest on the ground by their
weight and lie flat or stand on their tips: shapes and contacts are `analytic`'s, for weak friction.
A tip that stays, that curls and that uncurls resist otherwise; the hub's underside slides. The
motion of the whole is by least dissipation at the contacts that were found, for many transitions at
once. Nine numbers, fitted to transitions alone; `scenes` hands them to the product's own models.
"""

import csv
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from analytic import Robot
from analytic.scene.actuator import Actuator
from analytic.scene.limbs import Limb, LimbedRobot
from analytic.solvers.limbs.contact_state import Contact
from analytic.solvers.limbs.contacts import Contacts
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.rest import Rest
from analytic.solvers.limbs.statics import Statics
from studies import Array
from zoo.terresoro_iv.at_once import least_dissipation
from zoo.terresoro_iv.hub import HERE, LIMBS, turned
from zoo.terresoro_iv.model import amounts, steady, together

PEAK = 10e3  # Pa, chosen: a tendon has none
WEIGHT, OF_HUB = 3.0, 0.5  # N, chosen: rigidity is fitted over it; part that the hub has
WIDTH, HUB_WIDTH = 0.02, 0.05  # m, chosen; the hub's underside slides
HUB_RIGIDITY = 1.0  # N m^2, chosen: stiff
ELEMENTS, STEPS = 4, 2  # hinges of a limb, steps of a transition
_POINTS = 24  # that a state has at most, with padding


class Numbers(NamedTuple):
    """The fitted numbers.

    Attributes:
        corner: half the side of the square of points where limbs begin [cm].
        angle: of the limb that begins at (corner, -corner) [rad].
        length: of a limb [cm].
        curl: angle by which a limb that is curled and free bends [rad].
        rigidity: logarithm of D over weight times corner squared, see WEIGHT [1].
        resting, curling, uncurling: logarithms of the bound of a tip that stays, of a limb that
            curls and that uncurls, over that of a limb that lies flat [1].
        lag: part of a curl that lacks after a transition [1].
    """

    corner: float
    angle: float
    length: float
    curl: float
    rigidity: float
    resting: float
    curling: float
    uncurling: float
    lag: float


def robot(numbers: Numbers) -> LimbedRobot:
    """The robot, its hub along x."""
    corner, length = 0.01 * numbers.corner, 0.01 * numbers.length
    rigid = float(np.exp(numbers.rigidity)) * WEIGHT * corner**2
    curve = Actuator((0.0, PEAK), (0.0, numbers.curl / length), (rigid, rigid))
    limb = Robot(length=length, width=WIDTH, segments=(1.0,), actuator=curve, peak_pressure=PEAK,
                 weight_per_length=(1 - OF_HUB) * WEIGHT / LIMBS / length)  # fmt: skip
    flat = Actuator((0.0, PEAK), (0.0, 0.0), (HUB_RIGIDITY, HUB_RIGIDITY))
    hub = Robot(length=2 * corner, width=HUB_WIDTH, segments=(1.0,), actuator=flat,
                weight_per_length=OF_HUB * WEIGHT / (2 * corner), peak_pressure=PEAK)  # fmt: skip
    limbs = [Limb("hub", hub)]
    for number in range(LIMBS):
        turn = -0.5 * np.pi * number
        begin = turned(np.array([corner, -corner]), turn)
        limbs.append(Limb(f"limb-{number + 1}", limb, "hub", "end" if begin[0] > 0 else "begin",
                          float(numbers.angle + turn), float(begin[1])))  # fmt: skip
    return LimbedRobot(tuple(limbs), PEAK)


class Courses(NamedTuple):
    """Contacts and moves of T transitions in S steps each, asked before and after each step.

    Attributes:
        tip: number of the limb of points of tips, -1 of flat limbs and of padding, (T, S, 2, P).
        share: of a limb's bound that each point has, 0 of padding, (T, S, 2, P).
        place, move: of the points, (T, S, 2, P, 2) [cm].
        middle: of the hub in the frame of the shapes, (T, S + 1, 2) [cm].
    """

    tip: Array
    share: Array
    place: Array
    move: Array
    middle: Array


def courses(of: LimbedRobot, begin: Array, end: Array) -> Courses:
    """What limbs do while they curl from one amount to another, (T, 4) each.

    Raises:
        ValueError: a shape is not found.
    """
    found = len(begin), STEPS, 2, _POINTS
    tip, share, place, move = (np.zeros((*found, *more)) for more in ((), (), (2,), (2,)))
    middle = np.empty((len(begin), STEPS + 1, 2))
    tip -= 1
    area = of.limbs[1].strip.length * of.limbs[1].strip.width
    known: dict[tuple[float, ...], Rest] = {}
    for row, (first, last) in enumerate(zip(begin, end, strict=True)):
        parts = np.linspace(0.0, 1.0, STEPS + 1)[:, None]
        pressures = PEAK * np.insert(first + parts * (last - first), 0, 0.0, axis=1)
        tree, rests = _rests(of, pressures, known)
        finder, last = Contacts(tree), tree.vertices[0].stop - 1
        for step, (one, two) in enumerate(pairwise(rests)):
            for which, state in enumerate((one, two)):
                contacts = finder.find(state, pressures[step + which])
                if not contacts:
                    continue
                count = sum(len(contact.at) for contact in contacts)
                here = row, step, which, slice(count)
                weights = finder.weights(contacts)
                before, after = (100 * weights @ rest.nodes[:, :2] for rest in (one, two))
                place[here], move[here] = before, after - before
                points = [_of_point(of, contact, area) for contact in contacts for _ in contact.at]
                tip[here], share[here] = np.transpose(points)
        for step, rest in enumerate(rests):
            half = len(rest.nodes) // 2  # right edges, then left ones
            hub = rest.nodes[[0, last, half, half + last], :2]
            middle[row, step] = 100 * hub.mean(axis=0)
    return Courses(tip.astype(int), share, place, move, middle)


def _of_point(of: LimbedRobot, contact: Contact, area: float) -> tuple[int, float]:
    """Which limb's tip a contact's points are of, -1 if none's, and their share of a bound."""
    if contact.limb > 0 and contact.length == 0.0:
        return contact.limb - 1, 1.0 / len(contact.at)
    width = of.limbs[contact.limb].strip.width if contact.limb else 0.0
    return -1, contact.length * width / area / len(contact.at)


def _rests(
    of: LimbedRobot, pressures: Array, known: dict[tuple[float, ...], Rest]
) -> tuple[Tree, list[Rest]]:
    """Shapes along pressures, the first one from lying flat, as it is known if it is.

    Three limbs that are curled may stand with the fourth on the ground or in the air: the path
    decides.
    """
    tree = Tree(of, ELEMENTS, 0)
    statics, key = Statics(tree, "linearized"), tuple(pressures[0].tolist())
    if key not in known:
        known[key] = _rest(statics, pressures[0], np.zeros_like(pressures[0]), statics.flat())
    rests = [known[key]]
    for before, row in pairwise(pressures):
        rests.append(_rest(statics, row, before, rests[-1]))
    return tree, rests


def _rest(statics: Statics, row: Array, before: Array, rest: Rest) -> Rest:
    """The shape at pressures from the one before, in few or many steps.

    Raises:
        ValueError: none is found.
    """
    for parts in (1, 4, 16):
        found = rest
        for part in range(1, parts + 1):
            found = statics.equilibrium(before + part / parts * (row - before), found)
        if found.converged:
            return found
    raise ValueError(f"no shape at {row.tolist()} Pa")


def moved(of: Courses, before: Array, after: Array, numbers: Numbers) -> Array:
    """Displacement of the hub's middle in its frame before, and turn, (T, 3) [cm, cm, deg].

    Args:
        of: contacts and moves of T transitions.
        before, after: states, (T, 4).
        numbers: of friction.
    """
    count = of.share[..., 0].size
    moves = np.where(after == 1, numbers.curling, numbers.uncurling)
    tips = np.where(before == after, numbers.resting, moves)
    each = np.arange(len(before))[:, None, None, None]
    bounds = of.share * np.exp(np.where(of.tip < 0, 0.0, tips[each, of.tip]))
    motion = least_dissipation(
        bounds.reshape(count, -1), np.zeros((count, _POINTS)), of.place.reshape(count, -1, 2),
        of.move.reshape(count, -1, 2),
    ).reshape(-1, STEPS, 2, 3).mean(axis=2)  # fmt: skip
    place, heading = np.zeros((len(motion), 2)), np.zeros(len(motion))
    for step in range(STEPS):
        place += _turned(motion[:, step, :2], heading)
        heading += motion[:, step, 2]
    shift = place + _turned(of.middle[:, -1], heading) - of.middle[:, 0]
    return np.column_stack([shift, np.degrees(heading)])


def _turned(plane: Array, angles: Array) -> Array:
    c, s = np.cos(angles), np.sin(angles)
    return np.column_stack([c * plane[:, 0] - s * plane[:, 1], s * plane[:, 0] + c * plane[:, 1]])


class Walker:
    """Motions by numbers, whose shapes are kept while geometry, rigidity and lag stay."""

    def __init__(self, past: Array, after: Array) -> None:
        self._past, self._after = past, after
        self._known: dict[tuple[float, ...], Courses] = {}

    def forget(self) -> None:
        """Let go of the shapes that are kept."""
        self._known.clear()

    def __call__(self, numbers: Numbers) -> Array:
        """See `moved`."""
        key = (*numbers[:5], numbers.lag)
        if key not in self._known:
            begin, end = amounts(self._past, self._after, numbers.lag)
            self._known[key] = courses(robot(numbers), begin, end)
        return moved(self._known[key], self._past[:, -1], self._after, numbers)


def known() -> tuple[Numbers, Array]:
    """The fitted numbers and their standard errors, (9,)."""
    with (HERE / "limbs.csv").open(encoding="utf-8") as file:
        value, error = ([float(x) for x in row[1:]] for row in list(csv.reader(file))[1:])
    return Numbers(*value), np.array(error)


def cycle(states: Sequence[str], numbers: Numbers) -> Array:
    """Distance [cm] and turn [deg] of a cycle of a gait that goes on and on."""
    return together(Walker(*steady(states))(numbers))
