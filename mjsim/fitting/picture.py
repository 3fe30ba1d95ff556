"""Picture of data, model and residuals."""

import math
from pathlib import Path

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from mjsim.files.files import whole
from mjsim.fitting.estimate import Estimate
from mjsim.fitting.observations import RUN

Array = NDArray[np.float64]

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
        for each, model, residual, (top, below) in zip(
            series, estimate.model, estimate.residuals(), axes, strict=False
        ):
            order = np.argsort(each.at)
            x = each.at[order] / (1e3 if each.abscissa == "pressure" else 1)
            unit, factor = {"m": ("mm", 1e3), "m/s": ("mm/s", 1e3)}.get(each.unit, (each.unit, 1))
            shift = estimate.level(each)
            data, fitted = (factor * (part[order] - shift) for part in (each.value, model))
            deviation = residual[order] / estimate.noise[each.noise]
            far = np.abs(deviation) > _FAR
            low, high = _range(np.concatenate([data[~far], fitted]))
            top.plot(x[~far], data[~far], ".", color="C0", ms=4, label="data")
            top.plot(x, fitted, "x" if each.abscissa == RUN else "-", color="C1", label="model")
            top.plot(x[far], np.clip(data[far], low, high), "D", color="C3", ms=3,
                     label=f"over {_FAR:g} times the noise off" if far.any() else None)  # fmt: skip
            top.set_ylim(*_range(np.array([low, high])))
            top.set_title(each.name)
            top.set_ylabel(f"{each.quantity} [{unit}]")
            top.tick_params(labelbottom=False)
            below.axhspan(-2, 2, color="0.9")
            below.plot(x[~far], deviation[~far], ".", color="C0", ms=3)
            below.plot(x[far], np.clip(deviation[far], -_FAR, _FAR), "D", color="C3", ms=3)
            below.set_ylim(-1.2 * _FAR, 1.2 * _FAR)
            below.set_ylabel("residual\n/ noise")
            below.set_xlabel(_LABEL[each.abscissa])
            below.sharex(top)
        for pair in axes[len(series) :]:
            for spare in pair:
                spare.set_axis_off()
        grid[0, 0].legend()
        with whole(path) as part:
            figure.savefig(part)


def _range(values: Array) -> tuple[float, float]:
    """Limits of an axis that shows values, a little wider than they are."""
    low, high = float(values.min()), float(values.max())
    wider = 0.05 * (high - low) or 1.0
    return low - wider, high + wider
