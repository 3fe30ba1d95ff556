"""The pneumatic inchworm of 100 runs, each frequency and each pressure left out in turn.

`examples/inchworm_speeds.py` fits groups of a quasi-static strip to the other runs; the error is
the root mean square of the misses of the runs that were left out. Beside it stands interpolation of
the other runs of the same material, which knows no mechanics.
"""

from pathlib import Path

import numpy as np

from examples import inchworm_speeds as inchworm
from studies import Array
from zoo.comparison import Predicted
from zoo.pneumatic_inchworm.distances import GAIT, read

RUNS = Path(__file__).with_name("speeds.csv")
COLUMNS = {"pressure": "kPa", "frequency": "Hz"}
_ALIKE = 0.05  # 0.125 and 0.13 Hz are one frequency of other pressures


def interpolated(runs: inchworm.Runs, column: str) -> Array:
    """Speeds of runs from those of the same material at the two nearest other values of a column.

    Outside of the other values the line through the two nearest goes on.
    """
    other = next(name for name in COLUMNS if name != column)
    predicted = np.empty(len(runs.speed))
    for row in range(len(predicted)):
        same = ((runs.material == runs.material[row])
                & np.isclose(getattr(runs, other), getattr(runs, other)[row], rtol=_ALIKE)
                & (getattr(runs, column) != getattr(runs, column)[row]))  # fmt: skip
        at, speed = getattr(runs, column)[same], runs.speed[same]
        near = np.argsort(np.abs(at - getattr(runs, column)[row]))
        low, high = near[0], next(k for k in near if at[k] != at[near[0]])
        between = [k for k in near if (at[k] - getattr(runs, column)[row])
                   * (at[low] - getattr(runs, column)[row]) < 0]  # fmt: skip
        high = between[0] if between else high
        part = (getattr(runs, column)[row] - at[low]) / (at[high] - at[low])
        predicted[row] = speed[low] + part * (speed[high] - speed[low])
    return predicted


def held_out() -> dict[str, tuple[Array, Array, Array]]:
    """Speeds of left-out runs by column: of the fit, its half-widths, and interpolated [mm/s]."""
    runs, tables = inchworm.read(RUNS), {GAIT: read()}
    return {column: (*inchworm.held_out(tables, runs, column), interpolated(runs, column))
            for column in COLUMNS}  # fmt: skip


def predicted() -> dict[str, Predicted]:
    """Mean speeds at each pressure and frequency that was left out [mm/s]."""
    runs, predictions = inchworm.read(RUNS), {}
    for column, (value, _, _) in held_out().items():
        for one in np.unique(getattr(runs, column)):
            here = getattr(runs, column) == one
            off = inchworm.rms(value[here] - runs.speed[here])
            predictions[f"{one:g} {COLUMNS[column]}"] = Predicted(float(value[here].mean()), off)
    return predictions


def main() -> None:
    """Print the misses of the fit and of interpolation, all runs and by pressure."""
    runs = inchworm.read(RUNS)
    for column, (value, wide, between) in held_out().items():
        inside = np.mean(np.abs(value - runs.speed) <= wide)
        print(f"each {column} left out: fit {inchworm.rms(value - runs.speed):.2f} mm/s, "
              f"{inside:.0%} in its 95 % intervals; interpolation "
              f"{inchworm.rms(between - runs.speed):.2f} mm/s")  # fmt: skip
        for one in np.unique(getattr(runs, column)):
            here = getattr(runs, column) == one
            print(f"    {one:g} {COLUMNS[column]}: fit "
                  f"{inchworm.rms(value[here] - runs.speed[here]):.2f}, interpolation "
                  f"{inchworm.rms(between[here] - runs.speed[here]):.2f}")  # fmt: skip


if __name__ == "__main__":
    main()
