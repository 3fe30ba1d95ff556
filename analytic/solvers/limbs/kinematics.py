"""A tree of limbs as rigid links: places of its nodes, and their slopes by its joints.

Each limb is the chain of analytic.scene.chain: n hinges between n + 1 links with Simpson's weights.
The first link of a limb is clamped to the link that carries it. Where a limb twists, what follows
turns about the link that does.

Coordinates q: x, y and height of the trunk's beginning, its yaw (to the left, from where it first
points), pitch (up) and roll (left side up), then the joints limb by limb, trunk first, in their
order along the limb; a hinge turns the outward direction up, a twist the left side.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import joint_places, link_lengths, payload_on_nodes, twisting_links
from analytic.scene.ground import LEVEL, Incline
from analytic.scene.limbs import LimbedRobot
from analytic.scene.surface import Surface

Array = NDArray[np.float64]

_EYE = np.eye(3)
_UP = np.array([0.0, 0.0, 1.0])
WHOLE = 6  # coordinates that belong to no limb
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


class _Shapes(NamedTuple):
    """Shapes of L limbs, each from where it begins, where x is ahead and y to the left.

    Attributes:
        places: of the vertices, (L, N + 2, 3) [m].
        left: direction to the left of each link, (L, N + 1, 3).
        axes: of the twists, (L, T, 3).
        ends: matrices of the rotations of the last links, (L, 3, 3).
    """

    places: Array
    left: Array
    axes: Array
    ends: Array


class Tree:
    """The links of a robot.

    Args:
        robot: its limbs.
        elements: hinges of each limb, even.
        twists: of each limb, half as many as its hinges at most.
        incline: of the ground; places and heights are along it and off it.
        surface: whose adhesion pulls at nodes within its reach.

    Attributes:
        elements, twists, surface: as given.
        arclength: of each node, from where its limb begins, (P,) [m].
        weight: of each node that presses on the ground, (P,) [N].
        pull: of each node's weight along the ground, in plan, (P, 2) [N].
        press: of adhesion on each limb's underside, (L,) [N/m].
        adhesion, reach: on each node, (P,) [N], and the height below which it pulls [m].
        parent: joint that carries each joint, (Q,); of the first three the one before.
        carried: whether a joint moves a node, (P, Q).
        joints: places of each limb's joints among the coordinates.
        hinge_places, twist_places: of the hinges and of the twists among the joints of a limb.
        vertices: places of each limb's vertices among the nodes of the right edges.
        starts: arclengths at which the links of each limb begin [m].
    """

    def __init__(
        self, robot: LimbedRobot, elements: int, twists: int = 0, incline: Incline = LEVEL,
        surface: Surface | None = None,
    ) -> None:  # fmt: skip
        if elements < 2 or elements % 2:
            raise ValueError(f"elements must be even and at least 2, got {elements}")
        self.robot, self.elements, self.twists = robot, elements, twists
        self.incline, self.surface = incline, surface
        self.reach = surface.adhesion_reach if surface and surface.adhesion else 0.0
        self.press = np.array(
            [surface.press(limb.strip.width) if surface else 0.0 for limb in robot.limbs]
        )
        limbs, per_limb, joints = range(len(robot.limbs)), elements + 2, elements + twists
        count = WHOLE + joints * len(robot.limbs)
        self.joints = [slice(WHOLE + joints * i, WHOLE + joints * (i + 1)) for i in limbs]
        self.hinge_places, self.twist_places = joint_places(elements, twists)
        self._twisting = np.array(twisting_links(elements, twists), dtype=int)
        # twists before each link and vertex: those of links before it
        self._before = np.searchsorted(self._twisting, np.arange(elements + 1))
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
        weight, carried, arclength, movers = [], [], [], []
        roots: list[int] = []  # the joint that moves the beginning of each limb
        for i, limb in enumerate(robot.limbs):
            quarter = 0.25 * self._links[i] * limb.strip.weight_per_length  # an end, an edge
            weight += [np.append(quarter, 0.0) + np.append(0.0, quarter)]
            carried += [0.5 * payload_on_nodes(limb.strip, elements)]
            along = np.append(0.0, np.cumsum(self._links[i]))
            along[-1] = limb.strip.length  # to the last digit: a tip is at no distance from its end
            arclength += [along]
            if limb.on is None:
                roots.append(WHOLE - 1)
            elif limb.at == "end":
                roots.append(self.joints[self._carriers[i]].stop - 1)
            else:
                roots.append(roots[self._carriers[i]])
            self.parent[self.joints[i].start] = roots[i]
            # a hinge moves what is beyond it; a twist the edges at the hinge after it too
            before = self.joints[i].start + self.hinge_places[1:] - 1
            movers += [roots[i], roots[i], *before.tolist(), self.joints[i].stop - 1]
        strip_weight = np.concatenate(2 * weight)
        whole = strip_weight + np.concatenate(2 * carried)
        self.weight: Array = incline.normal * whole
        self.pull: Array = np.multiply.outer(whole, incline.downhill)
        per_weight = self.press / [limb.strip.weight_per_length for limb in robot.limbs]
        self.adhesion: Array = strip_weight * np.tile(np.repeat(per_weight, per_limb), 2)
        self.arclength: Array = np.concatenate(2 * arclength)
        # a joint is above another if it is on the way from the trunk to it; and above itself
        self._above = np.eye(count, dtype=bool)
        for joint in range(1, count):
            self._above[joint] |= self._above[self.parent[joint]]
        self._below = np.tril(~self._above.T, -1)  # where the upper half is copied to
        self.carried = self._above[2 * movers]
        self._carries = self.carried.T.astype(float)
        begins = np.array([[joints.start] for joints in self.joints])
        self._hinges = (begins + self.hinge_places).ravel()
        self._twists = (begins + self.twist_places).ravel()
        self._links_of_vertices = np.minimum(np.arange(per_limb), elements)

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
        joints = q[WHOLE:].reshape(len(self._links), -1)
        shape = self._shapes(joints[:, self.hinge_places], joints[:, self.twist_places])
        spans = slice(None, None, 1 if self.twists else 2)  # directions that limbs extend along
        starts, frames = np.empty((len(joints), 3)), np.empty((len(joints), 3, 3))
        for i, limb in enumerate(self.robot.limbs):
            carrier = self._carriers[i]
            if limb.on is None:
                origin, frame = trunk
            elif limb.at == "begin":
                origin, frame = starts[carrier], frames[carrier]
            else:
                origin = (
                    starts[carrier] + frames[carrier][:, spans] @ shape.places[carrier, -1, spans]
                )
                frame = frames[carrier] @ shape.ends[carrier]
            starts[i] = origin + limb.offset * frame[:, 1]
            frames[i] = frame @ self._turns[i]
        across = frames.transpose(0, 2, 1)
        places = starts[:, None] + shape.places[..., spans] @ across[:, spans]
        left = shape.left @ across  # of links
        edge = self._half_widths[:, None, None] * left[:, self._links_of_vertices]
        nodes = np.concatenate([places - edge, places + edge]).reshape(-1, 3)
        axes[self._hinges] = -left[:, 1:].reshape(-1, 3)
        centres[self._hinges] = places[:, 1:-1].reshape(-1, 3)
        axes[self._twists] = (shape.axes @ across).reshape(-1, 3)
        centres[self._twists] = places[:, self._twisting].reshape(-1, 3)
        return Pose(nodes, axes, centres)

    def _shapes(self, hinges: Array, twists: Array) -> "_Shapes":
        """Shapes of all limbs by their angles, (L, N) and (L, T) [rad].

        The direction of link i is R_1 ... R_k d_i: d_i is that of a limb without twist, in its
        plane, by the sum of its hinges; R_j turns by twist j about d of its link; k twists are
        before it.
        """
        turn = np.zeros((len(hinges), self.elements + 1))
        np.cumsum(hinges, axis=1, out=turn[:, 1:])
        directions = np.zeros((*turn.shape, 3))
        directions[..., 0], directions[..., 2] = np.cos(turn), np.sin(turn)
        turned = np.empty((len(hinges), self.twists + 1, 3, 3))
        turned[:, 0] = _EYE
        axes = directions[:, self._twisting]
        about = _turns(axes.reshape(-1, 3), twists.ravel()).reshape(*twists.shape, 3, 3)
        for twist in range(self.twists):
            axes[:, twist] = (turned[:, twist] @ axes[:, twist, :, None])[..., 0]
            turned[:, twist + 1] = turned[:, twist] @ about[:, twist]
        places = np.zeros((len(hinges), self.elements + 2, 3))
        cos, sin = directions[:, -1, 0], directions[:, -1, 2]
        pitched = np.zeros((len(hinges), 3, 3))
        pitched[:, 0, 0], pitched[:, 0, 2], pitched[:, 1, 1] = cos, -sin, 1.0
        pitched[:, 2, 0], pitched[:, 2, 2] = sin, cos
        of_links = turned[:, self._before]
        if self.twists:
            directions = (of_links @ directions[..., None])[..., 0]
            pitched = turned[:, -1] @ pitched
        np.cumsum(self._links[..., None] * directions, axis=1, out=places[:, 1:])
        return _Shapes(places, of_links[..., 1], axes, pitched)

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

    def down(self, height: Array) -> Array:
        """Weight that presses and adhesion on nodes at heights (P,) [m], (P,) [N]."""
        if not self.reach:
            return self.weight
        return np.asarray(self.weight + self.adhesion * (height < self.reach))

    def pulled(self, pose: Pose) -> Array:
        """Forces of the pull downhill by the coordinates, (Q,)."""
        return np.asarray(np.tensordot(self.pull, self.moves(pose)[:, :2], axes=2))

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
        return np.where(self._below, upper.T, upper)

    def points(self, limbs: Sequence[int], at: Sequence[float], aside: Sequence[float]) -> Array:
        """Weights of the nodes in points of the limbs, (C, P).

        Args:
            limbs: of each point, (C,).
            at: arclength of each, (C,) [m].
            aside: of each to the left of the middle line, (C,) [m].
        """
        half = len(self.weight) // 2
        weights = np.zeros((len(at), 2 * half))
        for row, limb, place, left in zip(weights, limbs, at, aside, strict=True):
            vertices = self.vertices[limb]
            ends = self.arclength[vertices]
            link = int(np.clip(np.searchsorted(ends, place, side="right") - 1, 0, self.elements))
            part = (place - ends[link]) / (ends[link + 1] - ends[link])
            across = 0.5 * left / self._half_widths[limb]
            first = vertices.start + link
            for node, share in ((first, 0.5 - across), (half + first, 0.5 + across)):
                row[node : node + 2] = share * (1 - part), share * part
        return weights


def _turn(axis: Array, angle: float) -> Array:
    """Matrix of a rotation about a unit axis, (3, 3)."""
    x, y, z = axis.tolist()
    sin, cos = math.sin(angle), math.cos(angle)
    rest = 1.0 - cos
    return np.array([
        [1.0 - rest * (y * y + z * z), rest * x * y - sin * z, rest * x * z + sin * y],
        [rest * x * y + sin * z, 1.0 - rest * (x * x + z * z), rest * y * z - sin * x],
        [rest * x * z - sin * y, rest * y * z + sin * x, 1.0 - rest * (x * x + y * y)],
    ])  # fmt: skip


def _turns(axes: Array, angles: Array) -> Array:
    """Matrices of rotations about unit axes (L, 3) by angles (L,) [rad], (L, 3, 3)."""
    cross = np.zeros((len(axes), 3, 3))
    cross[:, 2, 1], cross[:, 0, 2], cross[:, 1, 0] = axes.T
    cross -= cross.transpose(0, 2, 1)
    sin, cos = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    return np.asarray(_EYE + sin * cross + (1 - cos) * (cross @ cross))
