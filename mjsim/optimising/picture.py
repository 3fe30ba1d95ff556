"""Picture of the best gait beside the scene's, and of the course of the search."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from analytic.scene.gait import Gait
from mjsim.files.files import whole
from mjsim.optimising.search import Generation


def draw(best: Gait, start: Gait, history: Sequence[Generation], path: Path) -> None:
    """Draw pressures along the cycle, and the objective over evaluations.

    Args:
        best, start: gaits.
        history: of the search.
        path: of the picture.
    """
    figure = Figure(figsize=(10, 3.2), layout="constrained")
    for_best, for_start, course = figure.subplots(1, 3)
    for panel, gait, name in ((for_best, best, "best"), (for_start, start, start.name)):
        time = np.linspace(0, gait.period * (1 - 1e-9), 500)
        for segment, part in enumerate(gait.fractions(time).T):
            panel.plot(time, part + 1.2 * (gait.segments - 1 - segment), lw=1.5)
        panel.set_title(f"{name}: pressures, first chamber on top", fontsize=9)
        panel.set_xlabel("s")
        panel.set_yticks([])
    course.plot([g.evaluations for g in history], [g.value for g in history], label="best")
    course.plot([g.evaluations for g in history], [g.median for g in history], lw=0.8,
                label="median of the generation")  # fmt: skip
    course.set_xlabel("evaluations")
    course.set_title("objective", fontsize=9)
    course.legend(fontsize=7)
    with whole(path) as part:
        figure.savefig(part, dpi=110)
