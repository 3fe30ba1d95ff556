"""TerreSoRo-IV as a robot of limbs, laid so that their tips are where the hub's contacts are.

A hub on four limbs at quarter turns, which bend in upright planes and stand on their tips: arches
as long as the robot's limbs are on photographs, so bent at rest that curling moves a tip from the
contact of a flat limb to that of a curled one (`model`) without lifting the hub. Shapes and
contacts are `analytic`'s, for weak friction; the motion is by least dissipation for many
transitions at once. Nothing is fitted here; `scenes` hands the robot to the product's own models.
"""

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.optimize import fsolve

from analytic import Robot
from analytic.scene.actuator import Actuator
from analytic.scene.limbs import Limb, LimbedRobot
from analytic.solvers.limbs.contacts import Contacts
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.rest import Rest
from analytic.solvers.limbs.statics import Statics
from studies import Array
from zoo.terresoro_iv.hub import LIMBS, turned
from zoo.terresoro_iv.model import Lagged, amounts, steady, through, together

PEAK = 10e3  # Pa, chosen: a tendon has none
LENGTH = 0.13  # m, of a limb on photographs, from where it leaves the hub to its tip
WEIGHT, OF_HUB = 3.0, 0.5  # N, chosen; part that the hub has
RIGIDITY = 0.018  # N m^2, chosen: so soft that all four tips stay on the ground
TIP_FORCE = 0.005  # N, chosen: bound of a tip, so weak that friction hardly bends limbs
WIDTH = 0.02  # m, chosen; the hub, in the air, is a square
HUB_RIGIDITY = 1.0  # N m^2, chosen: stiff
ELEMENTS, STEPS = 6, 2  # hinges of a limb, steps of a transition
_BENDS = (1.9, 2.7)  # rad, near those of flat and curled limbs
_ROUNDS = 10  # in which they are found under the weight
_RISE = 8  # states on the way to rest


class Laid(NamedTuple):
    """Where limb 1 is, in the hub's frame, and how it bends.

    Attributes:
        begin: where it begins, (2,) [cm].
        out: direction of its upright plane [rad].
        flat, curled: angles by which a limb bends that is called flat, and curled, free [rad].
    """

    begin: Array
    out: float
    flat: float
    curled: float

    @property
    def axis(self) -> float:
        """Direction of the tree's trunk, so that limbs begin at corners of a square [rad]."""
        return float(np.arctan2(self.begin[1], self.begin[0])) + 0.25 * np.pi

    def pressures(self, curled: Array) -> Array:
        """Pressures in the hub and the limbs by how much these are curled, (..., 4) to (..., 5)."""
        parts = (self.flat + (self.curled - self.flat) * curled) / self.curled
        return PEAK * np.insert(parts, 0, 0.0, axis=-1)


def _reach(angle: float) -> float:
    return LENGTH * float(np.sin(angle)) / angle


def _height(angle: float) -> float:
    return LENGTH * float(1 - np.cos(angle)) / angle


def lay(numbers: Lagged) -> Laid:
    """Limbs whose tips are at the contacts while all are flat and while all are curled.

    As high then, too: an arc that bends by a reaches L sin(a) / a and is L (1 - cos(a)) / a high.
    What the weight changes is taken off in rounds.

    Raises:
        ValueError: no such limbs are found.
    """
    flat, curled = (places[0] for places in numbers.places)
    move = flat - curled
    draw, out = 0.01 * float(np.hypot(*move)), float(np.arctan2(move[1], move[0]))
    sag = np.zeros((2, 2))  # of flat and curled limbs, in reach and height [m]
    bends = np.array(_BENDS)
    for _ in range(_ROUNDS):

        def off(angles: Array, sag: Array = sag) -> tuple[float, float]:
            one, two = ((_reach(angle) + by[0], _height(angle) + by[1])
                        for angle, by in zip(angles, sag, strict=True))  # fmt: skip
            return one[0] - two[0] - draw, one[1] - two[1]

        bends, _, found, message = fsolve(off, bends, full_output=True)
        if found != 1:
            raise ValueError(f"no limbs of {LENGTH:g} m draw a tip by {draw:g} m: {message}")
        reach = _reach(bends[0]) + sag[0, 0]
        laid = Laid(flat - 100 * reach * np.array([np.cos(out), np.sin(out)]), out, *bends)
        stance = Stance(laid)
        for k, angle in enumerate(bends):
            tips, height = stance.tips(np.full(LIMBS, float(k)))
            along = 0.01 * (tips[0] - laid.begin) @ [np.cos(out), np.sin(out)]
            sag[k] = along - _reach(angle), height - _height(angle)
    return laid


def robot(laid: Laid) -> LimbedRobot:
    """The robot, its hub along x."""
    corner = 0.01 * float(np.hypot(*laid.begin)) / np.sqrt(2)
    curve = Actuator((0.0, PEAK), (0.0, laid.curled / LENGTH), (RIGIDITY, RIGIDITY))
    limb = Robot(length=LENGTH, width=WIDTH, segments=(1.0,), actuator=curve, peak_pressure=PEAK,
                 weight_per_length=(1 - OF_HUB) * WEIGHT / LIMBS / LENGTH)  # fmt: skip
    straight = Actuator((0.0, PEAK), (0.0, 0.0), (HUB_RIGIDITY, HUB_RIGIDITY))
    hub = Robot(length=2 * corner, width=2 * corner, segments=(1.0,), actuator=straight,
                weight_per_length=OF_HUB * WEIGHT / (2 * corner), peak_pressure=PEAK)  # fmt: skip
    limbs = [Limb("hub", hub)]
    for number in range(LIMBS):
        turn = -0.5 * np.pi * number
        begin = turned(np.array([corner, -corner]), turn)
        limbs.append(Limb(f"limb-{number + 1}", limb, "hub", "end" if begin[0] > 0 else "begin",
                          float(laid.out - laid.axis + turn), float(begin[1])))  # fmt: skip
    return LimbedRobot(tuple(limbs), PEAK)


class Stance:
    """Shapes of the robot on its tips; those at rest are kept."""

    def __init__(self, laid: Laid) -> None:
        self._laid = laid
        self._tree = Tree(robot(laid), ELEMENTS, 0)
        self._statics = Statics(self._tree, "linearized")
        self._finder = Contacts(self._tree)

    @cached_property
    def _rest(self) -> Rest:
        """All limbs flat, on the way from no pressure."""
        rest, flat = self._statics.flat(), self._laid.pressures(np.zeros(LIMBS))
        for part in np.linspace(0.0, 1.0, _RISE + 1)[1:]:
            rest = self._statics.equilibrium(part * flat, rest)
        return rest

    def tips(self, curled: Array) -> tuple[Array, float]:
        """Places of the tips in the frame of the hub, (4, 2) [cm], and its height [m].

        Args:
            curled: how much limbs are, (4,).

        Raises:
            ValueError: no shape is found, or a tip is in the air.
        """
        pressures = self._laid.pressures(curled)
        rest = self._statics.equilibrium(pressures, self._rest)
        contacts = {contact.limb: contact for contact in self._finder.find(rest, pressures)}
        if not rest.converged or sorted(contacts) != [1, 2, 3, 4]:
            raise ValueError(f"limbs that are curled by {curled} do not stand on four tips")
        middle, heading = hub_of(rest.nodes)
        places = [
            (100 * self._finder.weights([contacts[limb]]) @ rest.nodes[:, :2]).mean(axis=0)
            for limb in range(1, LIMBS + 1)
        ]
        along = turned(np.array(places) - 100 * middle[:2], self._laid.axis - heading)
        return along, float(middle[2])


def hub_of(nodes: Array) -> tuple[Array, float]:
    """Middle of the hub, (3,) [m], and its heading [rad], from all nodes (P, 3)."""
    half = len(nodes) // 2  # right edges, then left ones
    last = half // (LIMBS + 1) - 1
    corners = nodes[[0, half, last, half + last]]
    along = corners[2:].mean(axis=0) - corners[:2].mean(axis=0)
    return corners.mean(axis=0), float(np.arctan2(along[1], along[0]))


class Walker:
    """Motions of transitions by the limbs.

    Args:
        numbers: of `model`.
    """

    def __init__(self, numbers: Lagged) -> None:
        self._numbers = numbers
        self._stance = Stance(lay(numbers))
        self._known: dict[tuple[float, ...], Array] = {}

    def _tips(self, curled: Array) -> Array:
        key = tuple(np.round(curled, 9).tolist())
        if key not in self._known:
            self._known[key] = self._stance.tips(curled)[0]
        return self._known[key]

    def __call__(self, past: Array, after: Array, steps: int = STEPS) -> Array:
        """Displacement in the hub's frame before and turn of transitions, (N, 3) [cm, cm, deg].

        Args:
            past, after: states, see `model.amounts`.
            steps: of a transition.

        Raises:
            ValueError: see Stance.tips.
        """
        numbers = self._numbers
        begin, end = amounts(past, after, numbers.lag)
        parts = np.linspace(0.0, 1.0, steps + 1)[:, None]
        tips = np.array([
            [self._tips(curled) for curled in one + parts * (other - one)]
            for one, other in zip(begin, end, strict=True)
        ])  # fmt: skip
        viscous = numbers.factors(past[:, -1], after) * np.exp(numbers.viscous)
        return through(list(tips.swapaxes(0, 1)), np.ones_like(viscous), viscous)

    def cycle(self, states: Sequence[str], steps: int = STEPS) -> Array:
        """Distance [cm] and turn [deg] of a cycle of a gait that goes on and on."""
        return together(self(*steady(states), steps))
