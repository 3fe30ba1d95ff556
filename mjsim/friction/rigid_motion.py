"""Motion of a rigid body in the plane nearest to those of points."""

_POINT = 1e-8  # m^2; points that are closer do not tell a turn


def rigid_motion(
    points: list[tuple[float, complex, complex]], origin: complex
) -> tuple[complex, float]:
    """Motion of a rigid body in the plane nearest to those of points, by weighted least squares.

    With x + i y for (x, y) it minimises sum w |m - s - i r p|^2 over s and r:
    r (sum w |p|^2 - |sum w p|^2 / W) = Im(sum w p* m - (sum w p)* (sum w m) / W), and
    s = (sum w m - i r sum w p) / W, with W = sum w.

    Args:
        points: weight w, place and displacement m of each [1, m, m]; p is its place from o.
        origin: o, about which the body turns [m].

    Returns:
        s and r [m, rad]; r is 0 where the points are too close to tell it.
    """
    total = square = 0.0
    place = move = product = 0j
    for weight, p, m in points:
        p -= origin
        total, place, move = total + weight, place + weight * p, move + weight * m
        square += weight * (p.conjugate() * p).real
        product += weight * (p.conjugate() * m)
    spread = square - (place.conjugate() * place).real / total
    turned = (product - place.conjugate() * move / total).imag
    turn = turned / spread if spread > _POINT * total else 0.0
    return (move - 1j * turn * place) / total, turn
