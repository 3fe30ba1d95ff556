"""The small-slope strip on the ground with exact unilateral contact: a convex quadratic program.

    minimise  int D (y'' + kappa)^2 / 2 + w y ds   over  y >= 0

with cubic Hermite elements and y >= 0 at the nodes. The weight keeps at least two nodes on the
ground, which makes the problem strictly convex. A primal active set method (Nocedal and Wright,
Numerical Optimization, section 16.5) solves it, each state from the last. Where nothing touches
between the nodes, the nodal values are exact.

Dimensionless inside: lengths over L, forces over D0 / L^2.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import solveh_banded
from scipy.linalg.blas import dsbmv

from analytic.friction.contact_length import side_contact
from analytic.scene import pneunet
from analytic.scene.chain import overlaps, segments_fit
from analytic.scene.feet import refuse_proud
from analytic.scene.pressures import check_pressures
from analytic.scene.robot import GRAVITY, Robot
from analytic.shapes import ContactShapes, Flag

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_GAUSS_X, _GAUSS_W = np.polynomial.legendre.leggauss(4)
_EXCHANGES = 2000  # far beyond what was ever needed
_ROUNDING = 1e-12  # of heights over L and forces over the weight: less is 0


def solve_obstacle(robot: Robot, pressures_pa: ArrayLike, elements: int = 60) -> ContactShapes:
    """Small-slope equilibria with unilateral contact anywhere.

    Args:
        robot: the strip.
        pressures_pa: segment pressures, left first, shape (B, S) or (S,) [Pa], at least 0; a
            sequence whose neighbours are alike is solved faster, as each starts from the last.
        elements: so many that segments end at nodes, a multiple of 3 for three equal ones.

    Raises:
        ValueError: the pressures are bad, or a segment ends between nodes.
    """
    p = check_pressures(robot, pressures_pa)
    refuse_proud(robot.feet, "small slopes")
    if elements < 1 or not segments_fit(robot, elements):
        raise ValueError(f"elements must be so many that segments end at nodes, got {elements}")
    overlap = overlaps(np.linspace(0.0, 1.0, elements + 1), robot.borders)
    d0 = pneunet.base_rigidity(robot)
    rigidity = pneunet.rigidity(robot, p) / d0 @ overlap.T
    curvature = pneunet.natural_curvature(robot, p) * robot.length
    curvature = curvature @ overlap.T
    even = robot.weight_per_length * robot.length**3 / d0
    spread, carried = _payload(robot, elements)
    load, carried = even + spread * robot.length**3 / d0, carried * robot.length**2 / d0
    weight = even + GRAVITY * robot.payload_mass * robot.length**2 / d0

    values = np.zeros((len(p), elements + 1, 2))  # y and y' at the nodes
    force = np.zeros((len(p), elements + 1))
    status = np.full(len(p), int(Flag.OK))
    iterations = np.zeros(len(p), dtype=int)
    state = np.zeros((elements + 1, 2))
    for i in range(len(p)):
        state, force[i], iterations[i], converged = _solve(
            rigidity[i], _load(rigidity[i], curvature[i], even) + carried, weight, state
        )
        values[i] = state
        if not converged:
            status[i] = Flag.NOT_CONVERGED

    nodes = np.linspace(0.0, robot.length, elements + 1)
    newtons = force * d0 / robot.length**2
    height = values[..., 0] * robot.length
    left, right = side_contact(robot, nodes, newtons, height, p)
    curve = _Curve(robot.length, values, load / rigidity)
    blank = np.where(status == Flag.OK, 1.0, np.nan)
    return ContactShapes(
        robot=robot,
        separation=curve(np.array([robot.length]))[0][:, 0] * blank,
        contact_left=left * blank,
        contact_right=right * blank,
        amplitude=curve.height() * blank,
        status=status,
        curve=curve,
        nodes=nodes,
        force=newtons,
        pressures=p,
        residual=_residual(values, force, weight),
        iterations=iterations,
    )


def _stiffness(rigidity: Array) -> Array:
    """Upper banded stiffness matrix, shape (4, 2 n + 2), unknowns y_0, y'_0, y_1, y'_1, ..."""
    count = len(rigidity)
    h = 1.0 / count
    element = rigidity / h**3
    band = np.zeros((4, 2 * count + 2))
    band[3, 0:-2:2] += 12 * element
    band[3, 1:-2:2] += 4 * h * h * element
    band[3, 2::2] += 12 * element
    band[3, 3::2] += 4 * h * h * element
    band[2, 1:-2:2] += 6 * h * element  # y_a, y'_a
    band[2, 3::2] -= 6 * h * element  # y_b, y'_b
    band[2, 2::2] -= 6 * h * element  # y'_a, y_b
    band[1, 2::2] -= 12 * element  # y_a, y_b
    band[1, 3::2] += 2 * h * h * element  # y'_a, y'_b
    band[0, 3::2] += 6 * h * element  # y_a, y'_b
    return band


def _load(rigidity: Array, curvature: Array, weight: float) -> Array:
    """Consistent load of weight and natural curvature, shape (2 n + 2,)."""
    count = len(rigidity)
    h = 1.0 / count
    bend = rigidity * curvature
    load = np.zeros(2 * count + 2)
    load[0:-2:2] -= 0.5 * weight * h
    load[2::2] -= 0.5 * weight * h
    load[1:-2:2] += bend - weight * h * h / 12
    load[3::2] += weight * h * h / 12 - bend
    return load


def _payload(robot: Robot, elements: int) -> tuple[Array, Array]:
    """Payloads of a strip: their weight per length in each element, and as a consistent load.

    Returns:
        (n,) [N/m], mean of each element; and (2 n + 2,) [N], on heights and on slopes over L.
    """
    edges = np.linspace(0.0, 1.0, elements + 1)
    spread, load, h = np.zeros(elements), np.zeros(2 * elements + 2), 1.0 / elements
    for payload in robot.carried:
        begin, end = payload.stretch
        weight = GRAVITY * payload.mass
        if begin == end:
            pieces = [(min(int(begin * elements), elements - 1), begin, begin, weight)]
        else:
            low, high = np.maximum(edges[:-1], begin), np.minimum(edges[1:], end)
            parts = weight * np.maximum(high - low, 0.0) / (end - begin)
            spread += parts / (h * robot.length)
            pieces = list(zip(range(elements), low, high, parts.tolist(), strict=True))
        for element, first, last, part in pieces:
            for x, share in zip(_GAUSS_X, 0.5 * _GAUSS_W, strict=True):
                t = (first + 0.5 * (1 + x) * (last - first)) / h - element
                a, b = t * t * (3 - 2 * t), t * (1 - t) * h
                shape = np.array([1 - a, b * (1 - t), a, -b * t])
                load[2 * element : 2 * element + 4] -= share * part * shape
    return spread, load


def _solve(
    rigidity: Array, load: Array, weight: float, start: Array
) -> tuple[Array, Array, int, bool]:
    """Primal active set method from a feasible start (n+1, 2).

    Returns values, forces, the number of minima looked for, and whether the last one is right.

    A node is set free only at the minimum for the active nodes, so that the energy falls from one
    such minimum to the next and none comes back: the method cannot cycle.
    """
    band = _stiffness(rigidity)
    u = start.ravel().copy()
    active = u[0::2] <= 0.0
    for count in range(1, _EXCHANGES + 1):
        target = _minimum(band, load, active)
        sinks = ~active & (target[0::2] < -_ROUNDING)
        if sinks.any():
            y, goal = u[0::2], target[0::2]
            part = np.where(sinks, y / np.where(sinks, y - goal, 1.0), np.inf)
            first = int(np.argmin(part))
            u += max(part[first], 0.0) * (target - u)
            u[2 * first] = 0.0
            active[first] = True
            continue
        u = target
        force = np.where(active, (dsbmv(3, 1.0, band, u) - load)[0::2], 0.0)
        if force.min() >= -_ROUNDING * weight:
            return u.reshape(-1, 2), force, count, True
        active[int(np.argmin(force))] = False
    return u.reshape(-1, 2), force, _EXCHANGES, False


def _minimum(band: Array, load: Array, active: Mask) -> Array:
    """Minimiser with y = 0 at the active nodes, shape (2 n + 2,)."""
    clamped = np.zeros(len(load), dtype=bool)
    clamped[0::2] = active
    free = np.where(clamped, 0.0, 1.0)
    fixed = band * free
    for k in (1, 2, 3):
        fixed[3 - k, k:] *= free[:-k]
    fixed[3] += clamped
    u = solveh_banded(fixed, load * free, check_finite=False)
    u[clamped] = 0.0
    return np.asarray(u)


def _residual(values: Array, force: Array, weight: float) -> Array:
    """Largest violation of y >= 0 [L], f >= 0, y f = 0 and vertical balance [weight], (B,)."""
    y, f = values[..., 0], force / weight
    gap = np.maximum(-y, 0).max(axis=1)
    push = np.maximum(-f, 0).max(axis=1)
    both = np.abs(y * f).max(axis=1)
    balance = np.abs(f.sum(axis=1) - 1)
    return np.max([gap, push, both, balance], axis=0)


class _Curve:
    """Material points on demand: Hermite cubics, with the load's quartic where the strip is up."""

    def __init__(self, length: float, values: Array, load: Array) -> None:
        self._length, self._values = length, values
        lying = np.abs(values).max(axis=2) < 1e-11
        flat = lying[:, :-1] & lying[:, 1:]
        self._quartic = np.where(flat, 0.0, -load / 24)
        self._count = load.shape[1]

    def __call__(self, s: Array) -> tuple[Array, Array]:
        u = np.asarray(s, dtype=float) / self._length * self._count
        index = np.clip(u.astype(int), 0, self._count - 1)
        y, _ = self._at(index, u - index)
        whole = np.cumsum(self._shortening(np.arange(self._count), np.ones(self._count)), axis=1)
        before = np.concatenate([np.zeros_like(whole[:, :1]), whole], axis=1)[:, index]
        x = u / self._count - before - self._shortening(index, u - index)
        return self._length * x, self._length * y

    def height(self) -> Array:
        """Greatest height, (B,): the maximum at 8 points an element, refined by a parabola."""
        fine = 8 * self._count
        y = self(np.linspace(0, self._length, fine + 1))[1]
        top = np.clip(np.argmax(np.nan_to_num(y), axis=1), 1, fine - 1)
        rows = np.arange(len(y))
        a, b, c = y[rows, top - 1], y[rows, top], y[rows, top + 1]
        bend = 2 * b - a - c
        rise = np.where(bend > 0, (c - a) ** 2 / (8 * np.where(bend > 0, bend, 1.0)), 0.0)
        return np.asarray(b + rise)

    def _at(self, index: NDArray[np.int_], t: Array) -> tuple[Array, Array]:
        """Height and slope at parameters t in [0, 1] of elements, each of shape (B, S)."""
        h = 1.0 / self._count
        y_a, slope_a = self._values[:, index, 0], self._values[:, index, 1] * h
        y_b, slope_b = self._values[:, index + 1, 0], self._values[:, index + 1, 1] * h
        rise = y_b - y_a
        c2 = 3 * rise - 2 * slope_a - slope_b
        c3 = slope_a + slope_b - 2 * rise
        c4 = self._quartic[:, index] * h**4
        y = y_a + t * (slope_a + t * (c2 + t * c3)) + c4 * (t * (1 - t)) ** 2
        slope = slope_a + t * (2 * c2 + 3 * t * c3) + c4 * 2 * t * (1 - t) * (1 - 2 * t)
        return y, slope / h

    def _shortening(self, index: NDArray[np.int_], t: Array) -> Array:
        """int (y')^2 / 2 over the first part t of elements, shape (B, S) (10)."""
        total = np.zeros((len(self._values), len(index)))
        for x, weight in zip(_GAUSS_X, _GAUSS_W, strict=True):
            _, slope = self._at(index, 0.5 * t * (1 + x))
            total += 0.25 * weight * t / self._count * slope**2
        return total
