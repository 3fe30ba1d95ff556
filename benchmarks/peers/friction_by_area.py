"""Robots of limbs on ground that resists node by node over its area: an independent model.

    python benchmarks/peers/friction_by_area.py [SURFACE ...]    # the wave, ten minutes a surface
    python benchmarks/peers/friction_by_area.py heavy            # torsos of more weight on felt

It shares no code with analytic or mjsim, only the laws of [Majidi13]. A limb is n equal elements,
each with a hinge in its middle; both edges of each vertex rest on springs so stiff that one pair of
them carries a limb's weight a micrometre deep. A state is the least of energy and of friction on
the way to it,

    energy(q) + sum over patches of bound |slip|,    |u| as sqrt(u^2 + 1e-7^2 m^2),

from the state before, by Newton's method. Patches are links times a part of the width. A link whose
ends both carry their weight resists by tau times its area, one whose ends carry less by as much
less, and two vertices that push alone by none, as a point that touches between them would; the end
of a limb under pressure by V_t (its share by width), spread over the width. Under mu N each vertex
resists by its coefficient times what it carries. What bounds leave open goes to a viscosity that is
alike for all limbs that touch, and vanishes.
"""

import sys
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from limb_mechanics import PEAK, Limb, Mechanics

Array = Any

V0, TAU0, MU0 = 0.034, 0.034 * 3 / (0.040 * 0.130), 0.37
SURFACES = {"felt": (0.0, 1.0), "polyethylene": (0.5, 1.0), "gelatin": (1.0, 0.0)}
SHARP, VISCOUS, LEAST = 1e-7, 1e-4, 0.01


@dataclass
class Model(Mechanics):
    """A robot on a ground; bounds are tau [Pa] and V_t [N], or coefficients if `coulomb`."""

    limbs: list[Limb]
    tip: float
    side: float
    coulomb: bool = False
    elements: int = 8
    across: int = 2
    twist: float = 0.0
    """GJ over that of the solid section; 0: none"""
    behind: bool = True
    """whether what lies flat behind the tip of a limb under pressure resists by its area"""
    wide: bool = True
    """whether friction acts over the width, or at the middle line"""

    def __post_init__(self) -> None:
        self.build()
        n, limbs = self.elements, self.limbs
        carriers = {(limb.on, limb.end) for limb in limbs}
        self.ends = []  # (vertex, limb) of free ends, and their neighbours
        for i, limb in enumerate(limbs):
            begin = i * (n + 2)
            if (i, True) not in carriers:
                self.ends.append((begin + n + 1, -1, i))
            if limb.on < 0 and (i, False) not in carriers:
                self.ends.append((begin, 1, i))
        self.share = []
        for limb in limbs:
            beside = [o.width for o in limbs if (o.on, o.end) == (limb.on, limb.end)]
            self.share.append(limb.width / sum(beside))
        m = self.across
        self.at = (np.arange(m) + 0.5) / m if self.wide else np.array([0.5])

    def bounds(self, force: Array, pressures: Array) -> Array:
        """Bounds of the vertices and then of the links, from what each vertex carries, (V + K,)."""
        limbs, n = len(self.limbs), self.elements
        vertex, link = np.zeros((limbs, n + 2)), np.zeros((limbs, n + 1))
        push = force.reshape(limbs, n + 2)
        if self.coulomb:
            vertex = self.side * push
        else:
            part = np.minimum(1.0, (force / self.weight).reshape(limbs, n + 2))
            width = np.array([[limb.width] for limb in self.limbs])
            link = self.side * width * np.array(self.links) * part[:, 1:] * part[:, :-1]
            on = np.pad(push > LEAST * self.weight.reshape(limbs, n + 2), ((0, 0), (1, 1)))
            link *= on[:, :-3] | on[:, 3:]  # what touches at a point may load two vertices
        vertex = vertex.ravel()
        for end, step, i in self.ends:
            peak = pressures[i] > LEAST * PEAK
            if peak and not self.behind and not self.coulomb:
                link[i] = 0.0
            alone = force[end] > LEAST * self.weight[end] and force[end + step] <= 0
            if peak or alone:
                vertex[end] = (self.tip * force[end] if self.coulomb else
                               self.tip * self.share[i] * (force[end] > 0))  # fmt: skip
        return np.r_[vertex, link.ravel()]

    def thin(self, force: Array, bound: Array) -> Array:
        """Viscosity of the same patches, vanishing and alike for all limbs that touch [N s/m]."""
        vertices = len(force)
        loaded = force > LEAST * self.weight
        count = np.bincount(self.owner, loaded, len(self.limbs))[self.owner]
        scale = VISCOUS * (bound.sum() or 1e-3 * self.mass_length) / 0.1
        return np.r_[scale * loaded / np.maximum(count, 1), np.zeros(len(bound) - vertices)]

    def patches(self, nodes: Array, a: float) -> Array:
        """Middles of vertices and then of links, of edges (2 V, ...), at a part of the width."""
        half = len(nodes) // 2
        line = (1 - a) * nodes[:half] + a * nodes[half:]
        limbs = line.reshape(len(self.limbs), self.elements + 2, *line.shape[1:])
        links = 0.5 * (limbs[:, 1:] + limbs[:, :-1])
        return np.concatenate([line, links.reshape(-1, *line.shape[1:])])

    def on_nodes(self, pull: Array, a: float) -> Array:
        """Forces on the edges of forces on patches, the transpose of `patches`, (2 V, 2)."""
        limbs, n = len(self.limbs), self.elements
        line = pull[: limbs * (n + 2)].reshape(limbs, n + 2, 2).copy()
        links = 0.5 * pull[limbs * (n + 2) :].reshape(limbs, n + 1, 2)
        line[:, 1:] += links
        line[:, :-1] += links
        line = line.reshape(-1, 2)
        return np.concatenate([(1 - a) * line, a * line])

    def walk(self, stages: Array, states: int) -> tuple[Array, float]:
        """Displacement of the trunk's beginning (2,) [m] and turn [rad] by a cycle of stages."""
        stages = np.asarray(stages, float)
        rows = [PEAK * stages[0]]
        for a, b in pairwise(stages):
            parts = np.linspace(0, 1, states + 1)[1:]
            crossed = (LEAST - a[a != b]) / (b - a)[a != b]  # where an end becomes a tip
            crossed = crossed[(crossed > 1e-6) & (crossed < 1 - 1e-6)]
            parts = np.unique(np.r_[parts, crossed - 1e-7, crossed + 1e-7])
            rows += [PEAK * (a + part * (b - a)) for part in parts]
        q = np.zeros(self.count)
        nodes = self.pose(q)[0]
        force, bound = self.weight.copy(), self.bounds(self.weight.copy(), rows[0])
        self.failures = 0
        for row in rows[1:]:
            before, old = nodes, bound
            guess, new = q.copy(), old
            for _ in range(4):
                guess, force = self._least(guess, row, before, 0.5 * (old + new), force)
                again = self.bounds(force, row)
                change = np.abs(again - new).sum()
                new = again
                if change < 1e-3 * new.sum():
                    break
            q, bound = guess, new
            nodes = self.pose(q)[0]
        return q[:2].copy(), float(q[3])

    def _least(
        self, q: Array, row: Array, before: Array, bound: Array, force: Array
    ) -> tuple[Array, Array]:
        stiff, rest = self.springs(row)
        thin = self.thin(force, bound)
        for sharp in (1e-4, 1e-5, 1e-6, SHARP):
            q = self._newton(q, stiff, rest, before, bound, thin, sharp)
        push = np.maximum(0.0, -self.pose(q)[0][:, 2]) * self.stiff
        half = len(push) // 2
        return q, push[:half] + push[half:]

    def _newton(self, q: Array, stiff: Array, rest: Array, before: Array, bound: Array,
                viscous: Array, sharp: float) -> Array:  # fmt: skip
        half = len(self.weight)
        ground = self.stiff
        used = (bound > 0) | (viscous > 0)
        each, thick = bound[used] / len(self.at), viscous[used] / len(self.at)
        was = [self.patches(before[:, :2], a)[used] for a in self.at]

        def energy(q: Array) -> float:
            nodes = self.pose(q)[0]
            z = nodes[:, 2]
            total = 0.5 * stiff @ (q[6:] - rest) ** 2 + 0.5 * (self.weight @ (z[:half] + z[half:]))
            total += 0.5 * ground @ np.minimum(z, 0) ** 2
            for a, place in zip(self.at, was, strict=True):
                square = ((self.patches(nodes[:, :2], a)[used] - place) ** 2).sum(1)
                total += each @ np.sqrt(square + sharp**2) + 0.5 * thick @ square
            return float(total)

        e, unit = energy(q), self.mass_length * 0.1
        for _ in range(60):
            nodes, axes, centres = self.pose(q)
            jac = self.jacobian(nodes, axes, centres)
            z, force = nodes[:, 2], np.zeros_like(nodes)
            force[:, 2] = 0.5 * np.r_[self.weight, self.weight] + ground * np.minimum(z, 0)
            on = z < 0
            rise = jac[on, 2]
            hessian = rise.T @ (ground[on, None] * rise)
            for a, place in zip(self.at, was, strict=True):
                u = self.patches(nodes[:, :2], a)[used] - place
                j = self.patches(jac[:, :2], a)[used]
                size = np.sqrt((u**2).sum(1) + sharp**2)
                pull = np.zeros((len(used), 2))
                pull[used] = (each / size + thick)[:, None] * u
                force[:, :2] += self.on_nodes(pull, a)
                k = (each / size)[:, None, None] * (
                    np.eye(2) - u[:, :, None] * u[:, None] / (size**2)[:, None, None])  # fmt: skip
                k += thick[:, None, None] * np.eye(2)
                flat = j.reshape(-1, self.count)
                hessian += flat.T @ (k @ j).reshape(flat.shape)
            gradient = np.tensordot(force, jac, axes=2)
            gradient[6:] += stiff * (q[6:] - rest)
            hessian[range(6, self.count), range(6, self.count)] += stiff
            full = hessian + self.curvature(nodes, axes, centres, force)
            try:
                lower = np.linalg.cholesky(full)
                step = -np.linalg.solve(lower.T, np.linalg.solve(lower, gradient))
            except np.linalg.LinAlgError:
                values, vectors = np.linalg.eigh(full)
                values = np.maximum(np.abs(values), 1e-12 * np.abs(values).max())
                step = -vectors @ ((vectors.T @ gradient) / values)
            step *= min(1.0, 0.3 / np.abs(step[3:]).max(), 0.03 / np.abs(step[:3]).max())
            fall, part = float(gradient @ step), 1.0
            if -fall < 1e-13 * unit:
                break
            while (trial := energy(q + part * step)) > e + 1e-4 * part * fall + 1e-15 * unit:
                part *= 0.5
                if part < 1e-8:
                    self.failures += 1
                    return q
            q, e = q + part * step, trial
        return q


def quadruped(torso: float = 1.0) -> list[Limb]:
    """The quadruped, its torso so many times as heavy."""
    third, angle = 0.1357 / 3, np.deg2rad(20.0)
    leg = third / np.cos(angle)
    area = third * 0.0323 + 4 * leg * 0.0135
    body = Limb(third, 0.0323, torso * 0.035 * third * 0.0323 / area)
    mass = 0.035 * leg * 0.0135 / area
    return [body, *(Limb(leg, 0.0135, mass, 0, not rear,
                         (np.pi - left * angle) if rear else left * angle, left * 0.0094)
                    for rear, left in ((1, 1), (1, -1), (0, 1), (0, -1)))]  # fmt: skip


def wave(left: float = 1.0) -> list[list[float]]:
    """The wave, torso first, with less pressure in the left legs."""
    rows = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1), (0, 0, 1), (0, 0, 0))
    return [[m, left * r, r, left * f, f] for r, m, f in rows]


def table(names: list[str]) -> None:
    """Print distances over L and turns [degrees] of the wave, converging in elements and states."""
    for name in names or list(SURFACES):
        tip, side = SURFACES[name]
        for left in (1.0, 0.7):
            for wide in (False, True):
                for elements, states in ((8, 15), (8, 30), (16, 30)):
                    model = Model(quadruped(), tip * V0, side * TAU0, elements=elements, wide=wide,
                                  behind=False)  # fmt: skip
                    place, angle = model.walk(wave(left), states)
                    print(f"{name}, left {left:g}, {elements} elements, {states} states, "
                          f"{'over the width' if wide else 'at the middle line'}: "
                          f"{place[0] / 0.1357:+.4f} L, {np.rad2deg(angle):+.2f} degrees",
                          flush=True)  # fmt: skip


def heavy() -> None:
    """Print distances over L on felt of heavy torsos: rear legs, all, all legs, front legs."""
    none, rear, every = [0] * 5, [0, 1, 1, 0, 0], [1] * 5
    stages = [none, rear, every, [0, 1, 1, 1, 1], [0, 0, 0, 1, 1], none]
    for torso in (2.0, 8.0):
        for elements in (8, 16, 24):
            place, _ = Model(quadruped(torso), 0.0, TAU0, elements=elements, behind=False).walk(
                stages, 15
            )
            print(f"torso of {torso:g} times its weight, {elements} elements: "
                  f"{place[0] / 0.1357:+.4f} L", flush=True)  # fmt: skip


if __name__ == "__main__":
    if sys.argv[1:] == ["heavy"]:
        heavy()
    else:
        table(sys.argv[1:])
