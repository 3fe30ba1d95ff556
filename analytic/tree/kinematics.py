"""A tree of limbs as rigid links: where its nodes are, and how they move with its joints.

Each limb is the chain of analytic.chain: n hinges between n + 1 links with Simpson's weights. The
first link of a limb is clamped to the link that carries it. The whole may rise, pitch and roll; x,
y and yaw are friction's.

Coordinates q: height of the trunk's beginning, its pitch (up is positive) and roll (left side up is
positive), then the hinges, trunk first; a hinge turns its plane's outward direction up.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.chain import link_lengths
from analytic.tree.limbs import TreeRobot

Array = NDArray[np.float64]

WHOLE = 3  # coordinates that belong to no hinge


class Pose(NamedTuple):
    """The tree at one q.

    Attributes:
        nodes: places of the right edges of all vertices, then of the left ones, (P, 3) [m].
        axes, centres: of the joints, (Q, 3); of the height the first axis is its direction.
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
        weight, arclength = [], []
        for i, limb in enumerate(robot.limbs):
            quarter = 0.25 * self._lengths[i] * limb.strip.weight_per_length  # an end, an edge
            weight += [np.append(quarter, 0.0) + np.append(0.0, quarter)]
            arclength += [np.append(0.0, np.cumsum(self._lengths[i]))]
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
        base = np.array([0.0, 0.0, q[0]])
        axes[0] = 0.0, 0.0, 1.0
        axes[1], axes[2] = (0.0, -1.0, 0.0), (np.cos(q[1]), 0.0, np.sin(q[1]))
        centres[:WHOLE] = base
        frame = _turn(axes[2], q[2]) @ _turn(axes[1], q[1])
        per_limb = self.elements + 2
        right, left = np.empty((2, per_limb * len(self.robot.limbs), 3))
        ends: list[dict[str, tuple[Array, Array]]] = []
        for i, limb in enumerate(self.robot.limbs):
            start, carried = base, frame
            if limb.on is not None:
                start, carried = ends[self.robot.place(limb.on)][limb.at]
            start = start + limb.offset * carried[:, 1]
            own = carried @ _turn(np.array([0.0, 0.0, 1.0]), limb.angle - self._heading(limb.on))
            side = own[:, 1]
            # in its plane: directions of the links from the sum of the hinges
            turn = np.append(0.0, np.cumsum(q[self.first[i] : self.first[i] + self.elements]))
            along = np.cos(turn)[:, None] * own[:, 0] + np.sin(turn)[:, None] * own[:, 2]
            places = start + np.vstack([np.zeros(3), np.cumsum(self._lengths[i][:, None] * along,
                                                               axis=0)])  # fmt: skip
            edge = 0.5 * limb.strip.width * side
            here = slice(i * per_limb, (i + 1) * per_limb)
            right[here], left[here] = places - edge, places + edge
            hinges = slice(self.first[i], self.first[i] + self.elements)
            axes[hinges], centres[hinges] = -side, places[1:-1]
            last = np.column_stack([along[-1], side, np.cross(along[-1], side)])
            ends.append({
                "begin": (start - limb.offset * carried[:, 1], own),
                "end": (places[-1], last),
            })  # fmt: skip
        return Pose(np.concatenate([right, left]), axes, centres)

    def _heading(self, on: str | None) -> float:
        return 0.0 if on is None else self.robot.limbs[self.robot.place(on)].angle

    def heights(self, pose: Pose) -> Array:
        """How heights of nodes follow the coordinates, (P, Q)."""
        arm = pose.nodes[:, None] - pose.centres[None]
        rise = pose.axes[:, 0] * arm[..., 1] - pose.axes[:, 1] * arm[..., 0]
        rise[:, 0] = 1.0
        return np.where(self.carried, rise, 0.0)

    def bending(self, pose: Pose, force: Array) -> Array:
        """Second derivatives of the sum of forces (P,) times heights, (Q, Q)."""
        arm = pose.nodes[:, None] - pose.centres[None]  # (P, Q, 3)
        pull = np.where(self.carried[..., None], force[:, None, None] * arm, 0.0).sum(axis=0)
        inner = np.cross(pose.axes, pull)  # (Q, 3): a_j x S_j
        inner[0] = 0.0
        outer = pose.axes[:, 0][:, None] * inner[:, 1] - pose.axes[:, 1][:, None] * inner[:, 0]
        outer[0] = 0.0
        # of two joints the one nearer to the trunk is the outer one
        upper = np.where(self.above.T, outer, 0.0)
        return np.asarray(upper + np.tril(upper.T, -1) * (~self.above.T))


def _turn(axis: Array, angle: float) -> Array:
    """Matrix of a rotation about a unit axis."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)
