"""A tree of limbs as rigid links: places of its nodes, and their slopes by its joints.

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
from analytic.scene.ground import LEVEL, Incline
from analytic.scene.limbs import LimbedRobot

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
        incline: of the ground; places and heights are along it and off it.

    Attributes:
        arclength: of each node, from where its limb begins, (P,) [m].
        weight: of each node that presses on the ground, (P,) [N].
        pull: of each node's weight along the ground, in plan, (P, 2) [N].
        parent: joint that carries each joint, (Q,); of the first three the one before.
        carried: whether a joint moves a node, (P, Q).
        hinges: places of each limb's hinges among the coordinates.
        vertices: places of each limb's vertices among the nodes of the right edges.
        starts: arclengths at which the links of each limb begin [m].
    """

    def __init__(self, robot: LimbedRobot, elements: int, incline: Incline = LEVEL) -> None:
        if elements < 2 or elements % 2:
            raise ValueError(f"elements must be even and at least 2, got {elements}")
        self.robot, self.elements, self.incline = robot, elements, incline
        limbs, per_limb = range(len(robot.limbs)), elements + 2
        count = WHOLE + elements * len(robot.limbs)
        self.hinges = [slice(WHOLE + elements * i, WHOLE + elements * (i + 1)) for i in limbs]
        self.vertices = [slice(per_limb * i, per_limb * (i + 1)) for i in limbs]
        self.parent = np.arange(-1, count - 1)
        self._links = np.array([link_lengths(limb.strip, elements) for limb in robot.limbs])
        self._half_widths = np.array([0.5 * limb.strip.width for limb in robot.limbs])
        self.starts = [np.append(0.0, np.cumsum(lengths)[:-1]) for lengths in self._links]
        self._carriers = [0 if limb.on is None else robot.place(limb.on) for limb in robot.limbs]
        self._turns = [
            _turn(_UP, limb.angle - robot.limbs[carrier].angle)
            for limb, carrier in zip(robot.limbs, self._carriers, strict=True)
        ]
        weight, arclength, movers = [], [], []
        roots: list[int] = []  # the joint that moves the beginning of each limb
        for i, limb in enumerate(robot.limbs):
            quarter = 0.25 * self._links[i] * limb.strip.weight_per_length  # an end, an edge
            weight += [np.append(quarter, 0.0) + np.append(0.0, quarter)]
            along = np.append(0.0, np.cumsum(self._links[i]))
            along[-1] = limb.strip.length  # to the last digit: a tip is at no distance from its end
            arclength += [along]
            if limb.on is None:
                roots.append(WHOLE - 1)
            elif limb.at == "end":
                roots.append(self.hinges[self._carriers[i]].stop - 1)
            else:
                roots.append(roots[self._carriers[i]])
            self.parent[self.hinges[i].start] = roots[i]
            movers += [roots[i], roots[i], *range(count)[self.hinges[i]]]
        whole = np.concatenate(2 * weight)
        self.weight: Array = incline.normal * whole
        self.pull: Array = np.multiply.outer(whole, incline.downhill)
        self.arclength: Array = np.concatenate(2 * arclength)
        # a joint is above another if it is on the way from the trunk to it; and above itself
        self._above = np.eye(count, dtype=bool)
        for joint in range(1, count):
            self._above[joint] |= self._above[self.parent[joint]]
        self.carried = self._above[2 * movers]
        self._carries = self.carried.T.astype(float)

    def pose(self, q: Array) -> Pose:
        """Places of nodes and joints."""
        axes, centres = np.zeros((len(q), 3)), np.zeros((len(q), 3))
        base = np.array(q[:3])
        axes[:3], axes[3] = _EYE, _UP
        headed = _turn(_UP, self.robot.limbs[0].angle + q[3])
        axes[4] = -headed[:, 1]
        pitched = _turn(axes[4], q[4]) @ headed
        axes[5] = pitched[:, 0]
        centres[:WHOLE] = base
        trunk = base, _turn(axes[5], q[5]) @ pitched
        # each limb in its plane, forward and outward: directions of links are sums of the hinges
        hinges = q[WHOLE:].reshape(-1, self.elements)
        turn = np.zeros((len(hinges), self.elements + 1))
        np.cumsum(hinges, axis=1, out=turn[:, 1:])
        along = np.stack([np.cos(turn), np.sin(turn)], axis=2)
        plane = np.zeros((len(hinges), self.elements + 2, 2))
        np.cumsum(self._links[..., None] * along, axis=1, out=plane[:, 1:])
        starts, frames = np.empty((len(hinges), 3)), np.empty((len(hinges), 3, 3))
        for i, limb in enumerate(self.robot.limbs):
            carrier = self._carriers[i]
            if limb.on is None:
                origin, frame = trunk
            elif limb.at == "begin":
                origin, frame = starts[carrier], frames[carrier]
            else:
                frame, (cos, sin) = frames[carrier], along[carrier, -1]
                origin = starts[carrier] + frame[:, ::2] @ plane[carrier, -1]
                frame = frame @ np.array([[cos, 0.0, -sin], [0.0, 1.0, 0.0], [sin, 0.0, cos]])
            starts[i] = origin + limb.offset * frame[:, 1]
            frames[i] = frame @ self._turns[i]
        places = starts[:, None] + plane @ frames[:, :, ::2].transpose(0, 2, 1)
        edge = self._half_widths[:, None] * frames[:, :, 1]
        nodes = np.concatenate([places - edge[:, None], places + edge[:, None]]).reshape(-1, 3)
        axes[WHOLE:] = np.repeat(-frames[:, :, 1], self.elements, axis=0)
        centres[WHOLE:] = places[:, 1:-1].reshape(-1, 3)
        return Pose(nodes, axes, centres)

    def moves(self, pose: Pose, which: slice | NDArray[np.int_] = slice(None)) -> Array:
        """Slopes of the places of nodes, all or some, by the coordinates, (P, 3, Q)."""
        arm = pose.nodes[which, None] - pose.centres[None]
        (a, b, c), (x, y, z) = pose.axes.T, np.moveaxis(arm, 2, 0)
        moves = np.stack([b * z - c * y, c * x - a * z, a * y - b * x], axis=1)
        moves[..., :3] = pose.axes[:3].T
        return np.where(self.carried[which][:, None], moves, 0.0)

    def heights(self, pose: Pose) -> Array:
        """Slopes of the heights of nodes by the coordinates, (P, Q)."""
        (x, y, _), (a, b, _) = pose.nodes.T, pose.axes.T
        rise = np.multiply.outer(y, a) - np.multiply.outer(x, b)
        rise += b * pose.centres[:, 0] - a * pose.centres[:, 1]
        rise[:, :3] = pose.axes[:3, 2]
        rise *= self.carried
        return rise

    def pulled(self, pose: Pose) -> Array:
        """Forces of the pull downhill by the coordinates, (Q,)."""
        x, y, z = pose.nodes.T
        a, b = self.pull.T
        moment = np.stack([-z * b, z * a, x * b - y * a, a, b], axis=1)
        turning, force = np.split(self._carries @ moment, [3], axis=1)
        u, v, w = pose.centres.T
        turning -= np.stack([-w * force[:, 1], w * force[:, 0],
                             u * force[:, 1] - v * force[:, 0]], axis=1)  # fmt: skip
        forces = (pose.axes * turning).sum(axis=1)
        forces[:3] = (pose.axes[:3, :2] * force[:3]).sum(axis=1)
        return np.asarray(forces)

    def bending(self, pose: Pose, force: Array) -> Array:
        """Second derivatives of the sum of forces (P, 3) times places, (Q, Q).

        Of two joints the one nearer to the trunk, i, turns what the other, j, moves:
        f . (a_i x (a_j x r)) = (a_i . r)(f . a_j) - (f . r)(a_i . a_j).
        """
        # sum over nodes of arm times force, (Q, 3, 3), without the arms of all nodes and joints
        products = np.concatenate([(pose.nodes[:, :, None] * force[:, None]).reshape(-1, 9), force],
                                  axis=1)  # fmt: skip
        sums = self._carries @ products
        moment = sums[:, :9].reshape(-1, 3, 3) - pose.centres[:, :, None] * sums[:, None, 9:]
        trace = moment[:, 0, 0] + moment[:, 1, 1] + moment[:, 2, 2]
        turned = (moment @ pose.axes[..., None])[..., 0] - trace[:, None] * pose.axes
        inner = pose.axes @ turned.T  # (i, j)
        inner[:3], inner[:, :3] = 0.0, 0.0
        upper = np.where(self._above.T, inner, 0.0)
        return np.asarray(upper + np.tril(upper.T, -1) * (~self._above.T))

    def points(self, limbs: Sequence[int], at: Sequence[float]) -> Array:
        """Weights of the nodes in points of the limbs' middle lines, (C, P).

        Args:
            limbs: of each point, (C,).
            at: arclength of each, (C,) [m].
        """
        half = len(self.weight) // 2
        weights = np.zeros((len(at), 2 * half))
        for row, limb, place in zip(weights, limbs, at, strict=True):
            vertices = self.vertices[limb]
            ends = self.arclength[vertices]
            link = int(np.clip(np.searchsorted(ends, place, side="right") - 1, 0, self.elements))
            part = (place - ends[link]) / (ends[link + 1] - ends[link])
            for node in (vertices.start + link, half + vertices.start + link):
                row[node : node + 2] = 0.5 * (1 - part), 0.5 * part
        return weights


def _turn(axis: Array, angle: float) -> Array:
    """Matrix of a rotation about a unit axis."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(_EYE + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)
