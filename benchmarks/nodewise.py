"""The quadruped node by node, by a model that shares no code with the rest: twist and area.

    python benchmarks/nodewise.py                       # the wave on gelatin, 3 minutes of CPU
    python benchmarks/nodewise.py --left 0.7 --ground felt gelatin
    python benchmarks/nodewise.py --lateral             # limbs bend sideways as well

Limbs are rods of constant strain in each of N equal elements, bending and, where they are free,
twist and lateral bending, with the exponential map between nodes (Sonneville, Cardona and Bruls
2014). The next state has the least of elastic energy, weight, a stiff smooth ground under both
edges of every node, and friction bound times slip at every node. Constant bounds as [Majidi13] has
them: a limb without pressure resists by tau times the area that lies, an inflated leg by half of
V_t at its tip. Without area they act on the middle lines of legs alone; with it over the width, at
three lines, and the torso resists as well. The robot's numbers are those of docs/quadruped.md,
written again.

Prints distance and turn of a cycle, and what half the elements and half the states change of them.
"""

import argparse
import itertools
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from nodewise_rods import (
    GROUNDS,
    LEFT,
    LENGTHS,
    PASSIVE,
    SHEAR,
    STAGES,
    TIP,
    WEIGHT,
    WIDTHS,
    Array,
    Case,
    L,
    Rods,
)
from scipy.linalg import LinAlgError, cho_factor, cho_solve

STIFF, SOFT = 5e3 * WEIGHT / L, 1e-5 * L  # of the ground at an edge of a node, and its smooth depth
SLIPS = (1e-3, 1e-4, 1e-5, 1e-6)  # beside which slip counts, one after the other, over L
VISCOUS = 1e-4 * WEIGHT / L  # of a tip or a side [N/m]: decides what no bound does
ITERATIONS, TRIES = 150, 40
STILL, LONGEST = 1e-9, 0.3  # gradient over weight times L; change of an angle in a step [rad]


class Increment:
    """Energy and dissipation of one increment, and its slopes."""

    def __init__(
        self, rods: Rods, springs: tuple[Array, Array], before: Array, bounds: Array, touch: Array
    ) -> None:
        self.rods, (self.stiff, self.rest), self.before = rods, springs, before
        self.bounds, self.viscous, self.slip = bounds, VISCOUS * touch, SLIPS[0] * L

    def points(self, middle: Array, edge: Array) -> Array:
        """Points that resist, (lines, 5, n + 1, 3)."""
        return middle + self.rods.lines[:, None, None, None] * edge

    def energy(self, q: Array) -> float:
        """Energy and dissipation, of which the next state has the least [J]."""
        middle, edge = self.rods.pose(q, slopes=False)
        z = np.stack([middle - edge, middle + edge])[..., 2]
        slip = (self.points(middle, edge) - self.before)[..., :2]
        square = (slip**2).sum(-1)
        return float(
            0.5 * self.stiff @ (q - self.rest) ** 2
            + (self.rods.weight * middle[..., 2]).sum()
            + 0.5 * STIFF * (SOFT * np.logaddexp(0, -z / SOFT) ** 2 * SOFT).sum()
            + (self.bounds * np.sqrt(square + self.slip**2)).sum()
            + 0.5 * (self.viscous * square).sum()
        )

    def slopes(self, q: Array) -> tuple[Array, Array]:
        """Gradient and Hessian."""
        rods = self.rods
        middle, edge, w, v = rods.pose(q)
        mask = rods.moves[..., None]
        dm = (np.cross(w[:, None, None], middle) + v[:, None, None]) * mask
        de = np.cross(w[:, None, None], edge) * mask
        hessian, moment = np.diag(self.stiff), np.zeros((len(q), 3))
        gradient = self.stiff * (q - self.rest)
        weight = np.zeros_like(middle)
        weight[..., 2] = rods.weight
        forces = [(dm, weight)]
        for side in (-1, 1):
            z = (middle + side * edge)[..., 2]
            depth = SOFT * np.logaddexp(0, -z / SOFT)
            part = 1 / (1 + np.exp(np.clip(z / SOFT, -500, 500)))
            moves, push = dm + side * de, np.zeros_like(middle)
            push[..., 2] = -STIFF * depth * part
            forces.append((moves, push))
            stiff = STIFF * (part**2 + depth * part * (1 - part) / SOFT)
            root = (moves[..., 2] * np.sqrt(stiff)).reshape(len(q), -1)
            hessian += root @ root.T
        for line, before, bounds in zip(rods.lines, self.before, self.bounds, strict=True):
            acts = (bounds + self.viscous) > 0
            moves = dm + line * de
            slip = (middle + line * edge - before)[..., :2]
            length = np.sqrt((slip**2).sum(-1) + self.slip**2)
            pull = np.zeros_like(middle)
            pull[..., :2] = (bounds / length + self.viscous)[..., None] * slip
            forces.append((moves, pull))
            some, way = moves[:, acts][..., :2], (slip / length[..., None])[acts]
            stiff = (bounds / length)[acts]
            root = (some * np.sqrt(stiff + self.viscous[acts])[:, None]).reshape(len(q), -1)
            hessian += root @ root.T
            root = (some * way).sum(-1) * np.sqrt(stiff)
            hessian -= root @ root.T
        for moves, force in forces:
            gradient += np.tensordot(moves, force, axes=3)
            moment += np.cross(moves, force).sum(axis=(1, 2))
        # what moves first turns what moves later: F . (W_i x dx_j) = W_i . (dx_j x F)
        turned = w @ moment.T
        turned = np.triu(turned * self._above)
        return gradient, hessian + turned + np.triu(turned, 1).T

    @property
    def _above(self) -> Array:
        """Mask of coordinates that move all that another one does, (Q, Q)."""
        ends = self.rods.moves.reshape(len(self.stiff), -1)
        # the last node that the other one moves
        outermost = ends.shape[1] - 1 - ends[:, ::-1].argmax(axis=1)
        return ends[:, outermost]

    def least(self, q: Array) -> Array:
        """The state by Newton's method, near a guess."""
        scale, shift = np.append([L, L, L], np.ones(len(q) - 3)), 0.0
        for slip in SLIPS:
            self.slip = slip * L
            energy = self.energy(q)
            for _ in range(ITERATIONS):
                gradient, hessian = self.slopes(q)
                gradient, hessian = gradient * scale, hessian * scale[:, None] * scale
                if np.abs(gradient).max() < STILL * WEIGHT * L:
                    break
                for _ in range(TRIES):
                    step = descent(hessian + shift * WEIGHT * L * np.eye(len(q)), gradient)
                    after = self.energy(q + scale * step) if step is not None else np.inf
                    if step is not None and after < energy + 1e-14 * abs(energy):
                        shift = 0.25 * shift if shift > 1e-9 else 0.0
                        break
                    shift = max(4 * shift, 1e-8)
                else:
                    break
                q, gain, energy = q + scale * step, energy - after, after
                if gain < 1e-14 * WEIGHT * L:
                    break
        return q


def descent(hessian: Array, gradient: Array) -> Array | None:
    """Newton's step, or none where the Hessian is not positive."""
    try:
        factor = cho_factor(hessian)
    except LinAlgError:
        return None
    step = -cho_solve(factor, gradient)
    return np.asarray(step * min(1.0, LONGEST / float(np.abs(step).max())))


def walk(case: Case) -> Array:
    """Displacement ahead over L and turn to the left [degrees] of one cycle."""
    rods = Rods(case)
    tip, side = GROUNDS[case.ground]
    stages = STAGES * np.where(LEFT, case.left, 1.0)
    jumps = [level + e for part in (1.0, case.left) for level in (PASSIVE / part,)
             for e in (-1e-4, 1e-4)]  # fmt: skip
    parts = {k / case.states for k in range(1, case.states + 1)}
    parts = sorted(parts.union(jumps, (1 - jump for jump in jumps)))
    path = [stages[0]] + [a + (b - a) * part for a, b in itertools.pairwise(stages)
                          for part in parts]  # fmt: skip
    q, start = np.zeros(rods.size), np.zeros(6)
    middle, edge = rods.pose(q, slopes=False)
    for number, pressures in enumerate(path):
        springs, before = rods.springs(pressures), middle + rods.lines[:, None, None, None] * edge
        for _ in range(2):  # bounds by the contacts of the state before, then of this one
            bounds, touch = resistances(rods, middle, edge, pressures, tip, side, case.area)
            state = Increment(rods, springs, before, bounds, touch).least(q)
            middle, edge = rods.pose(state, slopes=False)
        q = state
        if number == 0:
            start = q[:6].copy()
    moved = q[:6] - start
    return np.array([moved[0] / L, np.degrees(moved[3])])


def resistances(
    rods: Rods, middle: Array, edge: Array, pressures: Array, tip: float, side: float, area: bool
) -> tuple[Array, Array]:
    """Bounds of the points that resist, (lines, 5, n + 1) [N], and parts in viscosity, (5, n + 1).

    What no bound decides, as of four inflated legs on felt, is left to weak viscosity where
    friction acts: at the tip of an inflated leg, along a limb without pressure.
    """
    z = np.stack([middle - edge, middle + edge])[..., 2]
    push = STIFF * SOFT * np.logaddexp(0, -z / SOFT) / (1 + np.exp(np.clip(z / SOFT, -500, 500)))
    lies = np.clip(push.sum(axis=0) / rods.weight, 0.0, 1.0)  # part of a node's length
    bounds = side * SHEAR * WIDTHS[:, None] * rods.share * lies
    passive = pressures < PASSIVE
    bounds[~passive] = 0.0
    if not area:
        bounds[0] = 0.0  # a torso is a side of no area
    legs = ~passive & (np.arange(5) > 0)
    bounds[legs, -1] = 0.5 * tip * TIP * (lies[legs, -1] > 1e-2)
    parts = lies * rods.share / LENGTHS[:, None]
    parts[~passive] = 0.0
    parts[legs, -1] = lies[legs, -1]
    lines = len(rods.lines)
    return np.repeat(bounds[None] / lines, lines, axis=0), parts


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--ground", nargs="+", default=["gelatin"], choices=GROUNDS)
    parser.add_argument("--left", type=float, default=1.0, help="part of the left legs' pressure")
    parser.add_argument("--lateral", action="store_true", help="limbs bend sideways as well")
    parser.add_argument("--elements", type=int, default=12, help="of each limb, even")
    parser.add_argument("--states", type=int, default=24, help="of a ramp, even")
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    n, states = given.elements, given.states
    divisions = ((n, states), (n // 2, states), (n, states // 2))
    models = ("neither", "twist alone", "area alone", "twist and area")
    rows = [
        [Case(ground, given.left, twist, area, given.lateral, *division) for division in divisions]
        for ground in given.ground for area in (False, True) for twist in (False, True)
    ]  # fmt: skip
    with ProcessPoolExecutor(given.jobs) as pool:
        walks = pool.map(walk, itertools.chain(*rows))
        for number, row in enumerate(rows):
            fine, half, few = (next(walks) for _ in divisions)
            bar = np.abs(fine - half) + np.abs(fine - few)
            print(f"{row[0].ground:13s}{models[number % 4]:15s} {fine[0]:+.4f} +- {bar[0]:.4f} L  "
                  f"turn {fine[1]:+.2f} +- {bar[1]:.2f} degrees", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
