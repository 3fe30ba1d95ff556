"""Data, model and what is left, as a picture."""

import math
from pathlib import Path

import matplotlib as mpl
import numpy as np

from mjsim.files.files import whole
from mjsim.fitting.estimate import Estimate

_LABEL = {"time": "time [s]", "pressure": "pressure [kPa]", "run": "run"}
_COLUMNS = 3
_RASTER = 100
_FAR = 5.0  # deviations: what is farther off is drawn at the edge, in red


def draw(estimate: Estimate, path: Path) -> None:
    """A pair of axes a series: data and model above, residuals over the noise below.

    Args:
        estimate: of a fit.
        path: of the picture; it appears when it is whole.

    Raises:
        OSError: it cannot be written.
    """
    from matplotlib.figure import Figure

    series = estimate.series
    columns = min(_COLUMNS, len(series))
    rows = math.ceil(len(series) / columns)
    with mpl.rc_context({"font.size": 8, "axes.titlesize": 8}):
        figure = Figure(figsize=(4.2 * columns, 3.2 * rows), layout="constrained", dpi=_RASTER)
        grid = figure.subplots(
            2 * rows, columns, squeeze=False, gridspec_kw={"height_ratios": [3, 1] * rows}
        )
        for number, (one, model, left) in enumerate(
            zip(series, estimate.model, estimate.residuals(), strict=True)
        ):
            row, column = divmod(number, columns)
            top, low = grid[2 * row, column], grid[2 * row + 1, column]
            index = "time" if one.quantity in ("left", "right", "x", "z") else "run"
            index = "pressure" if one.quantity == "angle" else index
            order = np.argsort(one.at)
            x = one.at[order] / (1e3 if index == "pressure" else 1)
            shift = 0.0 if one.offset is None else estimate.offset[one.offset]
            unit, factor = {"m": ("mm", 1e3), "m/s": ("mm/s", 1e3)}.get(one.unit, (one.unit, 1))
            top.plot(x, factor * (one.value[order] - shift), ".", color="C0", ms=4, label="data")
            style = "x" if index == "run" else "-"
            top.plot(x, factor * (model[order] - shift), style, color="C1", label="model")
            top.set_title(one.name)
            top.set_ylabel(f"{one.quantity} [{unit}]")
            top.tick_params(labelbottom=False)
            low.axhspan(-2, 2, color="0.9")
            over = left[order] / estimate.noise[one.noise]
            far = np.abs(over) > _FAR
            low.plot(x[~far], over[~far], ".", color="C0", ms=3)
            low.plot(x[far], np.clip(over[far], -_FAR, _FAR), "D", color="C3", ms=3)
            low.set_ylim(-1.2 * _FAR, 1.2 * _FAR)
            low.set_ylabel("residual\n/ noise")
            low.set_xlabel(_LABEL[index])
            low.sharex(top)
        for spare in range(len(series), rows * columns):
            row, column = divmod(spare, columns)
            grid[2 * row, column].set_axis_off()
            grid[2 * row + 1, column].set_axis_off()
        grid[0, 0].legend()
        with whole(path) as part:
            figure.savefig(part)
