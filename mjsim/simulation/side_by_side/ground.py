"""Ground under many strips at once: properties of the surfaces that each stands on, as arrays."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from analytic.scene.ground import surfaces_of
from mjsim.scene import Scene

Array = NDArray[np.float64]
Indices = NDArray[np.int_]

_PROPERTIES = (
    "shear_strength", "tip_force", "friction", "tip_friction", "viscosity", "static_ratio",
    "stribeck_speed",
)  # fmt: skip


class GroundRows:
    """Grounds of as many surfaces each, one row per scene.

    Args:
        scenes: on uniform ground, or on patches.

    Attributes:
        by_speed: whether a ground resists by speed, (B,).
        changes: whether grounds change along x.
    """

    def __init__(self, scenes: Sequence[Scene]) -> None:
        grounds = [scene.ground for scene in scenes]
        borders = [getattr(ground, "borders", ()) for ground in grounds]
        self._edges = np.array([(-np.inf, *inner, np.inf) for inner in borders])
        self._values = {
            name: np.array([[getattr(s, name) for s in surfaces_of(g)] for g in grounds], float)
            for name in _PROPERTIES
        }
        self.by_speed = np.array([
            any(surface.depends_on_speed for surface in surfaces_of(g)) for g in grounds
        ])  # fmt: skip
        self.changes = self._edges.shape[1] > 2

    def replace(self, rows: Indices, other: "GroundRows") -> None:
        """Put other grounds of as many surfaces in some rows."""
        self._edges[rows], self.by_speed[rows] = other._edges, other.by_speed
        for name, values in self._values.items():
            values[rows] = other._values[name]

    def at(self, name: str, rows: Indices, x: Array) -> Array:
        """Property of the surface at places, one row per scene (R, K) [m]."""
        return np.take_along_axis(self._values[name][rows], self._surface(rows, x), axis=1)

    def over(self, name: str, rows: Indices, begin: Array, length: Array) -> Array:
        """Mean of a property over stretches, (R, K) [m]; of no length, at their beginning.

        See analytic.scene.ground.over.
        """
        if not self.changes:
            return self._values[name][rows]
        edges, values = self._edges[rows][:, None], self._values[name][rows]
        inside = np.minimum((begin + length)[..., None], edges[..., 1:]) - np.maximum(
            begin[..., None], edges[..., :-1]
        )
        under, each = inside > 0, values[:, None]
        low, high = np.where(under, each, np.inf).min(-1), np.where(under, each, -np.inf).max(-1)
        begins = np.take_along_axis(values, self._surface(rows, begin), axis=1)
        alone = np.where(length > 0, high, begins)
        mean = (each * np.where(under, inside, 0.0)).sum(-1) / np.where(length > 0, length, 1.0)
        return np.where((length > 0) & (low < high), mean, alone)

    def at_speed(self, rows: Indices, x: Array, speed: Array) -> Array:
        """Dry friction at speeds over that of fast sliding, (R, K); see Surface.at_speed."""
        ratio = self.at("static_ratio", rows, x)
        slow = np.where(ratio > 1, self.at("stribeck_speed", rows, x), 1.0)
        return np.asarray(1.0 + (ratio - 1.0) * np.exp(-((speed / slow) ** 2)))

    def _surface(self, rows: Indices, x: Array) -> Indices:
        return np.asarray((self._edges[rows][:, None, 1:-1] <= x[..., None]).sum(axis=-1))
