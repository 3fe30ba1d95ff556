"""A fit in words and numbers: table, zeros, doubts, remarks."""

import dataclasses
import math
from itertools import combinations as pairs_of
from typing import Any, NamedTuple

from mjsim.files.scene_tables.tables import Tables
from mjsim.files.text_table import Column, text_table
from mjsim.fitting.determined import Together, at_bounds, together, undetermined, without_limit
from mjsim.fitting.estimate import Estimate
from mjsim.fitting.markers import film

_TOGETHER = 0.9  # correlation of parameters beyond which a note says so; chosen


class Doubts(NamedTuple):
    """Reasons why numbers cannot be relied on, and what they leave.

    Attributes:
        notes: one sentence each.
        withheld: names of parameters whose intervals are not given.
        combinations: that are determined where parameters alone are not.
        open: whether directions or sides of intervals are open.
    """

    notes: list[str]
    withheld: set[str]
    combinations: list[Together]
    open: bool


def doubts_of(fit: Estimate, base: Tables) -> Doubts:
    """Doubts about a fit.

    Args:
        fit: the estimate.
        base: tables of the scene that was fitted.
    """
    directions, bound = undetermined(fit, base), at_bounds(fit)
    combinations = [] if directions else together(fit)
    several = [d.exponents for d in directions if len(d.exponents) > 1]
    withheld = {name for part in [*several, *(c.exponents for c in combinations)] for name in part}
    limits = without_limit(fit, withheld)
    notes = [*map(str, directions), *limits]
    notes += [f"{name} ended at a bound: its interval means nothing" for name in bound]
    withheld |= {*bound}
    notes += [f"{combination}: their intervals are withheld" for combination in combinations]
    if fit.misfit.withheld:
        withheld |= set(fit.values)
        notes.append(
            f"neighbouring residuals are alike (correlation {fit.misfit.correlation:.2f}): the "
            "model misses something that may be in the values too, and the intervals are withheld"
        )
        notes += film(fit.series, fit.model, base, fit.values)
    return Doubts(notes, withheld, combinations, bool(directions or limits))


def remarks(fit: Estimate, doubts: Doubts) -> list[str]:
    """Notes on numbers that are sure."""
    lines = []
    if not doubts.open:
        pairs = pairs_of(enumerate(p.name for p in fit.parameters), 2)
        lines += [
            f"{first} and {second} are seen together: correlation {fit.correlation[i, j]:+.2f}"
            for (i, first), (j, second) in pairs
            if abs(fit.correlation[i, j]) > _TOGETHER and not {first, second} <= doubts.withheld
        ]
    wider = math.sqrt(fit.misfit.inflation)
    if wider > 1 and not fit.misfit.withheld:
        lines.append(
            f"neighbouring residuals are alike (correlation {fit.misfit.correlation:.2f}): the "
            f"intervals are {wider:.2g} times as wide as independent errors would make them"
        )
    return lines


def ignored(fit: Estimate) -> list[str]:
    """A line on the columns of the files that are not read, if there are any."""
    heads = dict.fromkeys(head for series in fit.series for head in series.ignored)
    return [f"columns that are not read: {', '.join(heads)}"] if heads else []


def _parameters(fit: Estimate, doubts: Doubts) -> list[dict[str, Any]]:
    """Fields of each parameter with its fitted value and interval.

    Limits that the data do not set are None, and all of an interval that is withheld.
    """
    rows = []
    for p, value, low, high, error in zip(
        fit.parameters, fit.value.tolist(), fit.low.tolist(), fit.high.tolist(),
        fit.error.tolist(), strict=True,
    ):  # fmt: skip
        given = p.name not in doubts.withheld
        lower, upper = given and low > 0, given and high < math.inf
        word = "withheld" if not given else "given" if lower or upper else "none"
        rows.append(dataclasses.asdict(p) | {
            "unit": p.unit, "value": value, "interval": word, "low_95": low if lower else None,
            "high_95": high if upper else None, "relative_error": error if given else None,
        })  # fmt: skip
    return rows


def table(fit: Estimate, doubts: Doubts) -> str:
    """A row per parameter: value, unit, interval, error."""
    columns = (
        Column("parameter", "name"), Column("value", "value", ".4g"), Column("unit", "unit"),
        Column("95 % interval", "interval"), Column("error", "error", ".2g"),
    )  # fmt: skip
    rows = [
        {**row, "unit": "" if row["unit"] == "1" else row["unit"],
         "interval": _interval(row), "error": _percent(row["relative_error"])}
        for row in _parameters(fit, doubts)
    ]  # fmt: skip
    return text_table(columns, rows)


def _interval(row: dict[str, Any]) -> str:
    low, high = row["low_95"], row["high_95"]
    if low is None and high is None:
        return row["interval"]
    if low is None or high is None:
        return f"above {low:.4g}" if high is None else f"below {high:.4g}"
    return f"{low:.4g} .. {high:.4g}"


def _percent(error: float | None) -> str:
    if error is None:
        return ""
    return f"{100 * error:.2g} %" if error < 1 else "> 100 %"


def zeros(fit: Estimate) -> list[str]:
    """A line per zero of a bench's files."""
    units = {"rad": ("deg", 180 / math.pi), "Pa": ("kPa", 1e-3)}
    lines = []
    for zero in _zero_record(fit):
        unit, factor = units[zero["unit"]]
        lines.append(f"zero of {zero['zero']} in {zero['file']}: {factor * zero['value']:.4g} "
                     f"{unit}, standard error {factor * zero['error']:.2g} {unit}")  # fmt: skip
    return lines


def _zero_record(fit: Estimate) -> list[dict[str, Any]]:
    numbers = {series.offset: series for series in fit.series if series.zero}
    return [
        {"file": series.name.partition(":")[0], "zero": series.zero,
         "unit": "Pa" if series.zero == "pressure" else "rad",
         "value": fit.offset[number], "error": fit.offset_error[number]}
        for number, series in numbers.items() if number is not None
    ]  # fmt: skip


def record_of(fit: Estimate, doubts: Doubts, notes: list[str]) -> dict[str, Any]:
    """Fields of the JSON object, in SI units."""
    return {
        "parameters": _parameters(fit, doubts), "correlation": fit.correlation.tolist(),
        "combinations": [combination._asdict() for combination in doubts.combinations],
        "zeros": _zero_record(fit), "noise_SI": fit.noise, "numbers": fit.count,
        "neighbours_correlation": fit.misfit.correlation,
        "interval_factor": math.sqrt(fit.misfit.inflation), "notes": notes,
    }  # fmt: skip
