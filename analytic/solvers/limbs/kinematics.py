"""A tree of limbs as rigid links: where its nodes are, and how they move with its joints.

Each limb is the chain of analytic.scene.chain: n hinges between n + 1 links with Simpson's weights.
The first link of a limb is clamped to the link that carries it.

Coordinates q: x, y and height of the trunk's beginning, its yaw (to the left, from where it first
points), pitch (up) and roll (left side up), then the hinges, trunk first; a hinge turns its plane's
outward direction up.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import link_lengths
from analytic.scene.limbs import TreeRobot

Array = NDArray[np.float64]

_EYE = np.eye(3)
_UP = np.array([0.0, 0.0, 1.0])
WHOLE = 6  # coordinates that belong to no hinge
HEIGHT = 2  # among them
IN_PLAN = (0, 1, 3)  # those that only friction resists: x, y and yaw


class Pose(NamedTuple):
    """The tree at one q.

    Attributes:
        nodes: places of the right edges of all vertices, then of the left ones, (P, 3) [m].
        axes, centres: of the joints, (Q, 3); of x, y and z the axis is their direction.
    """

    nodes: Array
    axes: Array
    centres: Array


class Tree:
    """The links of a robot.

    Args:
        robot: its limbs.
        elements: hinges of each limb, even.

    Attributes:
        limb, arclength: of each node, its place among the limbs, and from where it begins [m].
        weight: that hangs on each node [N].
        parent: joint that carries each joint, (Q,); of the first three the one before.
        carried: whether a joint moves a node, (P, Q).
        first: place of each limb's first hinge among the coordinates.
        starts: arclengths at which the links of each limb begin [m].
    """

    def __init__(self, robot: TreeRobot, elements: int) -> None:
        if elements < 2 or elements % 2:
            raise ValueError(f"elements must be even and at least 2, got {elements}")
        self.robot, self.elements = robot, elements
        count = WHOLE + elements * len(robot.limbs)
        self.first = [WHOLE + elements * i for i in range(len(robot.limbs))]
        self.parent = np.arange(-1, count - 1)
        self._lengths = [link_lengths(limb.strip, elements) for limb in robot.limbs]
        self.starts = [np.append(0.0, np.cumsum(lengths)[:-1]) for lengths in self._lengths]
        self._direction = robot.limbs[0].angle
        self._turns = [_turn(_UP, limb.angle - self._heading(limb.on)) for limb in robot.limbs]
        self._places = [-1 if limb.on is None else robot.place(limb.on) for limb in robot.limbs]
        weight, arclength = [], []
        for i, limb in enumerate(robot.limbs):
            quarter = 0.25 * self._lengths[i] * limb.strip.weight_per_length  # an end, an edge
            weight += [np.append(quarter, 0.0) + np.append(0.0, quarter)]
            along = np.append(0.0, np.cumsum(self._lengths[i]))
            along[-1] = limb.strip.length  # to the last digit: a tip is at no distance from its end
            arclength += [along]
            self.parent[self.first[i]] = self._root(i)
        self.weight: Array = np.concatenate(2 * weight)
        self.arclength: Array = np.concatenate(2 * arclength)
        self.limb = np.tile(np.repeat(np.arange(len(robot.limbs)), elements + 2), 2)
        # a joint is above another if it is on the way from the trunk to it; and above itself
        above = np.eye(count, dtype=bool)
        for joint in range(count):
            if self.parent[joint] >= 0:
                above[joint] |= above[self.parent[joint]]
        self.above = above
        carrier = []
        for i in range(len(robot.limbs)):
            root = self._root(i)
            carrier += [root, root, *range(self.first[i], self.first[i] + elements)]
        self.carrier = np.array(2 * carrier)
        self.carried = above[self.carrier]

    def _root(self, limb: int) -> int:
        """The joint that moves the beginning of a limb."""
        on = self.robot.limbs[limb].on
        if on is None:
            return WHOLE - 1
        carrier = self.robot.place(on)
        if self.robot.limbs[limb].at == "end":
            return self.first[carrier] + self.elements - 1
        return self._root(carrier)

    def pose(self, q: Array) -> Pose:
        """Places of nodes and joints."""
        axes, centres = np.zeros((len(q), 3)), np.zeros((len(q), 3))
        base = np.array(q[:3])
        axes[:3], axes[3] = _EYE, _UP
        headed = _turn(_UP, self._direction + q[3])
        axes[4] = -headed[:, 1]
        pitched = _turn(axes[4], q[4]) @ headed
        axes[5] = pitched[:, 0]
        centres[:WHOLE] = base
        frame = _turn(axes[5], q[5]) @ pitched
        per_limb = self.elements + 2
        right, left = np.empty((2, per_limb * len(self.robot.limbs), 3))
        ends: list[dict[str, tuple[Array, Array]]] = []
        for i, limb in enumerate(self.robot.limbs):
            start, carried = base, frame
            if limb.on is not None:
                start, carried = ends[self._places[i]][limb.at]
            start = start + limb.offset * carried[:, 1]
            own = carried @ self._turns[i]
            side = own[:, 1]
            # in its plane: directions of the links from the sum of the hinges
            turn = np.zeros(self.elements + 1)
            np.cumsum(q[self.first[i] : self.first[i] + self.elements], out=turn[1:])
            along = np.stack([np.cos(turn), np.sin(turn)], axis=1) @ own[:, ::2].T
            places = np.empty((per_limb, 3))
            places[0] = 0.0
            np.cumsum(self._lengths[i][:, None] * along, axis=0, out=places[1:])
            places += start
            edge = 0.5 * limb.strip.width * side
            here = slice(i * per_limb, (i + 1) * per_limb)
            right[here], left[here] = places - edge, places + edge
            hinges = slice(self.first[i], self.first[i] + self.elements)
            axes[hinges], centres[hinges] = -side, places[1:-1]
            out = np.cos(turn[-1]) * own[:, 2] - np.sin(turn[-1]) * own[:, 0]
            last = np.array([along[-1], side, out]).T
            ends.append({
                "begin": (start - limb.offset * carried[:, 1], own),
                "end": (places[-1], last),
            })  # fmt: skip
        return Pose(np.concatenate([right, left]), axes, centres)

    def _heading(self, on: str | None) -> float:
        carrier = 0 if on is None else self.robot.place(on)
        return self.robot.limbs[carrier].angle

    def moves(self, pose: Pose, which: slice | NDArray[np.int_] = slice(None)) -> Array:
        """How places of nodes follow the coordinates, (P, 3, Q); of some nodes if so asked."""
        arm = pose.nodes[which, None] - pose.centres[None]
        (a, b, c), (x, y, z) = pose.axes.T, np.moveaxis(arm, 2, 0)
        moves = np.stack([b * z - c * y, c * x - a * z, a * y - b * x], axis=1)
        moves[..., :3] = pose.axes[:3].T
        return np.where(self.carried[which][:, None], moves, 0.0)

    def heights(self, pose: Pose) -> Array:
        """How heights of nodes follow the coordinates, (P, Q)."""
        arm = pose.nodes[:, None] - pose.centres[None]
        rise = pose.axes[:, 0] * arm[..., 1] - pose.axes[:, 1] * arm[..., 0]
        rise[:, :3] = pose.axes[:3, 2]
        return np.where(self.carried, rise, 0.0)

    def bending(self, pose: Pose, force: Array) -> Array:
        """Second derivatives of the sum of forces (P, 3) times places, (Q, Q).

        Of two joints the one nearer to the trunk, i, turns what the other, j, moves:
        f . (a_i x (a_j x r)) = (a_i . r)(f . a_j) - (f . r)(a_i . a_j).
        """
        arm = pose.nodes[:, None] - pose.centres[None]  # (P, Q, 3)
        arm = np.where(self.carried[..., None], arm, 0.0)
        moment = (arm.reshape(len(arm), -1).T @ force).reshape(-1, 3, 3)
        trace = moment[:, 0, 0] + moment[:, 1, 1] + moment[:, 2, 2]
        turned = (moment @ pose.axes[..., None])[..., 0] - trace[:, None] * pose.axes
        inner = pose.axes @ turned.T  # (i, j)
        inner[:3], inner[:, :3] = 0.0, 0.0
        upper = np.where(self.above.T, inner, 0.0)
        return np.asarray(upper + np.tril(upper.T, -1) * (~self.above.T))

    def points(self, limbs: Sequence[int], at: Sequence[float]) -> Array:
        """Weights of the nodes in points of the limbs' middle lines, (C, P).

        Args:
            limbs: of each point, (C,).
            at: arclength of each, (C,) [m].
        """
        half, per_limb = len(self.weight) // 2, self.elements + 2
        weights = np.zeros((len(at), 2 * half))
        for row, (limb, place) in enumerate(zip(limbs, at, strict=True)):
            own = self.arclength[limb * per_limb : (limb + 1) * per_limb]
            link = int(np.clip(np.searchsorted(own, place, side="right") - 1, 0, per_limb - 2))
            part = (place - own[link]) / (own[link + 1] - own[link])
            for edge in (0, half):
                node = edge + limb * per_limb + link
                weights[row, node], weights[row, node + 1] = 0.5 * (1 - part), 0.5 * part
        return weights


def _turn(axis: Array, angle: float) -> Array:
    """Matrix of a rotation about a unit axis."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(_EYE + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)
