"""Every mode satisfies Appendix A's boundary conditions, set up here as the paper prints them."""

import numpy as np
import pytest

from analytic import Flag, Mode, Robot, solve_modes
from analytic.scene import pneunet

BORDERS = (0.0, 1 / 3, 2 / 3, 1.0)
SEGMENTS_OF_MODE = {
    Mode.TIP: (0, 2), Mode.LEFT_1: (0, 2), Mode.LEFT_2: (1, 2), Mode.LEFT_3: (2, 2),
    Mode.RIGHT_1: (0, 0), Mode.RIGHT_2: (0, 1), Mode.RIGHT_3: (0, 2),
}  # fmt: skip


def polynomial_row(derivative, s):
    """d^n/ds^n of (s^3/6, s^2/2, s, 1), the coefficients of (11)."""
    rows = {
        0: (s**3 / 6, s**2 / 2, s, 1),
        1: (s**2 / 2, s, 1, 0),
        2: (s, 1, 0, 0),
        3: (1, 0, 0, 0),
    }
    return np.array(rows[derivative], dtype=float)


def load_term(derivative, s, g):
    return -g * {0: s**4 / 24, 1: s**3 / 6, 2: s**2 / 2, 3: s}[derivative]


def solve_appendix_a(k, g, first, last, begin, end):
    """Constants a, b, c, d of segments first..last by the linear system, lengths over L.

    Returns them with a function that evaluates y and its derivatives.
    """
    count = last - first + 1
    matrix, right = np.zeros((4 * count, 4 * count)), np.zeros(4 * count)
    row = 0

    def put(terms, value):
        nonlocal row
        for factor, segment, derivative, s in terms:
            block = slice(4 * (segment - first), 4 * (segment - first) + 4)
            matrix[row, block] += factor * polynomial_row(derivative, s)
            value -= factor * load_term(derivative, s, g[segment])
        right[row] = value
        row += 1

    put([(1, first, 0, begin)], 0.0)  # y = 0 at both ends of the lifted part
    put([(1, last, 0, end)], 0.0)
    put([(1, first, 2, begin)], -k[first])  # no moment there; arching curves down
    put([(1, last, 2, end)], -k[last])
    for i in range(first, last):
        s, stiff, following = BORDERS[i + 1], 1 / g[i], 1 / g[i + 1]
        put([(1, i, 0, s), (-1, i + 1, 0, s)], 0.0)
        put([(1, i, 1, s), (-1, i + 1, 1, s)], 0.0)
        put([(stiff, i, 2, s), (-following, i + 1, 2, s)], following * k[i + 1] - stiff * k[i])
        put([(stiff, i, 3, s), (-following, i + 1, 3, s)], 0.0)
    constants = np.linalg.solve(matrix, right).reshape(count, 4)

    def evaluate(s, derivative, segment):
        row = polynomial_row(derivative, s)
        return row @ constants[segment - first] + load_term(derivative, s, g[segment])

    return evaluate


def random_states():
    """Shapes of robots and states that between them meet every mode."""
    rng = np.random.default_rng(7)
    for gamma in (3.0, 11.4, 30.0, 80.0):
        base = Robot()
        robot = Robot(weight_per_length=gamma * pneunet.base_rigidity(base) / base.length**3)
        fractions = rng.uniform(0, 1, (400, 3)) ** 3 * (rng.uniform(0, 1, (400, 3)) < 0.7)
        pressures = fractions * robot.peak_pressure
        yield robot, pressures, solve_modes(robot, pressures)


def test_the_modes_are_the_solutions_of_appendix_a_to_1e_9():
    met = set()
    for robot, pressures, shapes in random_states():
        s = np.linspace(0, robot.length, 61)
        _, heights = shapes.curve(s)
        k = pneunet.natural_curvature(robot, pressures) * robot.length
        g = robot.weight_per_length * robot.length**3 / pneunet.rigidity(robot, pressures)
        for i, mode in enumerate(Mode(m) for m in shapes.mode):
            if mode == Mode.FLAT or shapes.status[i] & Flag.NO_ROOT:
                continue
            met.add(mode)
            begin = shapes.contact_left[i] / robot.length
            end = 1 - shapes.contact_right[i] / robot.length
            first, last = SEGMENTS_OF_MODE[mode]
            assert BORDERS[first] <= begin <= BORDERS[first + 1]
            assert BORDERS[last] <= end <= BORDERS[last + 1]
            y = solve_appendix_a(k[i], g[i], first, last, begin, end)

            if mode in (Mode.LEFT_1, Mode.LEFT_2, Mode.LEFT_3):  # the thirteenth condition
                assert abs(y(begin, 1, first)) < 1e-9
            elif mode != Mode.TIP:
                assert abs(y(end, 1, last)) < 1e-9
            for point, height in zip(s / robot.length, heights[i] / robot.length, strict=True):
                segment = min(int(np.searchsorted(BORDERS[1:3], point, side="right")), 2)
                inside = begin <= point <= end
                segment = min(max(segment, first), last)
                assert height == pytest.approx(y(point, 0, segment) if inside else 0, abs=1e-9)
    assert met == set(SEGMENTS_OF_MODE)


def test_the_end_that_is_a_tip_slopes_away_from_the_ground_where_status_says_so():
    for robot, _, shapes in random_states():
        near = np.array([0.0, 1e-4, 1 - 1e-4, 1.0]) * robot.length
        _, y = shapes.curve(near)
        fine = (shapes.status & (Flag.BOTH_FLAT | Flag.NO_ROOT | Flag.PENETRATES)) == 0
        assert (y[fine, 1] >= -1e-12).all()
        assert (y[fine, 2] >= -1e-12).all()
