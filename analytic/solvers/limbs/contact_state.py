"""Limbs on the ground as the search for their contacts sees them."""

from typing import NamedTuple


class ContactState(NamedTuple):
    """Forces [N] and heights [m] of each limb's vertices, and how it bends at its two ends.

    By pressure an end stands on its tip (1), may lie flat (0), or curls up (-1). Noted during the
    search: forces that limbs which lie flat pass on to ends of carriers, and ends of carriers where
    a limb is flat, or nearly.
    """

    force: list[list[float]]
    height: list[list[float]]
    bends: list[list[int]]
    passed: dict[tuple[int, str], float]
    reached: set[tuple[int, str]]
