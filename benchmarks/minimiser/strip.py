"""Numbers of a strip and its ground, told without the product's classes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_PIECES = 2000  # of a contact


@dataclass(frozen=True)
class Strip:
    """Numbers of one robot on one ground, SI; defaults are those of the paper's strip."""

    length: float = 0.130
    width: float = 0.040
    modulus: float = 1.8e6
    thickness: float = 4.0e-3
    chamber_height: float = 3.928e-3
    chamber_fraction: float = 0.7
    weight_per_length: float = 1.416
    segments: tuple[float, ...] = (1.0, 1.0, 1.0)
    roughness: float = 1e-7  # of skin and ground
    borders: tuple[float, ...] = ()  # between surfaces
    tips: tuple[float, ...] = (0.0,)  # V_t of each surface
    shears: tuple[float, ...] = (0.0,)  # tau
    back: float = 1.0  # bounds against motion back over those ahead
    # begin and end over L, factors ahead and back, bound besides, segment that switches it or -1
    feet: tuple[tuple[float, float, float, float, float, int], ...] = ()
    peak: float = 1.0  # pressure at which feet are switched on [Pa]
    # begin and end over L, weight [N]; alike for a point
    payload: tuple[tuple[float, float, float], ...] = ()

    def bending(self, pressure: Array) -> tuple[Array, Array]:
        """D and natural curvature, equations (9) and (3)."""
        d0 = self.modulus * self.width * self.thickness**3 / 12
        alpha = (6 * self.chamber_height**2 * self.chamber_fraction
                 / (self.modulus * self.thickness**3))  # fmt: skip
        eta = self.chamber_fraction * self.chamber_height**3 * self.width / 4
        return d0 + eta * np.abs(pressure), alpha * pressure

    def tip(self, x: float) -> float:
        return self.tips[int(np.searchsorted(self.borders, x, side="right"))]

    def side(self, begin: float, end: float) -> float:
        """The integral of tau q over a stretch [N]."""
        edges = np.array([-np.inf, *self.borders, np.inf])
        lengths = np.minimum(edges[1:], end) - np.maximum(edges[:-1], begin)
        return float(self.width * np.maximum(lengths, 0.0) @ np.array(self.shears))

    def shod(self, bound: float, begin: float, end: float, pressure: Array) -> Array:
        """Bounds ahead and back of a contact between two arclengths over L, summed over pieces."""
        pieces = begin + (end - begin) * (np.arange(_PIECES) + 0.5) / _PIECES
        grip, hold = np.ones((2, _PIECES)), 0.0
        for first, last, ahead, back, holds, segment in self.feet:
            on = 1.0 if segment < 0 else float(pressure[segment]) / self.peak
            under = (first <= pieces) & (pieces <= last)
            grip[:, under] = 1.0 + on * (np.array([[ahead], [back]]) - 1.0)
            part = under.mean() * (end - begin) / (last - first) if end > begin else under.mean()
            hold += on * holds * float(part)
        return np.asarray(grip.mean(axis=1) * bound + hold)

    def grains(self) -> tuple[Array, Array]:
        """Places over L and weights [N] of many small parts of the payload."""
        part = (np.arange(_PIECES) + 0.5) / _PIECES
        places = [begin + (end - begin) * part for begin, end, _ in self.payload]
        weights = [np.full(_PIECES, weight / _PIECES) for _, _, weight in self.payload]
        return np.concatenate([np.zeros(0), *places]), np.concatenate([np.zeros(0), *weights])
