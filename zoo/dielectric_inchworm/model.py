"""The frequency at which the dielectric inchworm turns round, from the walks of `studies.inchworm`.

Its unpublished values were chosen so that it turns there: what is compared is a fit, not a
prediction. The error is half of the gap between the last frequency that surely goes ahead and the
first that surely goes back.
"""

from pathlib import Path

from studies.inchworm import Outcome, rows, turn
from zoo.comparison import Predicted

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
