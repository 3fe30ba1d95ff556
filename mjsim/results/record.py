"""A walk beside its prediction, as one flat record and as text."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.locomotion import direction
from analytic.prediction import REFERENCE, Prediction
from mjsim.results.cautions import APART, cautions, elsewhere, tied
from mjsim.results.measures import Measures, measure, slid_over_length
from mjsim.results.prediction import HALF, STATES, displacement, error_bar, prediction
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Scene

_OPEN = 1e-4  # of the length: less is a rounding


def record(walk: Trajectory) -> dict[str, Any]:
    """The run as plain data; quantities that do not exist are None, never a number."""
    scene, numerics = walk.scene, walk.numerics
    found = reference(walk)
    by_cycle = (found.by_cycle / scene.robot.length).tolist()
    predicted = displacement(scene, found)
    known = math.isfinite(predicted)
    bar = error_bar(scene, predicted, reference(walk, HALF)) if known else None
    numbers = measure(walk)
    simulated = float(len(walk.time) * numerics.timestep)
    shift = numbers.displacement if numbers else None
    meters = None if shift is None else shift * scene.robot.length
    return {
        "surface": scene.ground.name,
        "gait": scene.gait.name,
        "body": scene.body,
        "friction": scene.friction,
        "cycles": scene.cycles,
        "links": numerics.links,
        "timestep_s": numerics.timestep,
        "peak_pressure_Pa": scene.robot.peak_pressure,
        "displacement_over_L": shift,
        "displacement_by_cycle_over_L": list(numbers.by_cycle) if numbers else None,
        "displacement_m": meters,
        "speed_m_per_s": None if meters is None else meters / scene.gait.period,
        "direction": None if shift is None else direction(shift, 1.0, bar or 0.0),
        "predicted_by": REFERENCE,
        "predicted_displacement_over_L": predicted if known else None,
        "predicted_by_cycle_over_L": by_cycle if known else None,
        "prediction_uncertainty_over_L": bar,
        "predicted_direction": direction(predicted, 1.0, bar or 0.0) if known else None,
        "prediction_undecided_over_L": tied(scene, found) if known else None,
        "prediction_flags": [flag.name for flag in found.flags],
        "prediction_notes": _notes(scene, numbers, found, predicted, bar or 0.0) if known else [],
        "error_over_L": None if shift is None or not known else shift - predicted,
        "unexplained_over_L": _number(numbers and numbers.unexplained),
        "heading_deg": numbers and math.degrees(numbers.heading),
        "sideways_over_L": numbers and numbers.sideways,
        "amplitude_over_L": numbers and numbers.amplitude,
        "slid_over_L": slid_over_length(walk) if walk.status == "slid" else None,
        "sim_time_s": simulated,
        "wall_time_s": walk.wall_time,
        "realtime_factor": simulated / walk.wall_time,
        "status": str(walk.status),
    }


def reference(walk: Trajectory, finer: float = 1) -> Prediction:
    """What the quasi-static reference makes of the same scene.

    Chambers that lag behind their valves take the strip along another path than the gait's: then it
    is theirs that the reference follows.

    Args:
        walk: whose scene it is.
        finer: multiplies links and states.
    """
    if walk.scene.valves.ideal or walk.time[-1] <= 0:
        return prediction(walk.scene, finer=finer)
    rows = _along(walk, round(STATES * finer))
    return prediction(walk.scene, finer=finer, path=walk.pressure[rows], times=walk.time[rows])


def _along(walk: Trajectory, states: int) -> NDArray[np.int_]:
    """Rows in which pressures have changed by a part of the peak, or time by a part of a ramp."""
    since = walk.pressure[walk.start :]
    changed = np.abs(np.diff(since, axis=0)).max(axis=1) / walk.scene.robot.peak_pressure
    passed = np.full(len(changed), walk.numerics.timestep / max(walk.scene.gait.ramp_times))
    parts = np.cumsum(states * np.maximum(changed, passed)).astype(int)
    rows = walk.start + 1 + np.flatnonzero(np.diff(parts, prepend=0))
    return np.unique([walk.start, *rows, len(walk.time) - 1])


def _notes(
    scene: Scene, numbers: Measures | None, found: Prediction, predicted: float, bar: float
) -> list[str]:
    error = numbers.displacement - predicted if numbers else math.nan
    return elsewhere(scene) + cautions(scene, numbers, found, error, bar)


def _number(value: float | None) -> float | None:
    """None for a number that does not exist."""
    return value if value is not None and math.isfinite(value) else None


def table(records: list[dict[str, Any]]) -> str:
    """One line a run: direction and displacement beside the prediction, and what it cost."""
    head = (
        f"{'surface':<14}{'direction':<11}{'Δ/L':>9}{REFERENCE:>9}{'±':>8}{'error':>9}{'unexpl.':>9}"
        f"{'height/L':>10}{'sim s':>8}{'wall s':>8}{'× real':>8}  status"
    )
    return "\n".join([head, *(_line(row) for row in records)])


def _line(row: dict[str, Any]) -> str:
    return (
        f"{row['surface']:<14}{row['direction'] or '-':<11}"
        f"{_signed(row['displacement_over_L'])}{_signed(row['predicted_displacement_over_L'])}"
        f"{_bar(row['prediction_uncertainty_over_L'])}{_signed(row['error_over_L'])}"
        f"{_signed(row['unexplained_over_L'])}"
        f"{_plain(row['amplitude_over_L'])}{row['sim_time_s']:>8.1f}{row['wall_time_s']:>8.2f}"
        f"{row['realtime_factor']:>8.0f}  {row['status']}{_remarks(row)}"
    )


def _remarks(row: dict[str, Any]) -> str:
    """What the reference met on its way and leaves out, and how far a slope dragged the strip."""
    remarks = [f"{row['predicted_by']} {flag.lower()}" for flag in row["prediction_flags"]]
    remarks += row["prediction_notes"]
    if (row["prediction_undecided_over_L"] or 0.0) > _OPEN:
        remarks.append(f"undecided by ±{row['prediction_undecided_over_L']:.3f}")
    text = f" ({'; '.join(remarks)})" if remarks else ""
    if row["displacement_by_cycle_over_L"] and _differ(row["displacement_by_cycle_over_L"]):
        text += f" first cycle {row['displacement_by_cycle_over_L'][0]:+.4f} L"
    if row["status"] == "slid":
        far = row["slid_over_L"]
        far = "away before its first cycle" if far is None else f"{far:.3f} L downhill"
        text += f" {far}: no bound holds its weight there"
    return text


def _differ(by_cycle: list[float]) -> bool:
    return abs(by_cycle[0] - by_cycle[-1]) > APART


def _signed(value: float | None) -> str:
    return f"{'-':>9}" if value is None else f"{value:>+9.4f}"


def _bar(value: float | None) -> str:
    return f"{'-':>8}" if value is None else f"{value:>8.4f}"


def _plain(value: float | None) -> str:
    return f"{'-':>10}" if value is None else f"{value:>10.3f}"
