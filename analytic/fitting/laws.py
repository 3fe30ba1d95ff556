"""Laws of a curve, of few numbers, and plays along a path, over pressures and bends of order 1."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LawName = Literal["affine", "quadratic", "power"]


class Shape(NamedTuple):
    """Numbers of a law.

    Attributes:
        names: of each, for tables.
        start: where a search begins.
        low, high: bounds.
    """

    names: tuple[str, ...]
    start: tuple[float, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]


_INF = float("inf")
SHAPES: Mapping[LawName, Shape] = MappingProxyType({
    "affine": Shape(("slope",), (1.0,), (0.0,), (_INF,)),
    "quadratic": Shape(("slope at rest", "slope at the top"), (1.0, 1.0), (0.0, 0.0), (_INF, _INF)),
    "power": Shape(("bend at the top", "exponent"), (1.0, 1.0), (0.0, 0.2), (_INF, 8.0)),
})  # fmt: skip


def bend(name: LawName, shape: tuple[float, ...], x: Array) -> Array:
    """Bend at pressures over the highest one."""
    x = np.maximum(x, 0.0)
    if name == "power":
        return np.asarray(shape[0] * x ** shape[1])
    slope = shape[-1] - shape[0]
    top = np.maximum(x, 0.0)
    if slope < 0:  # beyond the top of the parabola it stays
        top = np.minimum(top, -shape[0] / slope)
    return np.asarray(shape[0] * top + 0.5 * slope * top**2)


def acting(path: Array, play: tuple[float, ...], share: tuple[float, ...]) -> Array:
    """Pressures that act along a path, see analytic.scene.actuator."""
    if not play:
        return path
    result = (1.0 - sum(share)) * path
    for width, part in zip(play, share, strict=True):
        result += part * _play(np.maximum(path, 0.0), width)
    return result


def _play(path: Array, width: float) -> Array:
    """State of one play along a path from rest, (n,)."""
    state, states = 0.0, []
    for high in path.tolist():  # plain floats: numpy is slow on single numbers
        if state > high:
            state = high
        elif state < high - width:
            state = high - width
        states.append(state)
    return np.array(states)
