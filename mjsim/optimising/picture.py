"""Picture of the best gait beside the scene's, and of the course of the search."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from analytic.scene.gait import Gait
from mjsim.files.files import whole
from mjsim.optimising.search import Generation

_APART = 1.2  # peak pressures from a chamber's axis to the next one's; chosen
AXES = {
    "displacement": "displacement per cycle on the worst ground [L]",
    "speed": "speed on the worst ground [m/s]",
    "air": "minus air per metre on the worst ground [l/m]",
    "work": "minus work per metre on the worst ground [J/m]",
}


def draw(
    best: Gait, start: Gait, history: Sequence[Generation], path: Path, aim: str,
    chambers: Sequence[str],
) -> None:  # fmt: skip
    """Draw pressures along the cycle, and the objective over evaluations.

    Args:
        best, start: gaits.
        history: of the search.
        path: of the picture.
        aim: of the search, a key of AXES.
        chambers: their names.
    """
    figure = Figure(figsize=(10, 3.4), layout="constrained")
    for_best, for_start, course = figure.subplots(1, 3, width_ratios=(1, 1, 1.1))
    for panel, gait, name in ((for_best, best, "best gait"), (for_start, start, start.name)):
        time = np.linspace(0, gait.period * (1 - 1e-9), 500)
        base = _APART * np.arange(gait.segments)[::-1]
        for chamber, (part, zero) in enumerate(zip(gait.fractions(time).T, base, strict=True)):
            panel.fill_between(time, zero, zero + part, color=f"C{chamber}", alpha=0.3, lw=0)
            panel.plot(time, zero + part, color=f"C{chamber}", lw=1.5)
        panel.set_title(f"{name}: pressures, up to the peak", fontsize=9)
        panel.set_xlabel("time [s]")
        panel.set_yticks(base, chambers, fontsize=8)
    evaluations = [g.evaluations for g in history]
    course.plot(evaluations, [g.value for g in history], label="best so far")
    course.plot(evaluations, [g.median for g in history], lw=0.8,
                label="median of a generation")  # fmt: skip
    course.axhline(0, color="0.8", lw=0.8, zorder=0)
    course.set_xlabel("gaits tried")
    course.set_ylabel(AXES[aim], fontsize=8)
    course.set_title(f"the search: best {history[-1].value:+.3g}", fontsize=9)
    course.legend(fontsize=7)
    with whole(path) as part_file:
        figure.savefig(part_file, dpi=110)
