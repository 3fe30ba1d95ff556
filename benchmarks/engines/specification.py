"""The two tasks of the benchmark, in plain numbers (SI); numpy alone.

docs/benchmark.md says in words what stands here. An engine may take the limbs as they are, or the
rigid links on hinges that `links` makes of them.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

Array = Any

GRAVITY = 9.81
WAIT, RAMP = 0.5, 16.0  # s, before the first ramp, and each of them
WAVE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1), (0, 0, 1), (0, 0, 0))
LEGS = ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))  # rear, then both, then front


@dataclass(frozen=True)
class Limb:
    """An elastic strip that bends in the upright plane along it, and neither twists nor stretches.

    Attributes:
        length, width: [m].
        mass: per length [kg/m].
        rigidity: D, bending moment over curvature [N m^2].
        bent: natural curvature at full pressure [1/m]; positive arches, ends down.
        chambers: of equal length along it, by their columns of the task's `pressed`; none if it
            never bends by itself.
        on: number of the limb that carries it; -1 for the trunk.
        at_end: whether it begins at the carrier's end, else at its beginning.
        angle: of its direction in plan to the trunk's, to the left [rad].
        offset: of its beginning to the left of the carrier's middle line [m].
    """

    length: float
    width: float
    mass: float
    rigidity: float
    bent: float
    chambers: tuple[int, ...]
    on: int = -1
    at_end: bool = True
    angle: float = 0.0
    offset: float = 0.0


@dataclass(frozen=True)
class Task:
    """A robot that lies flat on level ground, and the cycle that it walks.

    Attributes:
        name: of the task.
        limbs: the trunk first.
        pressed: part of the full pressure in each chamber at the knots, (K, C).
        friction: Coulomb's coefficient between ground and the free ends of limbs.
        friction_between: and everywhere else.
        in_plane: whether the robot moves in one upright plane.
        answer: displacement of the cycle over `length`, ahead; see docs/benchmark.md.
        doubt: of the answer, relative.
        length: that displacements are told by [m].
        damping: time constant of the bending's viscosity, moment D (kappa + damping kappa') [s].
    """

    name: str
    limbs: tuple[Limb, ...]
    pressed: tuple[tuple[float, ...], ...]
    friction: float
    friction_between: float
    in_plane: bool
    answer: float
    doubt: float
    length: float
    damping: float = 0.005

    @property
    def knots(self) -> Array:
        """Times of the knots, between which pressures are linear [s]."""
        return np.concatenate([[0.0], WAIT + RAMP * np.arange(len(self.pressed))])

    @property
    def duration(self) -> float:
        """Time at which the cycle ends; it begins after WAIT [s]."""
        return float(self.knots[-1])

    @property
    def pressures(self) -> Array:
        """Part of the full pressure in each chamber at `knots`, (K + 1, C)."""
        return np.array([self.pressed[0], *self.pressed], float)


@dataclass(frozen=True)
class Link:
    """A rigid link, a thin plate; x along it, y to the left, z up.

    Attributes:
        limb: number of the limb.
        parent: number of the link that carries it; -1 for the first.
        place: of its beginning in the parent's frame [m].
        angle: in plan to the parent's x, to the left [rad].
        length, width, mass: [m], [kg].
        stiffness: of the hinge at its beginning, about -y: an end turns up [N m/rad]; 0 if fixed.
        bend: rest angle of the hinge at full pressure of each chamber, (C,) [rad].
        pads: points of contact (x, y, coefficient of friction).
    """

    limb: int
    parent: int
    place: tuple[float, float]
    angle: float
    length: float
    width: float
    mass: float
    stiffness: float
    bend: Array
    pads: tuple[tuple[float, float, float], ...]


def link_lengths(limb: Limb, elements: int) -> Array:
    """Lengths of the N + 1 links that stand for N equal elements, by Simpson's weights [m].

    Raises:
        ValueError: not every chamber has an even number of elements.
    """
    pair = 2 * max(len(limb.chambers), 1)
    if elements % pair or elements < 1:
        raise ValueError(
            f"links must be a multiple of {pair} for every chamber to have an even number of them, "
            f"got {elements}"
        )
    weights = np.ones(elements + 1)
    weights[1:-1:2], weights[2:-1:2] = 4, 2
    return limb.length * weights / weights.sum()


def links(task: Task, elements: int) -> list[Link]:
    """The robot as rigid links, those of a limb after each other, carriers first.

    Args:
        task: whose robot.
        elements: hinges of each limb.
    """
    made: list[Link] = []
    ends: list[tuple[int, int]] = []  # numbers of the first and the last link of each limb
    carried = {(limb.on, limb.at_end) for limb in task.limbs}
    for number, limb in enumerate(task.limbs):
        h, lengths = limb.length / elements, link_lengths(limb, elements)
        sides = (0.0,) if task.in_plane else (-0.5 * limb.width, 0.5 * limb.width)
        begin = len(made)
        for k, length in enumerate(lengths.tolist()):
            bend = np.zeros(len(task.pressed[0]))
            parent, place, angle = len(made) - 1, (0.0, 0.0), 0.0
            if k:
                place = float(lengths[k - 1]), 0.0
            if k and limb.chambers:
                bend[limb.chambers[(k - 1) * len(limb.chambers) // elements]] = -limb.bent * h
            if not k and limb.on >= 0:
                parent = ends[limb.on][limb.at_end]
                place = made[parent].length if limb.at_end else 0.0, limb.offset
                angle = limb.angle - task.limbs[limb.on].angle
            free = not k and limb.on < 0 and (number, False) not in carried
            grips = [(0.0, task.friction if free else task.friction_between)]
            if k == elements:
                free = (number, True) not in carried
                grips.append((length, task.friction if free else task.friction_between))
            pads = tuple((x, y, grip) for x, grip in grips for y in sides)
            made.append(Link(number, parent, place, angle, length, limb.width, limb.mass * length,
                             limb.rigidity / h if k else 0.0, bend, pads))  # fmt: skip
        ends.append((begin, len(made) - 1))
    return made


def rest_angles(task: Task, chain: list[Link], times: Array) -> Array:
    """Rest angles of the hinges at times, (T, hinges) [rad]."""
    bend = np.array([link.bend for link in chain if link.stiffness])
    pressures = np.column_stack([np.interp(times, task.knots, column)
                                 for column in task.pressures.T])  # fmt: skip
    return pressures @ bend.T


_PLATE = 1.8e6 * 4e-3**3 / 12  # modulus and thickness of silicone [N m]

STRIP = Task(
    "strip",
    (Limb(0.130, 0.040, 2.0 / GRAVITY, _PLATE * 0.040, 29.57887, (0, 1, 2)),),
    WAVE, 0.2615385, 0.0, True, -0.1439, 0.001, 0.130,
)  # fmt: skip

_THIRD, _ANGLE, _TORSO, _LEG = 0.1357 / 3, float(np.deg2rad(20.0)), 0.0323, 0.0135
_REACH = _THIRD / float(np.cos(_ANGLE))
_BY_AREA = 0.035 / (_THIRD * _TORSO + 4 * _REACH * _LEG)  # 35 g in all [kg/m^2]


def _leg(rear: bool, left: int) -> Limb:
    """A leg that begins beside an end of the torso and runs away from it, left 1 or -1."""
    angle = np.pi - left * _ANGLE if rear else left * _ANGLE
    return Limb(_REACH, _LEG, _BY_AREA * _LEG, _PLATE * _LEG, 40.72378, (0 if rear else 1,), 0,
                not rear, angle, 0.5 * left * (_TORSO - _LEG))  # fmt: skip


QUADRUPED = Task(
    "quadruped",
    (
        Limb(_THIRD, _TORSO, _BY_AREA * _TORSO, _PLATE * _TORSO, 0.0, ()),
        _leg(True, 1), _leg(True, -1), _leg(False, 1), _leg(False, -1),
    ),
    LEGS, 0.37, 0.37, False, 0.0211, 0.03, 0.1357,
)  # fmt: skip

TASKS = {task.name: task for task in (STRIP, QUADRUPED)}
