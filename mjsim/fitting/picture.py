"""Picture of data, model and residuals."""

import math
from pathlib import Path

import matplotlib as mpl
import numpy as np

from mjsim.files.files import whole
from mjsim.fitting.estimate import Estimate
from mjsim.fitting.observations import RUN

_LABEL = {"time": "time [s]", "pressure": "pressure [kPa]", "run": "run"}
_COLUMNS = 3
_RASTER = 100
_FAR = 5.0  # deviations, beyond which a residual is drawn at the edge, in red; chosen


def draw(estimate: Estimate, path: Path) -> None:
    """Draw a pair of axes per series: data and model above, residuals over the noise below.

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
        axes = list(zip(grid[::2].ravel(), grid[1::2].ravel(), strict=True))
        for each, model, residual, (top, low) in zip(
            series, estimate.model, estimate.residuals(), axes, strict=False
        ):
            order = np.argsort(each.at)
            x = each.at[order] / (1e3 if each.abscissa == "pressure" else 1)
            shift = estimate.level(each)
            unit, factor = {"m": ("mm", 1e3), "m/s": ("mm/s", 1e3)}.get(each.unit, (each.unit, 1))
            top.plot(x, factor * (each.value[order] - shift), ".", color="C0", ms=4, label="data")
            style = "x" if each.abscissa == RUN else "-"
            top.plot(x, factor * (model[order] - shift), style, color="C1", label="model")
            top.set_title(each.name)
            top.set_ylabel(f"{each.quantity} [{unit}]")
            top.tick_params(labelbottom=False)
            low.axhspan(-2, 2, color="0.9")
            deviation = residual[order] / estimate.noise[each.noise]
            far = np.abs(deviation) > _FAR
            low.plot(x[~far], deviation[~far], ".", color="C0", ms=3)
            low.plot(x[far], np.clip(deviation[far], -_FAR, _FAR), "D", color="C3", ms=3)
            low.set_ylim(-1.2 * _FAR, 1.2 * _FAR)
            low.set_ylabel("residual\n/ noise")
            low.set_xlabel(_LABEL[each.abscissa])
            low.sharex(top)
        for pair in axes[len(series) :]:
            for spare in pair:
                spare.set_axis_off()
        grid[0, 0].legend()
        with whole(path) as part:
            figure.savefig(part)
