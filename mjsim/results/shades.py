"""Colour of a chamber by its pressure: pale while it is passive, dark at the peak pressure."""

import numpy as np
from numpy.typing import NDArray

from mjsim.model.bodies.parts import DARK, PALE


def shade(fraction: float) -> NDArray[np.float64]:
    """Colour at a part of the peak pressure, of either sign, red, green and blue, (3,) [0..1]."""
    pale, dark = np.array(PALE), np.array(DARK)
    return pale + min(abs(fraction), 1.0) * (dark - pale)


def shade_of_pixels(fraction: float) -> tuple[int, ...]:
    """Colour at a part of the peak pressure in the numbers of a picture, (3,) [0..255]."""
    return tuple(np.rint(255 * shade(fraction)).astype(int).tolist())
