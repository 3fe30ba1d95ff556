"""Limbs that make a robot: pneu-nets that bend in upright planes of their own.

A limb is a strip of one or more segments, an analytic.Robot. It begins at one end of the limb that
carries it, or is the trunk, and runs away from there at an angle in plan. A strip is a robot of one
limb.
"""

from dataclasses import dataclass, field, replace
from itertools import accumulate
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from analytic.checks import file_word, is_number, one_of, positive
from analytic.scene import pneunet
from analytic.scene.actuator import Memory
from analytic.scene.gait import Gait
from analytic.scene.ground import LEVEL, Incline
from analytic.scene.robot import GRAVITY, Robot

Array = NDArray[np.float64]
End = Literal["begin", "end"]

_DIGITS = 9  # of such bends, so that rounding makes none larger than another
_STATES = 10  # of a ramp, to see a gait by how much it bends
_IN_LINE = 1e-9  # of its length, that a robot in one line is wide


@dataclass(frozen=True)
class Limb:
    """One pneu-net.

    Raises:
        ValueError: a value is out of its range; the message names it.
    """

    name: str
    """how gaits and files call it"""
    strip: Robot
    """its geometry, material, weight and segments, the first where the limb begins; its peak
    pressure is that of the robot"""
    on: str | None = None
    """limb that carries it; None for the trunk"""
    at: End = "end"
    """end of that limb where it begins"""
    angle: float = 0.0
    """of its direction in plan, from the ground's x to the left [rad]"""
    offset: float = 0.0
    """of its beginning to the left of the carrier's middle line [m]"""

    def __post_init__(self) -> None:
        file_word("name of a limb", self.name)
        one_of("at", self.at, ("begin", "end"))
        for name in ("angle", "offset"):
            if not is_number(getattr(self, name)):
                raise ValueError(f"{name} must be a finite number, got {getattr(self, name)!r}")


@dataclass(frozen=True)
class LimbedRobot:
    """A robot of several limbs, the trunk first; each is carried by one before it.

    Raises:
        ValueError: it is no tree of such limbs, two limbs or chambers have one name, the trunk has
            an offset, or the peak pressure is not positive.
    """

    limbs: tuple[Limb, ...]
    peak_pressure: float = field(default=Robot.peak_pressure)
    """that fractions of a gait are of [Pa]"""

    def __post_init__(self) -> None:
        object.__setattr__(self, "limbs", tuple(self.limbs))
        positive("peak_pressure", self.peak_pressure, "Pa")
        carriers: list[str] = []
        for limb in self.limbs:
            if limb.name in carriers:
                raise ValueError(f"limb {limb.name!r} is there twice")
            if (limb.on is None) != (not carriers):
                raise ValueError(f"limb {limb.name!r}: the first limb, and no other, is the trunk")
            if limb.on is not None:
                one_of(f"limb {limb.name!r}: on", limb.on, carriers)
            elif limb.offset:
                raise ValueError(
                    f"limb {limb.name!r}: the trunk has no carrier to be offset from, got "
                    f"{limb.offset!r}"
                )
            carriers.append(limb.name)
        if not carriers:
            raise ValueError("a robot must have one limb at least, got none")
        twice = next((name for name in self.chambers if self.chambers.count(name) > 1), None)
        if twice:
            raise ValueError(f"chamber {twice!r} is there twice: name a limb otherwise")

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the limbs, the trunk's first."""
        return tuple(limb.name for limb in self.limbs)

    @property
    def chambers(self) -> tuple[str, ...]:
        """Names of the chambers, limb by limb: the columns of a gait."""
        return tuple(
            limb.name if len(limb.strip.segments) == 1 else f"{limb.name}-{number}"
            for limb in self.limbs
            for number in range(1, len(limb.strip.segments) + 1)
        )

    @property
    def length(self) -> float:
        """Length along the trunk's direction, lying flat, L [m]."""
        return outline(self)[0]

    def place(self, name: str) -> int:
        """Index of a limb among them."""
        one_of("limb", name, self.names)
        return self.names.index(name)

    @property
    def outer(self) -> tuple[str, ...]:
        """Names of the limbs that carry none."""
        carriers = {limb.on for limb in self.limbs}
        return tuple(name for name in self.names if name not in carriers)

    @property
    def weight(self) -> float:
        """Weight of all limbs and what they carry [N]."""
        return sum(limb.strip.weight for limb in self.limbs)

    @property
    def payload_mass(self) -> float:
        """Mass of all that its limbs carry [kg]."""
        return sum(limb.strip.payload_mass for limb in self.limbs)


AnyRobot = Robot | LimbedRobot


def limbs_of(robot: AnyRobot) -> tuple[Limb, ...]:
    """The limbs of a robot, of which a strip is one."""
    return robot.limbs if isinstance(robot, LimbedRobot) else (Limb("strip", robot),)


def check_tethers(robot: LimbedRobot) -> None:
    """Raise ValueError for tethers that pull back, which is known along a line alone."""
    tethers = [limb.strip.tether for limb in robot.limbs if limb.strip.tether]
    most = max((tether.stiffness for tether in tethers), default=0.0)
    if most:
        raise ValueError(
            f"stiffness of a tether must be 0 for a robot of limbs, got {most:g} N/m: springs are "
            "known along a line alone"
        )


def chambers_by_limb(robot: AnyRobot) -> list[slice]:
    """Which of the chambers each limb has."""
    counts = [len(limb.strip.segments) for limb in limbs_of(robot)]
    ends = list(accumulate(counts))
    return [slice(end - count, end) for count, end in zip(counts, ends, strict=True)]


def memory(robot: AnyRobot) -> Memory:
    """Hysteresis of a robot's chambers, which are without pressure."""
    return Memory([actuator for limb in limbs_of(robot) for actuator in limb.strip.actuators])


def acting_pressures(robot: AnyRobot, path: Array) -> Array:
    """Pressures that act along a path of the chambers', (B, S) [Pa]; it rises from none at first.

    They are the path's own but where a robot's actuators have hysteresis.
    """
    return memory(robot).follow(path)


def as_bent(robot: Robot, gait: Gait) -> Gait:
    """A gait of how much segments bend, over what a rise to the peak does, in place of pressures.

    It is the gait itself by the affine law. Else its stages are many, and their times are none.
    """
    if robot.actuator is None:
        return gait
    rest, fractions = np.zeros((1, gait.segments)), gait.pressures(_STATES)
    bends, most = (
        pneunet.natural_curvature(robot, acting_pressures(robot, robot.peak_pressure * path))[1:]
        for path in (np.concatenate([rest, fractions]), np.concatenate([rest, rest + 1.0]))
    )
    # a segment that no pressure bends is at none of it throughout
    parts = np.divide(bends, most, out=np.zeros_like(bends), where=most != 0)
    parts = np.clip(np.round(parts, _DIGITS), -1.0, 1.0)
    return Gait(gait.name, tuple(map(tuple, parts.tolist())), 1.0, False)


def depth_first(robot: LimbedRobot, name: str | None = None) -> list[str]:
    """Names of the limbs as MuJoCo counts joints: a limb, those at its end, at its beginning."""
    name = robot.names[0] if name is None else name
    carried = [
        limb.name for at in ("end", "begin")
        for limb in robot.limbs if (limb.on, limb.at) == (name, at)
    ]  # fmt: skip
    return [name, *(part for limb in carried for part in depth_first(robot, limb))]


def plan(robot: LimbedRobot) -> dict[str, tuple[Array, Array]]:
    """Both ends of the middle line of each limb, lying flat, by its name, (2,) [m]."""
    ends: dict[str, tuple[Array, Array]] = {}
    for limb in robot.limbs:
        begin = np.zeros(2)
        if limb.on is not None:
            heading = robot.limbs[robot.place(limb.on)].angle
            begin = ends[limb.on][0 if limb.at == "begin" else 1]
            begin = begin + limb.offset * np.array([-np.sin(heading), np.cos(heading)])
        along = limb.strip.length * np.array([np.cos(limb.angle), np.sin(limb.angle)])
        ends[limb.name] = begin, begin + along
    return ends


def outline(robot: LimbedRobot) -> tuple[float, float]:
    """Length along the trunk and width across it, lying flat, between ends of middle lines [m]."""
    places = np.array([place for ends in plan(robot).values() for place in ends])
    along, across = np.ptp(places @ rotation(robot.limbs[0].angle), axis=0)
    return float(along), float(across)


def usual_twists(robot: AnyRobot, links: int, incline: Incline = LEVEL) -> int:
    """Twists of each limb unless their number is given.

    Half of its links, with which distances are as near to those of many as by the links themselves;
    none where limbs lie in one line that nothing rolls, as there is nothing to twist.

    Args:
        robot: its limbs.
        links: of each limb, even.
        incline: of the ground, which rolls what lies across it.
    """
    if not isinstance(robot, LimbedRobot):
        return 0
    length, width = outline(robot)
    across = incline.slope * np.sin(incline.uphill - robot.limbs[0].angle)
    return links // 2 if width > _IN_LINE * length or abs(across) > _IN_LINE else 0


def rotation(angle: float) -> Array:
    """Matrix of a turn to the left in plan, (2, 2)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


# the public finite-element mesh of this robot, SofaDefrost/ModelOrderReduction, multiGait
LENGTH, LEG_ANGLE, MASS = 0.1357, np.deg2rad(20.0), 0.035  # m, rad, kg
TORSO_WIDTH, LEG_WIDTH = 0.0323, 0.0135  # m

ORDER = ("torso", "rear-left", "rear-right", "front-left", "front-right")


def quadruped(base: Robot | None = None, angle: float = LEG_ANGLE) -> LimbedRobot:
    """The paper's robot: a torso and four legs, each a third of its length along the body.

    Args:
        base: thickness, chambers, modulus of all five; of the strip of [Majidi13] if None. The
            torso carries its payloads and drags its tether.
        angle: of each leg to the axis of the body [rad].
    """
    third = LENGTH / 3
    strip = replace(base or Robot(), segments=(1.0,))
    plan = third * TORSO_WIDTH + 4 * third / float(np.cos(angle)) * LEG_WIDTH
    by_area = MASS * GRAVITY / plan  # the silicone is as thick everywhere [N/m^2]
    torso = replace(strip, length=third, width=TORSO_WIDTH, weight_per_length=by_area * TORSO_WIDTH)
    leg = replace(strip, length=third / float(np.cos(angle)), width=LEG_WIDTH,
                  weight_per_length=by_area * LEG_WIDTH, payload=(),
                  tether=None)  # fmt: skip
    side = 0.5 * (TORSO_WIDTH - LEG_WIDTH)
    legs = [
        Limb(name, leg, "torso", "begin" if rear else "end",
             float((np.pi - left * angle) if rear else left * angle), float(left * side))
        for name, rear, left in zip(ORDER[1:], (True, True, False, False), (1, -1, 1, -1),
                                    strict=True)
    ]  # fmt: skip
    return LimbedRobot((Limb("torso", torso), *legs))


def as_strip(strip: Robot) -> LimbedRobot:
    """A strip of three segments as a torso with a leg before and one behind, to verify by.

    Raises:
        ValueError: it has feet, a payload or a tether, whose places are along the whole strip.
    """
    if strip.feet or strip.payload or strip.tether:
        raise ValueError(
            "a strip as limbs must have no feet, payload or tether; give the limbs theirs"
        )
    lengths = strip.length * np.diff(strip.borders)
    rear, middle, front = (replace(strip, length=float(part), segments=(1.0,)) for part in lengths)
    return LimbedRobot(
        (
            Limb("torso", middle),
            Limb("rear", rear, "torso", "begin", float(np.pi)),
            Limb("front", front, "torso", "end"),
        ),
        strip.peak_pressure,
    )
