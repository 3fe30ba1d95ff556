import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from analytic.solvers.modes.cubic import real_cubic_roots

numbers = st.floats(-10, 10)


@given(st.tuples(numbers, numbers, numbers), st.floats(0.1, 10))
def test_three_real_roots_are_found(roots, leading):
    roots = np.sort(roots)
    if np.diff(roots).min() < 1e-2:
        return
    _, b, c, d = leading * np.poly(roots)
    solved = np.sort(real_cubic_roots(leading, b, c, d))
    assert np.allclose(solved, roots, atol=1e-8)


@given(numbers, numbers, st.floats(0.1, 10), st.floats(0.1, 10))
def test_a_lone_real_root_comes_first(root, middle, gap, leading):
    quadratic = np.array([1, -2 * middle, middle**2 + gap])
    a, b, c, d = leading * np.polymul([1, -root], quadratic)
    roots = real_cubic_roots(a, b, c, d)
    assert np.isclose(roots[0], root, atol=1e-7)
    assert np.isnan(roots[1:]).all()


def test_a_triple_root_and_a_batch_keep_their_shapes():
    roots = real_cubic_roots(np.ones((2, 3)), 0.0, 0.0, -8 * np.ones((2, 3)))
    assert roots.shape == (2, 3, 3)
    assert np.allclose(roots[..., 0], 2)
    assert np.isclose(real_cubic_roots(1.0, -3.0, 3.0, -1.0)[0], 1.0)
