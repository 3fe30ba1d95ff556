"""Picture of measured and fitted actuators."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from mjsim.files.files import whole
from mjsim.fitting.actuator import SHOWN, Fitted


def draw(fitted: Sequence[Fitted], path: Path) -> None:
    """Draw a pair of axes per actuator: bend over pressure above, what is missed below.

    Args:
        fitted: actuators.
        path: of the picture; it appears when it is whole.

    Raises:
        OSError: it cannot be written.
    """
    from matplotlib.figure import Figure

    columns = len(fitted)
    with mpl.rc_context({"font.size": 8, "axes.titlesize": 8}):
        figure = Figure(figsize=(4.6 * columns, 4.2), layout="constrained", dpi=110)
        grid = figure.subplots(2, columns, squeeze=False, sharex="col",
                               gridspec_kw={"height_ratios": [3, 1]})  # fmt: skip
        for each, top, low in zip(fitted, grid[0], grid[1], strict=True):
            _draw_one(each, top, low)
        with whole(path) as part:
            figure.savefig(part)


def _draw_one(each: Fitted, top: Any, low: Any) -> None:
    unit, factor = SHOWN.get(each.benches[0].unit, (each.benches[0].unit, 1.0))
    missed = zip(each.benches, each.fit.residuals, each.affine.residuals, strict=True)
    for number, (bench, residual, affine) in enumerate(missed):
        kilopascals, only = 1e-3 * bench.pressure, number == 0
        top.plot(kilopascals, factor * bench.bend, ".", color="0.6", ms=3,
                 label="measured" if only else None)  # fmt: skip
        top.plot(kilopascals, factor * (bench.bend + residual), "-", color="C0", lw=1.2,
                 label=f"{each.fit.law}, {len(each.fit.play)} plays" if only else None)  # fmt: skip
        low.plot(kilopascals, factor * affine, "-", color="C1", lw=0.8)
        low.plot(kilopascals, factor * residual, ".", color="C0", ms=2)
    line = 1e-3 * np.array([0.0, each.affine.reached])
    top.plot(line, factor * each.affine.bend(1e3 * line), "--", color="C1", lw=1, label="affine")
    top.set_title(each.name or ", ".join(bench.name for bench in each.benches))
    top.set_ylabel(f"{'angle' if unit == 'deg' else 'curvature'} [{unit}]")
    low.set_ylabel(f"fit less\ndata [{unit}]")
    low.set_xlabel("pressure [kPa]")
    low.axhline(0.0, color="0.8", lw=0.8, zorder=0)
    top.legend()
