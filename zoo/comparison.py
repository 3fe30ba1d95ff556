"""Measurements of a robot beside predictions: rows, a table and a picture."""

import csv
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analytic.locomotion import STANDSTILL
from studies.drawing import FONT, save

CLAIMED = "#66a182"


class Predicted(NamedTuple):
    """A predicted number.

    Attributes:
        value: in the unit of what was measured.
        error: standard error or half-width, as the robot's README says; NaN if there is none.
    """

    value: float
    error: float = math.nan


class Row(NamedTuple):
    """A quantity of a robot.

    Attributes:
        robot: name of its folder.
        quantity, unit: of both numbers.
        measured, measured_error: the error as its source states it; NaN if it does not.
        predicted, predicted_error: see Predicted.
        misfit: the largest difference that the robot's README states.
        source: of the measured number.
    """

    robot: str
    quantity: str
    unit: str
    measured: float
    measured_error: float
    predicted: float
    predicted_error: float
    misfit: float
    source: str

    @property
    def difference(self) -> float:
        """Predicted less measured."""
        return self.predicted - self.measured


def rows(folder: Path, predicted: Mapping[str, Predicted]) -> list[Row]:
    """Rows of a robot: measured.csv of its folder beside predictions by quantity.

    Raises:
        ValueError: the quantities of both are not the same.
    """
    with (folder / "measured.csv").open(newline="", encoding="utf-8") as file:
        measured = list(csv.DictReader(file))
    names = [row["quantity"] for row in measured]
    if set(names) != set(predicted):
        raise ValueError(f"{folder.name}: measured are {names}, predicted {list(predicted)}")
    return [Row(folder.name, row["quantity"], row["unit"], float(row["measured"]),
                float(row["error"] or "nan"), *predicted[row["quantity"]], float(row["misfit"]),
                row["source"]) for row in measured]  # fmt: skip


def table(rows: Sequence[Row]) -> list[str]:
    """Lines of a table for people, in Markdown."""
    head = ("robot", "quantity", "unit", "measured", "±", "predicted", "±", "difference")
    cells = [(row.robot, row.quantity, row.unit, f"{row.measured:.3g}",
              _error(row.measured_error), f"{row.predicted:.3g}", _error(row.predicted_error),
              f"{row.difference:+.2g}") for row in rows]  # fmt: skip
    wide = [max(len(line[k]) for line in (head, *cells)) for k in range(len(head))]
    lines = [" | ".join(cell.ljust(w) for cell, w in zip(line, wide, strict=True))
             for line in (head, *cells)]  # fmt: skip
    rule = " | ".join("-" * w for w in wide)
    return [f"| {line} |" for line in (lines[0], rule, *lines[1:])]


def _error(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.2g}"


def draw(rows: Sequence[Row], path: Path) -> None:
    """Draw the rows of a robot, measured beside predicted with both error bars, a panel a unit."""
    units = list(dict.fromkeys(row.unit for row in rows))
    with mpl.rc_context(FONT):
        figure = Figure(figsize=(max(4.5, 2.2 + 0.55 * len(rows)), 3.6), layout="constrained",
                        dpi=110)  # fmt: skip
        counts = [sum(row.unit == unit for row in rows) for unit in units]
        panels = figure.subplots(1, len(units), squeeze=False,
                                 gridspec_kw={"width_ratios": counts})[0]  # fmt: skip
        for axes, unit in zip(panels, units, strict=True):
            here = [row for row in rows if row.unit == unit]
            for shift, name, marker in ((-0.12, "measured", "s"), (0.12, "predicted", "o")):
                errors = [getattr(row, f"{name}_error") for row in here]
                axes.errorbar(
                    [k + shift for k in range(len(here))], [getattr(row, name) for row in here],
                    [0.0 if math.isnan(error) else error for error in errors], fmt=marker,
                    color="black" if name == "measured" else "C1", capsize=3, label=name,
                )  # fmt: skip
            axes.axhline(0, color="0.8", lw=0.8, zorder=0)
            axes.set_xticks(range(len(here)), [row.quantity for row in here], rotation=30,
                            ha="right", fontsize=8)  # fmt: skip
            axes.set_xlim(-0.6, len(here) - 0.4)
            axes.set_ylabel(f"[{unit}]")
        panels[0].legend(fontsize=8, frameon=False)
        save(figure, path)


def shade(axes: Axes, begin: float, end: float, way: float) -> None:
    """Shade the distances over L that a claim of a direction allows, of panels whose y is that.

    Args:
        axes: with its final limits.
        begin, end: of the claim along x.
        way: 1 ahead, -1 back, 0 standing still.
    """
    low, high = axes.get_ylim()
    still = STANDSTILL
    allowed = {1: (still, high), -1: (low, -still), 0: (-still, still)}[int(way)]
    axes.fill_between([begin, end], *allowed, color=CLAIMED, alpha=0.25, lw=0, zorder=0)
    axes.axhline(0, color="0.6", lw=0.8, zorder=1)
    axes.set_ylim(low, high)
