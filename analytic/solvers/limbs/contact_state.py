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
        begin: arclength where a side begins [m].
        share: parts of its points in that load [1]; none where all are alike.
    """

    limb: int
    part: str
    length: float
    at: tuple[float, ...]
    aside: tuple[float, ...]
    load: float
    begin: float = 0.0
    share: tuple[float, ...] = ()

    @property
    def middle(self) -> float:
        """Arclength of its middle, of its load where it resists by that [m]."""
        if not self.share:
            return 0.5 * (self.at[0] + self.at[-1])
        return sum([part * at for part, at in zip(self.share, self.at, strict=True)])

    @property
    def stretch(self) -> tuple[float, float]:
        """Arclengths between which it is, the same of a tip [m]."""
        if self.share:
            return self.begin, self.begin + self.length
        half = 0.5 * self.length
        return self.middle - half, self.middle + half

    @property
    def shares(self) -> tuple[float, ...]:
        """Parts of its points in its resistance [1]."""
        return self.share or (1 / len(self.at),) * len(self.at)


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
