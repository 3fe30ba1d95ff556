"""Numbers of a strip and its ground, told without the product's classes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


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
