"""The robot: a strip of pneu-net segments, as plain data."""

import math
from dataclasses import dataclass, fields
from itertools import accumulate

PSI = 6894.757293168  # Pa in a pound-force per square inch (NIST SP 811)
THREE_EQUAL = (1.0, 1.0, 1.0)  # [Majidi13], section 2.3


@dataclass(frozen=True)
class Robot:
    """A planar strip of segments, each one a pneu-net of the same design.

    The defaults give an undulation of about a quarter of the length, the paper's optimum.

    Raises:
        ValueError: a value is not a positive finite number, there is no segment, or
            chamber_fraction exceeds 1.
    """

    length: float = 0.130  # L [m]; chosen
    width: float = 0.040  # q, also the depth "w" of (1)-(9) [m]; chosen
    modulus: float = 1.8e6  # E of the strain-limiting layer [Pa]; chosen (PDMS)
    thickness: float = 4.0e-3  # t of the strain-limiting layer [m]; chosen
    chamber_height: float = 4.1e-3  # H [m]; chosen
    chamber_fraction: float = 0.7  # c/x, chamber width over the arclength it occupies [1]; chosen
    weight_per_length: float = 2.0  # w of Appendix A [N/m]; chosen
    peak_pressure: float = 7.0 * PSI  # p [Pa]; [Majidi13], section 3
    segments: tuple[float, ...] = THREE_EQUAL  # their lengths, left first, in any common unit

    def __post_init__(self) -> None:
        if not self.segments:
            raise ValueError("segments must be at least one length, got none")
        for length in self.segments:
            if not (math.isfinite(length) and length > 0):
                raise ValueError(f"segments must be positive finite lengths, got {length!r}")
        for field in fields(self):
            if field.name == "segments":
                continue
            value = getattr(self, field.name)
            if not (isinstance(value, int | float) and math.isfinite(value) and value > 0):
                raise ValueError(f"{field.name} must be a positive finite number, got {value!r}")
        if self.chamber_fraction > 1:
            raise ValueError(
                f"chamber_fraction must lie in (0, 1], got {self.chamber_fraction!r}: "
                "a chamber cannot be wider than the strip it sits on"
            )

    @property
    def segment_length(self) -> float:
        """Mean length of a segment, the unit of area in friction [m]."""
        return self.length / len(self.segments)

    @property
    def borders(self) -> tuple[float, ...]:
        """Where segments begin and end, both ends of the strip included, over its length [1]."""
        total = sum(self.segments)
        inner = accumulate(self.segments[:-1])
        return (0.0, *(end / total for end in inner), 1.0)
