"""Kinematics and stiffness of the quadruped's limbs as rods, for nodewise.py."""

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

L, THIRD, ANGLE = 0.1357, 0.1357 / 3, np.deg2rad(20.0)  # m, m, rad
TORSO, LEG, THICK = 0.0323, 0.0135, 4e-3  # widths and thickness [m]
MODULUS, HEIGHT, FRACTION, PEAK = 1.8e6, 3.928e-3, 0.7, 7 * 6894.757293168  # Pa, m, 1, Pa
TIP, SHEAR = 0.034, 0.034 * 3 / (0.040 * 0.130)  # V0 [N] and V0 over a third of the strip [Pa]
GROUNDS = {"felt": (0.0, 1.0), "polyethylene": (0.5, 1.0), "gelatin": (1.0, 0.0)}
PASSIVE = 0.01  # part of the peak below which a limb has no pressure

LENGTHS = np.array([THIRD] + 4 * [THIRD / np.cos(ANGLE)])
WIDTHS = np.array([TORSO] + 4 * [LEG])
PER_AREA = 0.035 * 9.81 / float(LENGTHS @ WIDTHS)  # weight [N/m^2]
WEIGHT = 0.035 * 9.81
BEYOND = np.array([0, 0, 0, 1, 1])  # legs begin at the torso's beginning (rear) or end (front)
YAWS = np.array([0.0, np.pi - ANGLE, np.pi + ANGLE, ANGLE, -ANGLE])
OFFSETS = 0.5 * (TORSO - LEG) * np.array([0, 1, -1, 1, -1])
LEFT = np.array([0, 1, 0, 1, 0], dtype=bool)
STAGES = np.array([[0, 0, 0, 0, 0], [0, 1, 1, 0, 0], [1, 1, 1, 0, 0], [1, 0, 0, 1, 1],
                   [0, 0, 0, 1, 1], [0, 0, 0, 0, 0]], dtype=float)  # fmt: skip


class Case(NamedTuple):
    """Robot, ground, gait and division of one walk."""

    ground: str
    left: float
    twist: bool
    area: bool
    lateral: bool
    elements: int
    states: int


class Rods:
    """Kinematics and stiffness of the five limbs, N elements each.

    Coordinates: x, y, z, yaw, pitch, roll of the torso's beginning, then by limb, element and free
    strain, strain times the element's length.
    """

    def __init__(self, case: Case) -> None:
        n = self.n = case.elements
        self.step = LENGTHS / n
        self.strains = [1] + [0] * case.twist + [2] * case.lateral  # about left, ahead, up
        self.size = 6 + 5 * n * len(self.strains)
        # of half widths to the left: the middle line, or the middles of three strips alike wide
        self.lines = np.array([-2 / 3, 0.0, 2 / 3] if case.area else [0.0])
        shares = np.ones(n + 1)
        shares[[0, -1]] = 0.5
        self.share = self.step[:, None] * shares  # length of each node (5, n + 1)
        self.weight = PER_AREA * WIDTHS[:, None] * self.share
        ratio = THICK / WIDTHS
        series = sum(np.tanh(0.5 * np.pi * k / ratio) / k**5 for k in range(1, 40, 2))
        torsion = THICK**3 * WIDTHS / 3 * (1 - 192 / np.pi**5 * ratio * series)
        self.bend = MODULUS * WIDTHS * THICK**3 / 12
        rigid = {1: self.bend, 0: MODULUS / 3 * torsion, 2: MODULUS * THICK * WIDTHS**3 / 12}
        self.rigid = np.stack([rigid[a] for a in self.strains], axis=1)  # (5, S)
        self.moves = self._moves()

    def _moves(self) -> Array:
        """Mask of the nodes that a coordinate moves, (Q, 5, n + 1); later ones lie below."""
        n, moves = self.n, np.zeros((self.size, 5, self.n + 1), dtype=bool)
        moves[:6] = True
        block = moves[6:].reshape(5, n, len(self.strains), 5, n + 1)
        for limb, element in itertools.product(range(5), range(n)):
            block[limb, element, :, limb, element + 1 :] = True
            if limb == 0:
                block[0, element, :, BEYOND == 1] = True
        return moves

    def springs(self, pressures: Array) -> tuple[Array, Array]:
        """Stiffness and rest of all coordinates at parts of the peak pressure, (5,)."""
        rigid, rest = self.rigid.copy(), np.zeros((5, len(self.strains)))
        rigid[:, 0] += FRACTION * HEIGHT**3 * WIDTHS / 4 * PEAK * pressures
        rest[:, 0] = 6 * HEIGHT**2 * FRACTION / (MODULUS * THICK**3) * PEAK * pressures * self.step
        stiff = np.repeat((rigid / self.step[:, None])[:, None], self.n, axis=1)
        return (np.append(np.zeros(6), stiff),
                np.append(np.zeros(6), np.repeat(rest[:, None], self.n, axis=1)))  # fmt: skip

    def pose(self, q: Array, slopes: bool = True) -> tuple[Array, ...]:
        """Middle nodes and vectors to the left edge (5, n + 1, 3), and W, V of coordinates (Q, 3).

        All that is beyond a coordinate moves as dx = W x x + V.
        """
        n, count = self.n, len(self.strains)
        angles = np.zeros((5, n, 3))
        angles[..., self.strains] = q[6:].reshape(5, n, count)
        step = np.broadcast_to(self.step[:, None], (5, n))
        turns, ahead = exponential(angles, step)
        frames, places = np.empty((5, n + 1, 3, 3)), np.zeros((5, n + 1, 3))
        frames[:, 0] = np.eye(3)
        for e in range(n):
            frames[:, e + 1] = frames[:, e] @ turns[:, e]
            places[:, e + 1] = places[:, e] + (frames[:, e] @ ahead[:, e, :, None])[..., 0]
        yaw, pitch = about(2, q[3]), about(1, -q[4])
        base = yaw @ pitch @ about(0, q[5])
        places[0] = q[:3] + places[0] @ base.T
        frames[0] = base @ frames[0]
        for limb in range(1, 5):
            carrier = frames[0, n * BEYOND[limb]]
            origin = places[0, n * BEYOND[limb]] + OFFSETS[limb] * carrier[:, 1]
            turned = carrier @ about(2, YAWS[limb])
            places[limb] = origin + places[limb] @ turned.T
            frames[limb] = turned @ frames[limb]
        edge = 0.5 * WIDTHS[:, None, None] * frames[..., 1]
        if not slopes:
            return places, edge
        w, v = np.zeros((self.size, 3)), np.zeros((self.size, 3))
        v[:3] = np.eye(3)
        w[3], w[4], w[5] = (0, 0, 1), -yaw[:, 1], (yaw @ pitch)[:, 0]
        v[3:6] = -np.cross(w[3:6], q[:3])
        local_w, local_v = np.empty((5, n, count, 3)), np.empty((5, n, count, 3))
        for k, axis in enumerate(self.strains):
            nudged = angles.astype(complex)
            nudged[..., axis] += 1e-30j
            turn, along = exponential(nudged, step)
            spin = (turn.imag / 1e-30) @ turns.swapaxes(-1, -2)
            local_w[:, :, k] = np.stack([spin[..., 2, 1], spin[..., 0, 2], spin[..., 1, 0]], -1)
            local_v[:, :, k] = along.imag / 1e-30 - np.cross(local_w[:, :, k], ahead)
        local_w = local_w @ frames[:, :-1].swapaxes(-1, -2)
        local_v = local_v @ frames[:, :-1].swapaxes(-1, -2)
        local_v -= np.cross(local_w, places[:, :-1, None])
        w[6:], v[6:] = local_w.reshape(-1, 3), local_v.reshape(-1, 3)
        return places, edge, w, v


def about(axis: int, angle: float) -> Array:
    """Matrix of a turn about x, y or z."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    turn = np.eye(3)
    turn[j, j] = turn[k, k] = np.cos(angle)
    turn[k, j] = np.sin(angle)
    turn[j, k] = -turn[k, j]
    return turn


def exponential(angles: NDArray, step: Array) -> tuple[NDArray, NDArray]:
    """Turn and way ahead along elements of constant strain, by series in the angle squared."""
    s = (angles**2).sum(-1)[..., None, None]
    a = 1 - s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72 * (1 - s / 110))))
    b = 0.5 * (1 - s / 12 * (1 - s / 30 * (1 - s / 56 * (1 - s / 90 * (1 - s / 132)))))
    c = 1 / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72 * (1 - s / 110 * (1 - s / 156)))))
    x, y, z = np.moveaxis(angles, -1, 0)
    cross = np.stack([0 * x, -z, y, z, 0 * x, -x, -y, x, 0 * x], -1).reshape(*x.shape, 3, 3)
    square = cross @ cross
    return np.eye(3) + a * cross + b * square, step[..., None] * (
        np.array([1.0, 0.0, 0.0]) + (b * cross + c * square)[..., 0]
    )
