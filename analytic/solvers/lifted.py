"""The contact modes of [Majidi13] with finite rotations: the lifted part as an elastica.

As in the modes of Appendix A the strip touches the ground at two tips, or lies flat at one end up
to a lift-off point xi; but the lifted part may turn by any angle. Friction pulls at nothing, so the
moment there follows from weight and reaction alone,

    M(s) = R (x_b - x(s)) - w int_s^b (x - x(s)) ds,   R = w int_a^b (x - x_a) ds / (x_b - x_a),
    theta'(s) = M(s) / D - kappa,

and is right for the places x of the last pass: a few passes converge, on Chebyshev nodes between
the borders of the segments, over all states at once. What is left is one number a state, from the
end's height y_b = 0: the slope of a tip, in closed form, or xi by the secant method.

Exact contact holds where no state is flagged, see analytic.uncertainty.modes_error.

Dimensionless inside: lengths over L, rigidity over D0.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene import pneunet
from analytic.scene.feet import refuse_proud
from analytic.scene.payload import refuse_payload
from analytic.scene.pressures import check_pressures
from analytic.scene.robot import Robot
from analytic.shapes import Flag, Shapes

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_NODES = 7  # between two borders: 1e-5 of L in the separation
_PASSES, _SECANTS = 80, 40
_BETWEEN = 3  # passes before the lift-off point is moved again
_CONVERGED = 1e-8  # change of slopes [rad] and lift-off points over L in a pass
_CLOSED = 1e-6  # height of the far end over L
_LONGEST_MOVE = 0.05  # of a lift-off point over L at once
_GRID = 60  # places at which the sign of the end's height is looked at first
_TOLERANCE = 1e-7  # of slopes and heights over L, below which they are none
_FLAT = 1e-12  # kappa L below which a strip is as good as flat

_U = 0.5 * (1 - np.cos(np.pi * np.arange(_NODES) / (_NODES - 1)))
_TO_POWERS = np.linalg.inv(np.vander(_U, _NODES, increasing=True))
_INTEGRATE = (
    np.vander(_U, _NODES + 1, increasing=True)[:, 1:] / np.arange(1, _NODES + 1)
) @ _TO_POWERS


class _Beam(NamedTuple):
    """States: natural curvature and rigidity of the segments, (B, S), weight, borders (S + 1,)."""

    curvature: Array
    rigidity: Array
    weight: float
    borders: Array

    def rows(self, chosen: Any) -> "_Beam":
        return self._replace(curvature=self.curvature[chosen], rigidity=self.rigidity[chosen])


def solve_lifted(robot: Robot, pressures_pa: ArrayLike) -> Shapes:
    """Equilibria with two tips, or one end flat and the other a tip, at any rotation.

    Which end lies flat is decided as in the modes: one whose slope between two tips points into the
    ground, if both do the steeper one.

    Args:
        robot: the strip.
        pressures_pa: segment pressures, left first, shape (B, S) or (S,) [Pa], at least 0.

    Returns:
        Shapes of B states; `status` says where the assumptions break.

    Raises:
        ValueError: the shape is wrong, a pressure is negative or not finite, or the strip carries a
            payload.
    """
    p = check_pressures(robot, pressures_pa)
    refuse_payload(robot, "the contact modes with finite rotations")
    refuse_proud(robot.feet, "the contact modes with finite rotations")
    d0 = pneunet.base_rigidity(robot)
    beam = _Beam(
        np.asarray(pneunet.natural_curvature(robot, p)) * robot.length,
        np.asarray(pneunet.rigidity(robot, p)) / d0,
        robot.weight_per_length * robot.length**3 / d0,
        np.asarray(robot.borders, dtype=float),
    )
    count = len(p)
    xi, status = np.zeros(count), np.full(count, int(Flag.OK))
    flat: Mask = np.asarray((beam.curvature <= _FLAT).all(axis=1))
    slope, converged = _tips(beam)
    into_left, into_right = -slope[:, 0, 0], slope[:, -1, -1]
    lies = (np.maximum(into_left, into_right) > _TOLERANCE) & ~flat
    mirrored: Mask = np.asarray(lies & (into_right > into_left + _TOLERANCE))
    rows = np.flatnonzero(lies)
    if len(rows):
        turned = mirrored[rows, None]
        part = beam.rows(rows)._replace(
            curvature=np.where(turned, beam.curvature[rows, ::-1], beam.curvature[rows]),
            rigidity=np.where(turned, beam.rigidity[rows, ::-1], beam.rigidity[rows]),
        )
        xi[rows], slope[rows], exists, converged[rows] = _one_flat(part, mirrored[rows])
        status[rows[~exists]] |= int(Flag.NO_ROOT)
    status[~converged & (status == 0)] |= int(Flag.NOT_CONVERGED)
    blank = np.where(status & int(Flag.NO_ROOT | Flag.NOT_CONVERGED), np.nan, robot.length)

    curve = _Curve(robot.length, beam, mirrored, xi, slope, flat, blank)
    # an end that lies flat has slope 0 there, so this looks at the ends in point contact only
    sinking = np.maximum(-slope[:, 0, 0], slope[:, -1, -1]) > 100 * _TOLERANCE
    status[sinking & ~flat] |= int(Flag.BOTH_FLAT)
    status[~flat & (curve.height.min(axis=(1, 2)) < -10 * _TOLERANCE)] |= int(Flag.PENETRATES)
    lying = np.diff(beam.borders) - curve.spans > _TOLERANCE
    status[lies & (lying & (beam.curvature > _FLAT)).any(axis=1)] |= int(Flag.HELD_FLAT)

    return Shapes(
        robot=robot,
        separation=np.where(flat, 1.0, xi + curve.x[:, -1, -1]) * blank,
        contact_left=np.where(flat, 0.5, np.where(mirrored, 0.0, xi)) * blank,
        contact_right=np.where(flat, 0.5, np.where(mirrored, xi, 0.0)) * blank,
        amplitude=np.where(flat, 0.0, curve.height.max(axis=(1, 2))) * blank,
        status=status,
        curve=curve,
    )


def _cumulative(values: Array, spans: Array) -> Array:
    """Integral from the lift-off point to each node, (B, S, N)."""
    within = (values @ _INTEGRATE.T) * spans[..., None]
    before = np.cumsum(within[..., -1], axis=1) - within[..., -1]
    return np.asarray(within + before[..., None])


def _bent(beam: _Beam, spans: Array, slope: Array) -> Array:
    """Slopes that the moments at these slopes bend to, from 0 at the lift-off point, (B, S, N)."""
    x = _cumulative(np.cos(slope), spans)
    arclength = _cumulative(np.ones_like(slope), spans)
    first = _cumulative(x, spans)
    whole, length = first[:, -1:, -1:], arclength[:, -1:, -1:]
    end = np.where(x[:, -1:, -1:] == 0.0, 1.0, x[:, -1:, -1:])
    moment = whole / end * (x[:, -1:, -1:] - x) - (whole - first) + x * (length - arclength)
    bending = beam.weight * moment / beam.rigidity[..., None] - beam.curvature[..., None]
    return _cumulative(bending, spans)


def _tips(beam: _Beam) -> tuple[Array, Mask]:
    """Slopes between two tips, (B, S, N), and which states converged."""
    count, segments = beam.curvature.shape
    slope, moved = np.zeros((count, segments, _NODES)), np.full(count, np.inf)
    spans = np.broadcast_to(np.diff(beam.borders), (count, segments))
    for _ in range(_PASSES):
        rows = np.flatnonzero(moved > _CONVERGED)
        if not len(rows):
            break
        bent = _bent(beam.rows(rows), spans[rows], slope[rows])
        rise = _cumulative(np.sin(bent), spans[rows])[:, -1, -1]
        run = _cumulative(np.cos(bent), spans[rows])[:, -1, -1]
        bent -= np.arctan2(rise, run)[:, None, None]  # so that the far end is at the ground
        moved[rows] = np.abs(bent - slope[rows]).max(axis=(1, 2))
        slope[rows] = bent
    return slope, moved <= _CONVERGED


def _one_flat(beam: _Beam, mirrored: Mask) -> tuple[Array, Array, Mask, Mask]:
    """Lift-off points and slopes with the left end flat, which of them exist and which converged.

    Args:
        beam: the states as seen from their flat end.
        mirrored: those that are seen from their right end; their slopes are turned back.
    """
    borders = np.where(mirrored[:, None], 1.0 - beam.borders[::-1], beam.borders)
    count, segments = beam.curvature.shape

    def end_height(rows: NDArray[np.int_], xi: Array) -> Array:
        ends = np.maximum(borders[rows], xi[:, None])  # what lies flat has no span
        spans = np.diff(ends)
        for _ in range(_BETWEEN):
            slope[rows] = _bent(beam.rows(rows), spans, slope[rows])
        return np.asarray(_cumulative(np.sin(slope[rows]), spans)[:, -1, -1])

    slope = np.zeros((count, segments, _NODES))
    xi, exists = _first_guess(beam, borders)
    before = np.clip(xi - 0.002, 0.0, 1.0)
    everything = np.arange(count)
    end_height(everything, before)  # twice, as the first passes begin from a straight strip
    height_before, height = end_height(everything, before), end_height(everything, xi)
    moved = np.where(exists, np.inf, 0.0)
    for _ in range(_SECANTS):
        rows = np.flatnonzero((moved > _CONVERGED) | (exists & (np.abs(height) > _CLOSED)))
        if not len(rows):
            break
        rise = height[rows] - height_before[rows]
        rise = np.where(np.abs(rise) < 1e-15, np.copysign(1e-15, rise), rise)
        step = -height[rows] * (xi[rows] - before[rows]) / rise
        step = np.clip(step, -_LONGEST_MOVE, _LONGEST_MOVE)
        before[rows], height_before[rows] = xi[rows], height[rows]
        xi[rows] = np.clip(xi[rows] + step, 0.0, 1.0 - 1e-6)
        moved[rows] = np.abs(xi[rows] - before[rows])
        height[rows] = end_height(rows, xi[rows])
    slope[mirrored] = -slope[mirrored, ::-1, ::-1]
    return xi, slope, exists, np.abs(height) <= _CLOSED


def _first_guess(beam: _Beam, borders: Array) -> tuple[Array, Mask]:
    """Lift-off points nearest the flat end by small slopes, and which states have one.

    With X = 1 - xi the end's height is F(X) = int_0^X v (-kappa + g v (X - v) / 2) dv, v from the
    far end (Appendix A), over the rigidity of each segment.
    """
    x = np.linspace(0.0, 1.0, _GRID + 1)[1:]
    from_end = 1.0 - borders[:, ::-1]  # (B, S + 1)
    low, high = from_end[:, None, :-1], np.minimum(from_end[:, None, 1:], x[:, None])
    high = np.maximum(low, high)
    k, g = beam.curvature[:, None, ::-1], beam.weight / beam.rigidity[:, None, ::-1]
    square, cube, fourth = (
        (power * (high**n - low**n) / n).sum(axis=2) for n, power in ((2, k), (3, g), (4, g))
    )
    height = -square + 0.5 * x * cube - 0.5 * fourth
    crossing = (height[:, 1:] > 0) != (height[:, :-1] > 0)
    nearest = crossing.shape[1] - 1 - np.argmax(crossing[:, ::-1], axis=1)
    rows = np.arange(len(height))
    low, high = height[rows, nearest], height[rows, nearest + 1]
    part = np.clip(low / np.where(low == high, 1.0, low - high), 0, 1)
    exists = crossing.any(axis=1)
    return np.where(exists, 1.0 - (x[nearest] + part * (x[1] - x[0])), 0.5), exists


class _Curve:
    """Places of the lifted part's nodes, from its left end, and the strip's points on demand."""

    def __init__(
        self, length: float, beam: _Beam, mirrored: Mask, xi: Array, slope: Array, flat: Mask,
        blank: Array,
    ) -> None:  # fmt: skip
        self._length = length
        self._flat, self._blank, self._borders = flat[:, None], blank[:, None], beam.borders
        # where the lifted part begins and ends, from the left
        self._begin = np.where(mirrored, 0.0, xi)[:, None]
        self._end = np.where(mirrored, 1.0 - xi, 1.0)[:, None]
        self._low = np.clip(beam.borders[:-1], self._begin, self._end)
        self.spans = np.clip(beam.borders[1:], self._begin, self._end) - self._low
        self.x = _cumulative(np.cos(slope), self.spans)
        self.height = _cumulative(np.sin(slope), self.spans)

    def __call__(self, s: Array) -> tuple[Array, Array]:
        """See Shapes.curve; by the polynomials through the nodes."""
        u = np.asarray(s, dtype=float) / self._length
        segment = np.clip(np.searchsorted(self._borders, u, side="right") - 1, 0,
                          self.spans.shape[1] - 1)  # fmt: skip
        span = self.spans[:, segment]
        within = np.clip((u - self._low[:, segment]) / np.where(span > 0, span, 1.0), 0.0, 1.0)
        powers = within[..., None] ** np.arange(_NODES)
        x, y = ((powers * (values @ _TO_POWERS.T)[:, segment]).sum(axis=-1)
                for values in (self.x, self.height))  # fmt: skip
        before = np.minimum(u, self._begin)
        after = np.maximum(u - self._end, 0.0)
        x, y = before + x + after, np.where(after > 0, 0.0, y)
        x, y = np.where(self._flat, u, x), np.where(self._flat, 0.0, y)
        return self._blank * x, self._blank * y
