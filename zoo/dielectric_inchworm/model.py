"""The frequency at which the dielectric inchworm turns round, from the walks of `studies.inchworm`.

Its unpublished values were chosen so that it turns there: what is compared is a fit, not a
prediction. The error is half of the gap between the last frequency that surely goes ahead and the
first that surely goes back.
"""

import math
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from studies.drawing import FONT, save
from studies.inchworm import Outcome, rows, turn
from zoo.comparison import Predicted, Row, shade

WALKS = Path(__file__).parents[2] / "docs" / "dielectric.csv"


def base() -> dict[float, Outcome]:
    """Outcomes of the base by frequency [Hz]."""
    return {case.frequency: outcome for case, outcome in rows(WALKS).items()
            if case.varied == "base"}  # fmt: skip


def predicted() -> dict[str, Predicted]:
    """Directions at the ends of the published range, and where it turns [Hz]."""
    found = base()
    low, high = turn(found) or (float("nan"), float("nan"))
    ways = {f"{f} Hz": Predicted(1.0 if found[f].distance > 0 else -1.0) for f in (1, 6, 13)}
    return {**ways, "turns back at": Predicted(0.5 * (low + high), 0.5 * (high - low))}


def draw(found: list[Row], path: Path) -> None:
    """Draw the distance over the frequency, and what is published of it."""
    ways = {float(row.quantity.split()[0]): row.measured for row in found
            if row.unit == "direction"}  # fmt: skip
    walks = {f: one for f, one in base().items() if not math.isnan(one.distance)}
    back = next(row for row in found if row.unit == "Hz")
    with mpl.rc_context(FONT):
        figure = Figure(figsize=(5.6, 3.4), layout="constrained", dpi=110)
        axes = figure.subplots()
        axes.errorbar(list(walks), [one.distance for one in walks.values()],
                      [one.error for one in walks.values()], fmt="o-", ms=4, color="C1", capsize=2,
                      label="fitted strip in MuJoCo")  # fmt: skip
        axes.set_ylim(-0.08, 0.24)
        shade(axes, 1, back.measured - back.measured_error, 1)
        shade(axes, back.measured + back.measured_error, max(ways), -1)
        axes.axvspan(back.predicted - back.predicted_error, back.predicted + back.predicted_error,
                     color="C1", alpha=0.15, lw=0, label="turns surely in here")  # fmt: skip
        axes.set_xlabel("frequency [Hz]")
        axes.set_ylabel("distance per cycle over L")
        axes.text(1.2, 0.23, "published: ahead", va="top", fontsize=8)
        axes.text(10.2, -0.075, "published: back", fontsize=8)
        axes.legend(fontsize=8, frameon=False)
        save(figure, path)
