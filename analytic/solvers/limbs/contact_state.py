"""Contacts of limbs, and limbs on the ground as the search for them sees these."""

from typing import NamedTuple

TETHER = "tether"


class Contact(NamedTuple):
    """Contact of one limb with the ground, or the tether that it drags.

    Attributes:
        limb: its place.
        part: of the limb, "begin", "end" or "between" them; or TETHER.
        length: of side contact, 0 for a tip [m].
        at, aside: arclengths of the points that it resists at, and how far to the left of the
            middle line each is [m].
        load: normal force on the whole, of a tether its drag [N].
    """

    limb: int
    part: str
    length: float
    at: tuple[float, ...]
    aside: tuple[float, ...]
    load: float

    @property
    def middle(self) -> float:
        """Arclength of its middle [m]."""
        return 0.5 * (self.at[0] + self.at[-1])


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
