"""A gait as a bench runs it: when each valve fills or vents, no faster than the supply can."""

import csv
import math
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from analytic.scene.gait import Gait
from analytic.scene.limbs import AnyRobot
from mjsim.scene.valves import Valves

_HELD = 1e-9  # of the peak pressure: less is no change


class ValveTime(NamedTuple):
    """Time for which a valve is open.

    Attributes:
        chamber: whose valve it is.
        valve: fill or vent.
        begin_s, end_s: of the time, from the begin of the cycle [s].
        from_kPa, to_kPa: pressure in the chamber then [kPa].
    """

    chamber: str
    valve: str
    begin_s: float
    end_s: float
    from_kPa: float  # noqa: N815
    to_kPa: float  # noqa: N815


def within_supply(gait: Gait, robot: AnyRobot, valves: Valves) -> Gait:
    """The gait, with ramps that are as much longer as the flow limit of the valves asks for."""
    limits = np.array(valves.of("flow_limit", len(robot.chambers)))
    if not np.isfinite(limits).any():
        return gait
    changes = robot.peak_pressure * np.abs(np.diff(np.array(gait.stages), axis=0))
    least = (changes / limits).max(axis=1)
    times = np.maximum(gait.ramp_times, least)
    if (times == gait.ramp_times).all():
        return gait
    return replace(gait, ramp_time=tuple(times.tolist()))


def valve_times(gait: Gait, robot: AnyRobot) -> list[ValveTime]:
    """Times for which valves are open in a cycle, by chamber; ramps one after the other joined."""
    clock = np.concatenate([[0.0], np.cumsum(gait.ramp_times)]).tolist()
    rows: list[ValveTime] = []
    for chamber, fractions in zip(robot.chambers, np.array(gait.stages).T, strict=True):
        kilopascals = (1e-3 * robot.peak_pressure * fractions).tolist()
        for i, change in enumerate(np.diff(fractions).tolist()):
            if abs(change) <= _HELD:
                continue
            row = ValveTime(chamber, "fill" if change > 0 else "vent", clock[i], clock[i + 1],
                            kilopascals[i], kilopascals[i + 1])  # fmt: skip
            if rows and rows[-1][:2] == row[:2] and _same_rate(rows[-1], row):
                row = row._replace(begin_s=rows[-1].begin_s, from_kPa=rows[-1].from_kPa)
                rows.pop()
            rows.append(row)
    return rows


def _same_rate(one: ValveTime, next_one: ValveTime) -> bool:
    if one.end_s != next_one.begin_s:
        return False
    rates = [(row.to_kPa - row.from_kPa) / (row.end_s - row.begin_s) for row in (one, next_one)]
    return math.isclose(*rates, rel_tol=1e-6)


def write(gait: Gait, robot: AnyRobot, path: Path) -> None:
    """Write the times into a CSV file."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["chamber", "valve", "begin [s]", "end [s]", "from [kPa]", "to [kPa]"])
        for row in valve_times(gait, robot):
            writer.writerow([*row[:2], *(f"{number:.6g}" for number in row[2:])])
