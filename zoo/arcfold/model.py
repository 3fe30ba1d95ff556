"""Distances per cycle of ArcFold, by the elastica of its scene.

Quasi-static: the same at all periods. The error is what 10 degrees more or less of its fold change.
"""

from functools import cache
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from mjsim import build, read_tables, reference
from studies.drawing import FONT, save
from zoo.comparison import Predicted, Row

SCENE = Path(__file__).with_name("scene.toml")
PANEL, FOLD, UNSURE = 6.0, 90.0, 10.0  # cm, degrees; the last is assumed
PERIODS = (4.0, 2.0, 1.0, 0.5)  # s


def stroke(fold: float) -> float:
    """Approach of the stretches that lie, of panels on sharp hinges that fold [cm]."""
    return float(2 * PANEL * (1 - np.cos(np.radians(0.5 * fold))))


@cache
def distance() -> float:
    """Distance per cycle of the scene [cm]."""
    scene, _ = build(read_tables(SCENE))
    return 1e2 * scene.strip.length * float(reference(scene).displacement[0])


def predicted() -> dict[str, Predicted]:
    """Distances per cycle [cm]."""
    error = 0.5 * (stroke(FOLD + UNSURE) - stroke(FOLD - UNSURE))
    return {f"period {period:g} s": Predicted(distance(), error) for period in PERIODS}


def draw(rows: list[Row], path: Path) -> None:
    """Draw the distance over the period, measured and predicted."""
    with mpl.rc_context(FONT):
        figure = Figure(figsize=(4.8, 3.4), layout="constrained", dpi=110)
        axes = figure.subplots()
        value, error = rows[0].predicted, rows[0].predicted_error
        axes.axhspan(value - error, value + error, color="C1", alpha=0.15, lw=0,
                     label=f"{UNSURE:g} degrees of fold")  # fmt: skip
        axes.axhline(value, color="C1", label="predicted, nothing fitted")
        axes.semilogx(PERIODS, [row.measured for row in rows], "ks", label="measured")
        axes.annotate("their feet slipped", (2, rows[1].measured), (2.15, rows[1].measured + 0.3),
                      fontsize=8)  # fmt: skip
        axes.annotate("too fast for the servos", (0.5, rows[3].measured),
                      (0.52, rows[3].measured - 0.3), fontsize=8)  # fmt: skip
        axes.set_xticks(PERIODS, [f"{period:g}" for period in PERIODS])
        axes.minorticks_off()
        axes.set_ylim(0, 5)
        axes.set_xlabel("period [s]")
        axes.set_ylabel("distance per cycle [cm]")
        axes.legend(fontsize=8, frameon=False, ncols=2, loc="upper left")
        save(figure, path)
