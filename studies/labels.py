"""Names written beside what they name, where there is room, in place of a legend."""

import itertools
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.text import Annotation
from matplotlib.transforms import Bbox

from studies import Array

_SIZE, _GAP = 8.0, 5.0  # of letters, and from a mark to its name [points]
_WAYS = tuple(itertools.product(("left", "right", "center"), ("bottom", "top", "center")))[:-1]
_NEAR = 4.0  # pixels round a mark that a name keeps off
_CLASH = 20.0  # points of lines that a name over another one is as bad as; chosen


def name_lines(axes: Axes, lines: Mapping[str, tuple[Array, Array, str]]) -> None:
    """Write the name of each line beside the one of its marks where it hides least.

    Args:
        axes: whose limits and figure are as they are to be drawn.
        lines: places of the marks along x and y, each (M,), and a colour, by name.
    """
    figure = axes.get_figure(root=True)
    assert figure is not None
    figure.draw_without_rendering()
    marks = np.concatenate([_filled(axes.transData.transform(np.stack([x, y], axis=1)))
                            for x, y, _ in lines.values()])  # fmt: skip
    inside, taken = axes.get_window_extent(), [text.get_window_extent() for text in axes.texts]
    for name, (x, y, colour) in sorted(lines.items(), key=lambda line: len(line[1][0])):
        tried: list[tuple[float, int, Annotation, Bbox]] = []
        for place, (across, up) in itertools.product(zip(x, y, strict=True), _WAYS):
            shift = {"left": _GAP, "right": -_GAP, "bottom": _GAP, "top": -_GAP}
            text = axes.annotate(
                name, place, xytext=(shift.get(across, 0), shift.get(up, 0)), color=colour,
                textcoords="offset points", fontsize=_SIZE, ha=across, va=up,
            )  # fmt: skip
            box = text.get_window_extent()
            tried.append((_hidden(box, marks, taken, inside), len(tried), text, box))
        best = min(tried, key=lambda one: one[:2])
        for _, _, text, _ in tried:
            if text is not best[2]:
                text.remove()
        taken.append(best[3])


def _filled(corners: Array) -> Array:
    """Points a few pixels apart along a line of corners, (M, 2) [pixels]."""
    along = np.concatenate([[0.0], np.hypot(*np.diff(corners, axis=0).T).cumsum()])
    steps = np.arange(0.0, along[-1] + _NEAR, _NEAR)
    return np.stack([np.interp(steps, along, part) for part in corners.T], axis=1)


def _hidden(box: Bbox, marks: Array, taken: list[Bbox], inside: Bbox) -> float:
    """Amount that a name in a box would hide: marks, names, and what lies outside the panel."""
    if not (inside.contains(box.x0, box.y0) and inside.contains(box.x1, box.y1)):
        return np.inf
    near = box.padded(_NEAR)
    over = ((marks > near.min) & (marks < near.max)).all(axis=1).sum()
    return float(over) + _CLASH * sum(near.overlaps(other) for other in taken)
