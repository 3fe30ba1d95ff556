"""Shapes of a gecko of five bending limbs that lies flat and stands on two feet of a diagonal.

A torso, at either end of it a pair of legs; each limb is an inextensible elastica in the plane of
the ground, as stiff as the others, whose free shape is the arc that its pressure asks for. Two feet
are held where they stand and turn on their suction cups against a spring; the other legs keep their
free shapes. Along the line from one held foot through the torso to the other the moment is that of
the first cup and of one force: three numbers, found so that the second foot and its cup are where
they must be. Many robots and gaits at once: B of them.
"""

from typing import NamedTuple

import numpy as np

from studies import Array

ARCS = 10
"""arcs of a limb; 20 change turns by 0.2 degrees"""
LEGS = ("front left", "front right", "rear left", "rear right")
TORSO = 4
_SIDE = np.array([1, -1, 1, -1])  # on which a leg leaves the torso, left 1
_WAY = np.array([-1, 1, 1, -1])  # to which a leg turns that bends away from the middle, left 1
_RAMP, _STEPS, _CLOSE, _TINY = 8, 60, 1e-9, 1e-6
_LARGEST = np.array([0.3, 0.05, 0.05])  # change of the unknown in a step [rad, 1/cm]


class Gecko(NamedTuple):
    """Robots.

    Attributes:
        leg, torso: lengths [cm].
        grip: stiffnesses of the spring that a cup turns against, over that of a leg, its D over its
            length, (B,) [1].
    """

    leg: float
    torso: float
    grip: Array


class Posture(NamedTuple):
    """Places and headings of robots.

    Attributes:
        feet: complex places in the order of LEGS, (B, 4) [cm].
        tips: headings of the legs there, (B, 4) [rad].
        front: of the torso, complex, (B,) [cm].
        heading: from the torso's rear to its front, (B,) [rad].
        asked: angles of the four legs and of the torso if they were free, (B, 5) [rad].
    """

    feet: Array
    tips: Array
    front: Array
    heading: Array
    asked: Array


def free(of: Gecko, asked: Array) -> Posture:
    """Robots that nothing holds, the front of the torso at 0 and heading along x.

    Args:
        of: the robots.
        asked: angles of the four legs and of the torso, (B, 5), see Posture; a leg's is positive as
            it bends away from the middle of the robot, the torso's as it bows to the right.
    """
    turns = np.repeat(asked[:, :, None] / ARCS, ARCS, axis=2)
    return _posture(of, turns, np.zeros(len(asked)), np.zeros(len(asked)), asked)


def stepped(of: Gecko, before: Posture, held: tuple[int, int], asked: Array) -> Posture:
    """Postures of robots once their limbs have been given new angles.

    Args:
        of: the robots.
        before: where they are.
        held: the feet that are held, a front one and the rear one of the other side.
        asked: see free; they are reached in a straight line from those of before.

    Raises:
        ArithmeticError: a shape is not found.
    """
    unknown = np.zeros((len(asked), 3))
    for part in np.linspace(0, 1, _RAMP + 1):
        now = before.asked + part * (asked - before.asked)
        line = _Line(of, before, held, now)
        unknown = line.solved(unknown)
    return line.posture(unknown)


class _Line:
    """The line from a held front foot through the torso to a held rear foot.

    Unknown of each robot are the turn of the front foot and the force on the rear one, (B, 3) or
    several of them at once, (..., B, 3).
    """

    def __init__(self, of: Gecko, before: Posture, held: tuple[int, int], asked: Array) -> None:
        self._of, self._held, self._asked, self._before = of, held, asked, before
        one, other = held
        self._apart = before.feet[:, other] - before.feet[:, one]
        ways = np.array([-_WAY[one], 1, _WAY[other]])
        bends = ways * asked[:, [one, TORSO, other]] / ARCS
        self._turns = np.repeat(bends, ARCS, axis=1)
        self._pieces = np.repeat(np.array([of.leg, of.torso, of.leg]) / ARCS, ARCS)
        self._stiff = np.repeat(ARCS * of.leg / np.array([of.leg, of.torso, of.leg]), ARCS)
        self._corner = np.zeros(3 * ARCS)
        self._corner[ARCS] = -0.5 * np.pi * _SIDE[one]
        self._corner[2 * ARCS] = 0.5 * np.pi * _SIDE[other] - np.pi

    def solved(self, unknown: Array) -> Array:
        """Unknown that leave nothing over, by Newton's method from a guess."""
        beside = _TINY * np.concatenate([np.zeros((1, 3)), np.eye(3)])[:, None]
        for _ in range(_STEPS):
            left, *others = self._left(unknown + beside)
            if np.abs(left).max() < _CLOSE:
                return unknown
            slopes = np.stack([(other - left) / _TINY for other in others], axis=2)
            step = np.linalg.solve(slopes, left[:, :, None])[:, :, 0]
            over = np.abs(step / _LARGEST).max(axis=1, keepdims=True)
            unknown = unknown - step / np.maximum(over, 1)
        raise ArithmeticError(f"no shape on {[LEGS[foot] for foot in self._held]} is found")

    def posture(self, unknown: Array) -> Posture:
        """Robots of these unknown."""
        one, other = self._held
        turns, at, way = self._walk(unknown)
        bends = np.repeat(self._asked[:, :, None] / ARCS, ARCS, axis=2)
        bends[:, one] = -_WAY[one] * turns[:, ARCS - 1 :: -1]
        bends[:, TORSO] = turns[:, ARCS : 2 * ARCS]
        bends[:, other] = _WAY[other] * turns[:, 2 * ARCS :]
        front = self._before.feet[:, one] + at[:, ARCS - 1]
        ahead = way[:, ARCS - 1] - np.pi - 0.5 * np.pi * _SIDE[one]
        return _posture(self._of, bends, front, ahead, self._asked)

    def _left(self, unknown: Array) -> Array:
        """Residuals of the rear foot's place and of the cups' moments, (..., B, 3)."""
        other, grip = self._held[1], self._of.grip
        _, at, way = self._walk(unknown)
        gap = (at[..., -1] - self._apart) / self._of.leg
        cup = way[..., -1] - self._before.tips[:, other]
        cup -= 2 * np.pi * np.round(cup / (2 * np.pi))
        moment = grip * (unknown[..., 0] + cup) + _moment(unknown, self._apart)
        return np.stack([gap.real, gap.imag, moment / (1 + grip)], axis=-1)

    def _walk(self, unknown: Array) -> tuple[Array, Array, Array]:
        """Turns of the line's arcs, their ends from the front foot on, and headings there."""
        heading = self._before.tips[:, self._held[0]] + unknown[..., 0] + np.pi
        at = np.zeros(heading.shape, dtype=complex)
        first = self._of.grip * unknown[..., 0]
        rows: tuple[list[Array], ...] = ([], [], [])
        for k, piece in enumerate(self._pieces):
            heading = heading + self._corner[k]
            turn = self._turns[:, k]
            for _ in range(3):  # the moment is that at the middle of an arc, which bends by it
                middle = at + 0.5 * piece * np.exp(1j * (heading + 0.25 * turn))
                turn = self._turns[:, k] + (first + _moment(unknown, middle)) / self._stiff[k]
            at = at + piece * np.exp(1j * (heading + 0.5 * turn))
            heading = heading + turn
            for row, now in zip(rows, (turn, at, heading), strict=True):
                row.append(now)
        turns, ends, ways = (np.stack(row, axis=-1) for row in rows)
        return turns, ends, ways


def _moment(unknown: Array, place: Array) -> Array:
    """Moment of the force about the front foot, at a place from there."""
    return np.asarray(unknown[..., 2] * place.real - unknown[..., 1] * place.imag)


def _posture(of: Gecko, turns: Array, front: Array, ahead: Array, asked: Array) -> Posture:
    """Robots whose arcs turn by (B, 5, ARCS), from the front of the torso and its heading there."""
    rear, back = _end(front, ahead + np.pi, turns[:, TORSO], of.torso)
    feet, tips = np.empty((len(asked), 4), dtype=complex), np.empty((len(asked), 4))
    for leg in range(4):
        base, along = (front, ahead) if leg < 2 else (rear, back - np.pi)
        feet[:, leg], tips[:, leg] = _end(
            base, along + 0.5 * np.pi * _SIDE[leg], _WAY[leg] * turns[:, leg], of.leg
        )
    return Posture(feet, tips, front, np.angle(front - rear), asked)


def _end(begin: Array, heading: Array, turns: Array, length: float) -> tuple[Array, Array]:
    """Ends of limbs whose arcs turn by (B, ARCS), and headings there."""
    after = heading[:, None] + np.cumsum(turns, axis=1)
    return begin + length / ARCS * np.exp(1j * (after - 0.5 * turns)).sum(axis=1), after[:, -1]
