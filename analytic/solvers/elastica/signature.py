"""Signature of a state with friction: kinds of its contacts, and which of them slide."""

from typing import NamedTuple


class Signature(NamedTuple):
    """Contacts of a state, from left to right.

    Attributes:
        kinds: "tip", "side", or "between" where the bound would jump, see FixedPoint.
        weakest: whether none has a smaller bound.
        slips: -1, 0 or 1 as it slides towards -x, sticks or slides towards +x.
    """

    kinds: tuple[str, ...]
    weakest: tuple[bool, ...]
    slips: tuple[int, ...]

    @classmethod
    def of(
        cls, sides: list[bool], between: list[bool], weakest: list[bool], slips: list[int]
    ) -> "Signature":
        """Signature of contacts.

        Args:
            sides: whether each is one, else it is a tip.
            between: whether its bound would jump.
            weakest, slips: of each.
        """
        kinds = ["side" if side else "tip" for side in sides]
        return cls(
            tuple("between" if held else kind for held, kind in zip(between, kinds, strict=True)),
            tuple(weakest),
            tuple(slips),
        )

    def differs(self, before: "Signature") -> bool:
        """Tell whether other contacts slide than before, or might have on the way."""
        slid = any(self.slips) and any(before.slips) and (
            [slip != 0 for slip in self.slips] != [slip != 0 for slip in before.slips]
        )  # fmt: skip
        return slid or (self.kinds, self.weakest) != (before.kinds, before.weakest)

    def turned(self, before: "Signature") -> bool:
        """Tell whether a contact that slid before has stopped, from where it may slide back."""
        return any(was and now != was for now, was in zip(self.slips, before.slips, strict=False))


UNSETTLED = Signature((), (), ())  # of a state that was not found
