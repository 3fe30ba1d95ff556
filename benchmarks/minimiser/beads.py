"""A strip as beads that springs join, in small steps: a second reference, unlike chain.py.

    python benchmarks/minimiser/beads.py SCENE [LINKS] [STATES]

Unknowns are the places of the beads; the ground is a stiff penalty; friction acts at each bead, not
at each contact, by a steep function of its slip in a step; the length of a side is that of the
beads that touch. Prints the displacement over L of one cycle of a scene file in SI.
"""

import sys
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

Array = NDArray[np.float64]


_SLIP = 1e-9  # m; in a step, from which on friction is at its bound
_CONTACT_DRAG, _DRAG = 0.2, 1e-7  # N/m of a contact and of a bead, by its slip in a step
_AXIAL = 3e4  # N a strain; stiff
_GROUND = 3e3  # stiffness under a bead over D / h^3: a tip does not sink in beside its bead
_MOST = 200  # steps of Newton's method


class Beads:
    """Beads of one scene, given as the tables of its file."""

    def __init__(self, scene: dict[str, Any], links: int) -> None:
        robot = scene["robot"]
        self.length, self.width = robot.get("length", 0.130), 0.040
        modulus, thick, part = 1.8e6, 4.0e-3, 0.7
        chamber = robot.get("chamber_height", 3.928e-3)
        self.d0 = modulus * self.width * thick**3 / 12
        self.alpha = 6 * chamber**2 * part / (modulus * thick**3)
        self.eta = part * chamber**3 * self.width / 4
        segments = np.cumsum(robot.get("segments", [1, 1, 1]))
        n = self.n = links
        h = self.h = self.length / links
        self.weight = np.full(n + 1, robot.get("weight_per_length", 1.416) * h)
        self.weight[[0, -1]] /= 2
        joints = np.arange(1, n)
        self.left = np.searchsorted(segments, (joints - 0.25) / n * segments[-1])
        self.right = np.searchsorted(segments, (joints + 0.25) / n * segments[-1])
        patches = scene["ground"].get("patches", [scene["ground"]])
        self.borders = np.array([patch["from"] for patch in patches[1:]])
        self.tips = np.array([patch.get("tip_force", 0.0) for patch in patches])
        self.shears = np.array([patch.get("shear_strength", 0.0) for patch in patches])
        self.axial, self.ground = _AXIAL / h, _GROUND * self.d0 / h**3
        eye = sp.eye(n + 1, format="csr")
        self.diff = (eye[1:] - eye[:-1]).tocsr()
        eye = sp.eye(n, format="csr")
        self.turn = (eye[1:] - eye[:-1]).tocsr()
        self.both = sp.block_diag([self.diff, self.diff], format="csr")
        self.order = np.arange(2 * n + 2).reshape(2, -1).T.ravel()  # x and y of a bead side by side
        self.k, self.rest = np.zeros(n - 1), np.zeros(n - 1)
        self.x0 = self.y0 = self.bound = self.drag = np.zeros(n + 1)
        self.unsettled = 0

    def load(self, pressure: Array) -> None:
        """Springs at the inner beads, two half links in series."""
        d = self.d0 + self.eta * np.abs(pressure)
        kappa = self.alpha * pressure
        self.k = 2 / self.h / (1 / d[self.left] + 1 / d[self.right])
        self.rest = -self.h / 2 * (kappa[self.left] + kappa[self.right])

    def resistance(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Dry bound [N] and drag [N/m] of each bead."""
        n, push = self.n, self.ground * np.maximum(-y, 0.0)
        touch = (push > 1e-7 * self.weight[1]).astype(int)
        bound, drag = np.zeros(n + 1), np.full(n + 1, _DRAG)
        edges = np.flatnonzero(np.diff(np.concatenate([[0], touch, [0]])))
        patch = np.searchsorted(self.borders, x, side="right")
        for begin, end in edges.reshape(-1, 2):
            beads, count = np.arange(begin, end), end - begin
            passive = (begin == 0 and self.rest[0] == 0) or (end == n + 1 and self.rest[-1] == 0)
            if count <= 2 - passive:
                share = push[beads] / push[beads].sum()
                place = int(np.searchsorted(self.borders, share @ x[beads], side="right"))
                bound[beads] = self.tips[place] * share
                drag[beads] += _CONTACT_DRAG * share
            else:
                size = np.full(count, self.h)
                size[0] /= 1 + (begin == 0)
                size[-1] /= 1 + (end == n + 1)
                bound[beads] = self.shears[patch[beads]] * self.width * size
                drag[beads] += _CONTACT_DRAG / count
        return bound, drag

    def energy(self, x: Array, y: Array) -> float:
        """What a step minimises [J]."""
        dx, dy = np.diff(x), np.diff(y)
        phi = np.diff(np.arctan2(dy, dx))
        slip = np.abs(x - self.x0)
        rub = np.where(slip > _SLIP, slip - _SLIP / 2, slip**2 / (2 * _SLIP))
        stretch = self.axial * ((np.hypot(dx, dy) - self.h) ** 2).sum()
        ground = self.ground * (np.minimum(y, 0) ** 2).sum()
        viscous = self.drag @ slip**2 + _DRAG * ((y - self.y0) ** 2).sum()
        bend = self.k @ (phi - self.rest) ** 2
        return float(0.5 * (bend + stretch + ground + viscous) + self.weight @ y + self.bound @ rub)

    def slopes(self, x: Array, y: Array) -> tuple[Array, Any]:
        """First and second derivatives of the energy by x and y of the beads."""
        dx, dy = np.diff(x), np.diff(y)
        r = np.hypot(dx, dy)
        cos, sin = dx / r, dy / r
        moment = self.k * (np.diff(np.arctan2(dy, dx)) - self.rest)
        hang = np.concatenate([[0], moment]) - np.concatenate([moment, [0]])
        pull, slip = self.axial * (r - self.h), x - self.x0
        gx = self.diff.T @ (pull * cos - hang * sin / r)
        gx += self.bound * np.clip(slip / _SLIP, -1, 1) + self.drag * slip
        gy = self.diff.T @ (pull * sin + hang * cos / r)
        gy += self.weight + self.ground * np.minimum(y, 0) + _DRAG * (y - self.y0)
        turn = self.turn @ sp.hstack([sp.diags(-sin / r), sp.diags(cos / r)], format="csr")
        f, tight = hang / r**2, pull / r
        xx = 2 * f * sin * cos + self.axial * cos**2 + tight * sin**2
        yy = -2 * f * sin * cos + self.axial * sin**2 + tight * cos**2
        xy = f * (sin**2 - cos**2) + (self.axial - tight) * sin * cos
        link = turn.T @ sp.diags(self.k) @ turn
        link += sp.bmat([[sp.diags(xx), sp.diags(xy)], [sp.diags(xy), sp.diags(yy)]])
        hx = np.where(np.abs(slip) <= _SLIP, self.bound / _SLIP, 0.0) + self.drag
        hy = np.where(y < 0, self.ground, 0.0) + _DRAG
        hessian = self.both.T @ link @ self.both + sp.diags(np.concatenate([hx, hy]))
        return np.concatenate([gx, gy]), hessian.tocsr()

    def step(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Places at the end of a step, by Newton's method with a line search."""
        self.x0, self.y0 = x, y
        self.bound, self.drag = self.resistance(x, y)
        n, value = self.n, self.energy(x, y)
        for _ in range(_MOST):
            gradient, hessian = self.slopes(x, y)
            move, added = self._descent(gradient, hessian)
            slope = float(gradient @ move)
            if -slope < 1e-19 and not added:
                return x, y
            part = min(1.0, 6 * self.h / max(float(np.abs(move).max()), 1e-300))
            while True:
                new = self.energy(x + part * move[: n + 1], y + part * move[n + 1 :])
                if new <= value + 1e-4 * part * slope + 1e-17 or part < 1e-9:
                    break
                part *= 0.5
            x, y, value = x + part * move[: n + 1], y + part * move[n + 1 :], new
            if part < 1e-9:
                return x, y
        self.unsettled += 1
        return x, y

    def _descent(self, gradient: Array, hessian: Any) -> tuple[Array, float]:
        """Newton's move, and what had to be added to the diagonal for it to lead down."""
        order, added = self.order, 0.0
        for _ in range(12):
            matrix = (hessian + sp.diags(np.full(len(gradient), added))).tocsr()
            lu = splu(matrix[order][:, order].tocsc(), permc_spec="NATURAL", diag_pivot_thresh=0.0)
            if (lu.U.diagonal() > 0).all():
                move = np.empty_like(gradient)
                move[order] = -lu.solve(gradient[order])
                return move, added
            added = max(10 * added, 1e-2)
        raise ArithmeticError("no move leads down")

    def walk(self, stages: Array, peak: float, states: int) -> float:
        """Displacement of the left end over L in one cycle, after it was inflated to its start.

        Args:
            stages: fractions of the peak pressure, (T, S).
            peak: pressure [Pa].
            states: of a change by the peak pressure.
        """
        x, y = np.linspace(0, self.length, self.n + 1), -self.weight / self.ground
        now, begin = np.zeros(stages.shape[1]), 0.0
        for number, target in enumerate(stages):
            steps = int(np.ceil(states * np.abs(target - now).max()))
            for i in range(steps):
                self.load(peak * (now + (target - now) * (i + 1) / steps))
                x, y = self.step(x, y)
            now, begin = target, float(x[0]) if number == 0 else begin
        return (float(x[0]) - begin) / self.length


def main(path: str, links: int = 198, states: int = 60) -> None:
    scene = tomllib.loads(Path(path).read_text())
    beads = Beads(scene, links)
    stages = np.array(scene["gait"]["stages"], float)
    print(f"{beads.walk(stages, scene['robot']['peak_pressure'], states):+.5f} L, "
          f"{beads.unsettled} states unsettled")  # fmt: skip


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
