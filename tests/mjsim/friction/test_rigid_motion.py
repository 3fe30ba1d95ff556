"""The rigid motion of anchored points is that of weighted least squares."""

import numpy as np
import pytest

from mjsim.friction.rigid_motion import rigid_motion


@pytest.mark.parametrize("seed", range(5))
def test_it_is_the_least_squares_solution_over_shift_and_turn(seed):
    rng = np.random.default_rng(seed)
    weight = rng.uniform(0.1, 2.0, 5)
    place, move, origin = rng.normal(size=(5, 2)), rng.normal(size=(5, 2)), rng.normal(size=2)
    arm = place - origin
    # rows of (u - r y, v + r x) for each point
    matrix = np.zeros((10, 3))
    matrix[0::2, 0], matrix[1::2, 1] = 1.0, 1.0
    matrix[0::2, 2], matrix[1::2, 2] = -arm[:, 1], arm[:, 0]
    root = np.repeat(np.sqrt(weight), 2)
    expected = np.linalg.lstsq(root[:, None] * matrix, root * move.ravel(), rcond=None)[0]
    points = [
        (w, complex(*p), complex(*m))
        for w, p, m in zip(weight.tolist(), place.tolist(), move.tolist(), strict=True)
    ]
    shift, turn = rigid_motion(points, complex(*origin))
    assert (shift.real, shift.imag, turn) == pytest.approx(expected, abs=1e-12)


def test_one_point_tells_no_turn():
    assert rigid_motion([(2.0, 1 + 2j, 0.1 - 0.3j)], 0j) == (pytest.approx(0.1 - 0.3j), 0.0)
