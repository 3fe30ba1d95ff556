"""Pictures of a sweep: main effects, and maps of pairs with the neutral curve."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from mjsim.files.files import whole
from mjsim.sweeps.effects import Field, Map, Results, levels
from mjsim.sweeps.export import with_unit

_ACROSS = 3  # panels
_WAYS = dict.fromkeys(("displacement_over_L", "displacement_m"), ": − backward, + forward")


def main_effects(results: Results, path: Path) -> None:
    """Draw a panel per field: mean over its levels, and the range of 80 % of the scenes."""
    figure, axes = _panels(len(results.fields))
    for field, part, panel in zip(results.fields, results.parts, axes, strict=False):
        of, centre = levels(field.values)
        groups = [results.values[of == level] for level in range(len(centre))]
        low, high = (np.array([np.quantile(g, q) for g in groups]) for q in (0.1, 0.9))
        mean = np.array([g.mean() for g in groups])
        if field.words:
            panel.errorbar(centre, mean, [mean - low, high - mean], fmt="o", capsize=3)
            panel.set_xlim(centre[0] - 0.5, centre[-1] + 0.5)
        else:
            panel.plot(centre, mean, "o-", ms=3)
            panel.fill_between(centre, low, high, alpha=0.2, lw=0)
        panel.axhline(0, color="0.6", lw=0.8)
        panel.set_title(f"explains {100 * part:.0f} % alone", fontsize=9)
        _label(panel, field, "x")
        panel.set_ylabel(with_unit(results.quantity, results.unit), fontsize=8)
    _save(figure, path)


def pair_maps(results: Results, maps: Sequence[Map], path: Path) -> list[dict[str, Any]]:
    """Draw a map per pair, with a line where the quantity is 0.

    Returns:
        Lines: two fields, and points in their units.
    """
    figure, axes = _panels(len(maps))
    most = max(float(np.nanmax(np.abs(pair.mean))) for pair in maps) or 1.0
    lines = []
    for pair, panel in zip(maps, axes, strict=False):
        shown = panel.pcolormesh(
            pair.x, pair.y, pair.mean, cmap="RdBu", vmin=-most, vmax=most, shading="nearest"
        )
        signs = np.sign(pair.mean[np.isfinite(pair.mean)])
        if min(pair.mean.shape) > 1 and signs.min() < 0 < signs.max():
            masked = np.ma.masked_invalid(pair.mean)
            zero = panel.contour(pair.x, pair.y, masked, levels=[0.0], colors="k", linewidths=1.5)
            lines.append({
                "fields": [pair.one.name, pair.two.name],
                "lines": [line.tolist() for line in zero.allsegs[0] if len(line)],
            })  # fmt: skip
        panel.set_title(f"explains {100 * pair.part:.0f} % beyond each alone", fontsize=9)
        _label(panel, pair.one, "x")
        _label(panel, pair.two, "y")
    bar = figure.colorbar(shown, ax=axes.tolist(), shrink=0.8)
    told = _WAYS.get(results.quantity, "")
    bar.set_label(f"mean {with_unit(results.quantity, results.unit)}{told}; black: 0")
    _save(figure, path)
    return lines


def _panels(count: int) -> tuple[Figure, Any]:
    across = min(count, _ACROSS)
    down = math.ceil(count / across)
    figure = Figure(figsize=(3.6 * across, 2.9 * down), layout="constrained")
    axes = figure.subplots(down, across, squeeze=False).ravel()
    for spare in axes[count:]:
        spare.set_axis_off()
    return figure, axes


def _label(panel: Any, field: Field, axis: str) -> None:
    getattr(panel, f"set_{axis}label")(with_unit(field.name, field.unit), fontsize=8)
    if field.words:
        getattr(panel, f"set_{axis}ticks")(range(len(field.words)), field.words)
    panel.tick_params(labelsize=7)


def _save(figure: Figure, path: Path) -> None:
    with whole(path) as part:
        figure.savefig(part, dpi=110)
