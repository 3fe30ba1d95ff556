"""Size of a pixel and pictures per second, of tables of markers that a tracker wrote."""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from mjsim.files.csv_table import CsvTable, head_of

FRAME, PIXEL = "frame", "px"


class Camera(NamedTuple):
    """Scales that turn pixels and numbers of pictures into metres and seconds.

    Attributes:
        pixel: size of a pixel on the robot [m]; None if it is not known.
        frame_rate: pictures per second [1/s]; None if it is not known.
    """

    pixel: float | None = None
    frame_rate: float | None = None

    def check(self, tables: Sequence[CsvTable]) -> None:
        """Check what is known of the camera, and that some table has such columns.

        Raises:
            ValueError: a number is none above 0, or is of no column.
        """
        heads = [head for table in tables for head in table.heads]
        units = {_unit(head) for head in heads}
        for name, value, unit in zip(self._fields, self, (PIXEL, FRAME), strict=True):
            if value is not None and not (value > 0 and math.isfinite(value)):
                raise ValueError(f"{name} must be a number above 0, got {value:g}")
            if value is not None and unit not in units:
                raise ValueError(f"{name} is for columns of {unit}, got {', '.join(heads)}")

    def units(self, where: str, heads: Iterable[str]) -> dict[str, float]:
        """Sizes in SI of the units that columns have, by what heads call them.

        Raises:
            ValueError: a column is of pixels or of pictures, and what one is is not known.
        """
        sizes = {}
        for head in heads:
            if _unit(head) == PIXEL:
                sizes[PIXEL] = _known(self.pixel, f"{where}: column {head!r} needs --pixel, the "
                                      "size of a pixel, as 0.25mm")  # fmt: skip
            elif _unit(head) == FRAME:
                sizes[FRAME] = 1 / _known(self.frame_rate, f"{where}: column {head!r} needs "
                                          "--frame-rate, pictures per second, as 30")  # fmt: skip
        return sizes


def _unit(head: str) -> str:
    return head_of(head).unit or head.strip().lower()


def _known(value: float | None, message: str) -> float:
    if value is None:
        raise ValueError(message)
    return value
