"""Limbs of equal elements, each with a hinge in its middle, and perhaps a twist: what moves them.

The mechanics of friction_by_area, which share no code with analytic or mjsim.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

Array = Any

E, T, H, C = 1.8e6, 4.0e-3, 3.928e-3, 0.7  # modulus, thickness, height and fraction of chambers
PEAK, G = 7.0 * 6894.757293168, 9.81
ALPHA, ETA = 6 * H**2 * C / (E * T**3), C * H**3 / 4  # eta over width
SINK = 1e-6  # m


@dataclass
class Limb:
    """One limb; begins `offset` to the left of an end of limb `on`, at an angle in plan [rad]."""

    length: float
    width: float
    mass: float
    on: int = -1
    end: bool = True
    angle: float = 0.0
    offset: float = 0.0


class Mechanics:
    """Links, springs and slopes of a tree of limbs."""

    limbs: list[Limb]
    elements: int
    twist: float

    def build(self) -> None:
        """Which joint moves what, lengths and weights."""
        n, limbs = self.elements, self.limbs
        joints, self.parent, self.kinds = 6, [-1, 0, 1, 2, 3, 4], []
        self.root, self.first, self.last = [], [], []
        for limb in limbs:
            carried = limb.on >= 0
            root = (self.last[limb.on] if limb.end else self.root[limb.on]) if carried else 5
            self.root.append(root)
            self.first.append(joints)
            above = root
            for _ in range(n):
                for kind in ("twist", "bend") if self.twist else ("bend",):
                    self.parent.append(above)
                    self.kinds.append(kind)
                    above = joints
                    joints += 1
            self.last.append(above)
        self.count = joints
        above = np.zeros((joints, joints), bool)  # [i, j]: j is above or is i
        for j in range(joints):
            if self.parent[j] >= 0:
                above[j] = above[self.parent[j]]
            above[j, j] = True
        self.above = above
        self.links = [np.r_[0.5, np.ones(n - 1), 0.5] * limb.length / n for limb in limbs]
        each = 2 if self.twist else 1
        movers = []
        for i in range(len(limbs)):
            after = [self.root[i]] + [self.first[i] + each * k - 1 for k in range(1, n + 1)]
            twisted = [self.first[i] + each * k for k in range(n)] if self.twist else after[:-1]
            movers.append(([after[0], *twisted, after[-1]], [after[0], *after[:-1], after[-1]]))
        # edges of a hinge's vertex go with its twist, the vertex itself with the link before
        self.edge_mover = np.concatenate([m[0] for m in movers])
        trib = [np.r_[0.5 * links[0], 0.5 * (links[1:] + links[:-1]), 0.5 * links[-1]]
                for links in self.links]  # fmt: skip
        self.trib = np.concatenate(trib)
        self.owner = np.repeat(np.arange(len(limbs)), n + 2)
        per = np.array([limb.mass * G / limb.length for limb in limbs])
        self.weight = self.trib * per[self.owner]  # of a vertex
        self.stiff = np.tile(np.repeat([0.5 * limb.mass * G / SINK for limb in limbs], n + 2), 2)
        self.mass_length = float(sum(limb.mass for limb in limbs)) * G

    def springs(self, pressures: Array) -> tuple[Array, Array]:
        """Stiffness and rest angle of all joints."""
        stiff, rest = np.zeros(self.count - 6), np.zeros(self.count - 6)
        each = 2 if self.twist else 1
        for i, (limb, p) in enumerate(zip(self.limbs, pressures, strict=True)):
            h, where = limb.length / self.elements, slice(self.first[i] - 6, self.last[i] - 5)
            d0 = E * limb.width * T**3 / 12
            k, r = stiff[where], rest[where]
            rigidity = d0 + ETA * limb.width * p
            k[each - 1 :: each] = rigidity / h
            r[each - 1 :: each] = -ALPHA * p * h  # arches: the outward direction turns down
            if self.twist:
                a, b = T, limb.width
                odd = np.arange(1, 12, 2)
                series = np.sum(np.tanh(0.5 * np.pi * odd * b / a) / odd**5)
                gj = E / 3 * a**3 * b / 3 * (1 - 192 / np.pi**5 * a / b * series)
                k[::2] = self.twist * gj / h
        return stiff, rest

    def pose(self, q: Array) -> tuple[Array, Array, Array]:
        """Edges (2 V, 3), right ones first; axes and centres of the joints (Q, 3)."""
        axes, centres = np.zeros((self.count, 3)), np.zeros((self.count, 3))
        axes[:3], axes[3] = np.eye(3), (0, 0, 1)
        frame = turn(axes[3], q[3] + self.limbs[0].angle)
        axes[4] = -frame[:, 1]
        frame = turn(axes[4], q[4]) @ frame
        axes[5] = frame[:, 0]
        frame = turn(axes[5], q[5]) @ frame
        centres[3:6] = q[:3]
        begins, ends, right, left = [], [], [], []
        for i, limb in enumerate(self.limbs):
            if limb.on < 0:
                place = q[:3].copy()
            else:
                place, frame = (ends if limb.end else begins)[limb.on]
                place = place + limb.offset * frame[:, 1]
                frame = frame @ turn(np.array([0.0, 0, 1]), limb.angle - self.limbs[limb.on].angle)
            begins.append((place, frame))
            half, joint = 0.5 * limb.width, self.first[i]
            right.append(place - half * frame[:, 1])
            left.append(place + half * frame[:, 1])
            for number, length in enumerate(self.links[i]):
                place = place + length * frame[:, 0]
                if number < self.elements:
                    if self.twist:
                        axes[joint], centres[joint] = frame[:, 0], place
                        frame = turn(axes[joint], q[joint]) @ frame
                        joint += 1
                    axes[joint], centres[joint] = -frame[:, 1], place
                    right.append(place - half * frame[:, 1])
                    left.append(place + half * frame[:, 1])
                    frame = turn(axes[joint], q[joint]) @ frame
                    joint += 1
                else:
                    right.append(place - half * frame[:, 1])
                    left.append(place + half * frame[:, 1])
            ends.append((place, frame))
        return np.array(right + left), axes, centres

    def jacobian(self, nodes: Array, axes: Array, centres: Array) -> Array:
        """Slopes of the edges by the coordinates, (2 V, 3, Q)."""
        arms = nodes[:, None] - centres[None]
        slopes = np.cross(axes[None], arms)
        slopes[:, :3] = np.eye(3)
        moved = self.above[np.r_[self.edge_mover, self.edge_mover]]
        return (slopes * moved[:, :, None]).transpose(0, 2, 1)

    def curvature(self, nodes: Array, axes: Array, centres: Array, force: Array) -> Array:
        """Second slopes of sum force . place, (Q, Q)."""
        moved = self.above[np.r_[self.edge_mover, self.edge_mover]].T.astype(float)  # (Q, 2V)
        outer = (nodes[:, :, None] * force[:, None]).reshape(-1, 9)
        m = (moved @ outer).reshape(-1, 3, 3)
        m -= centres[:, :, None] * (moved @ force)[:, None]
        ma = np.einsum("jab,jb->ja", m, axes) - np.trace(m, axis1=1, axis2=2)[:, None] * axes
        inner = axes @ ma.T  # [i, j], i above j
        inner[:3], inner[:, :3] = 0, 0
        upper = np.where(self.above.T, inner, 0)
        return upper + np.triu(upper, 1).T


def turn(axis: Array, angle: float) -> Array:
    """Matrix of a rotation."""
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * (k @ k)
