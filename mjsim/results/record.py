"""A walk beside its prediction, as one flat record and as text."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.locomotion import direction
from analytic.prediction import Prediction
from analytic.scene.limbs import limbs_of
from mjsim.files.text_table import Column, text_table
from mjsim.results import prediction
from mjsim.results.cautions import APART, cautions, tied
from mjsim.results.measures import measure, slid_over_length
from mjsim.results.prediction import HALF, STATES, Reference, error_bars, reference_name
from mjsim.results.status import WALKED
from mjsim.results.trajectory import Trajectory

_OPEN = 1e-4  # undecided displacement, over L, from which on it is printed; less is rounding


def record(walk: Trajectory, without: str = "") -> dict[str, Any]:
    """The run as plain data; quantities that do not exist are None, never a number.

    Args:
        walk: what is described, beside its reference; one that failed has none.
        without: why no reference is computed; it is if empty.
    """
    scene, numerics, length = walk.scene, walk.numerics, walk.scene.robot.length
    without = without or ("" if walk.status in WALKED else "the walk failed")
    theory, numbers = None if without else reference(walk), measure(walk)
    ahead, aside = theory.displacement.tolist() if theory else (math.nan, math.nan)
    bar, turn_bar, undecided = None, 0.0, None
    if theory and math.isfinite(ahead):
        bar, turn_bar = error_bars(scene, theory, reference(walk, HALF))
        undecided = _undecided(walk, theory)
    predicted = theory if math.isfinite(ahead) else None
    simulated = float(len(walk.time) * numerics.timestep)
    shift = numbers and numbers.displacement
    turn = numbers and math.degrees(numbers.turn)
    touching, pushed = walk.contacts[walk.start :], walk.ceiling_force[walk.start :]
    row: dict[str, Any] = {
        "surface": scene.ground.name,
        "robot": ", ".join(limb.name for limb in limbs_of(scene.robot)),
        "gait": scene.gait.name,
        "body": scene.body,
        "friction": scene.friction,
        "cycles": scene.cycles,
        "links": numerics.links,
        "timestep_s": numerics.timestep,
        "peak_pressure_Pa": scene.robot.peak_pressure,
        "length_m": length,
        "slope_deg": math.degrees(scene.slope),
        "displacement_over_L": shift,
        "displacement_by_cycle_over_L": list(numbers.by_cycle) if numbers else None,
        "displacement_m": None if shift is None else shift * length,
        "speed_m_per_s": numbers and numbers.speed,
        "direction": None if shift is None else direction(shift, 1.0, bar or 0.0),
        "aside_over_L": numbers and numbers.aside,
        "turn_deg": turn,
        "radius_over_L": _number(numbers and numbers.radius),
        "numerics_uncertainty_over_L": None,  # of limbs, by mjsim.simulation.second_walks
        "numerics_uncertainty_deg": None,
        "predicted_by": reference_name(scene),
        "predicted_displacement_over_L": _number(ahead),
        "predicted_by_cycle_over_L": predicted.by_cycle.tolist() if predicted else None,
        "prediction_uncertainty_over_L": bar,
        "predicted_direction": direction(ahead, 1.0, bar or 0.0) if predicted else None,
        "predicted_aside_over_L": _number(aside),
        "predicted_turn_deg": math.degrees(predicted.turn) if predicted else None,
        "prediction_uncertainty_deg": math.degrees(turn_bar) if predicted else None,
        "prediction_undecided_over_L": undecided,
        "prediction_flags": [flag.upper() for flag in theory.flags] if theory else [],
        "prediction_notes": [],
        "error_over_L": shift - ahead if shift is not None and predicted else None,
        "error_deg": None if turn is None or not predicted else turn - math.degrees(predicted.turn),
        "unexplained_over_L": _number(numbers and numbers.unexplained),
        "heading_deg": numbers and math.degrees(numbers.heading),
        "sideways_over_L": numbers and numbers.sideways,
        "amplitude_over_L": numbers and numbers.amplitude,
        "ceiling_m": scene.ceiling,
        "ceiling_time_fraction": float(np.mean(pushed > 0)) if len(pushed) else None,
        "ceiling_force_N": float(pushed.max()) if len(pushed) else None,
        "slid_over_L": slid_over_length(walk) if walk.status == "slid" else None,
        "fewest_limbs_on_ground": int(touching.min()) if scene.in_space else None,
        "sim_time_s": simulated,
        "wall_time_s": walk.wall_time,
        "realtime_factor": simulated / walk.wall_time,
        "status": str(walk.status),
    }
    notes = [f"no reference: {without}"] if without else []
    return {**row, "prediction_notes": notes + cautions(walk, theory, row)}


def _undecided(walk: Trajectory, theory: Reference) -> float | None:
    """Displacement of a strip over L that depends on contacts with equal bounds."""
    return tied(walk.scene, theory.walk) if isinstance(theory.walk, Prediction) else None


def reference(walk: Trajectory, finer: float = 1) -> Reference:
    """Quasi-static reference of the same scene.

    Chambers that lag behind their valves take the robot along another path than the gait's: then
    the reference follows theirs.

    Args:
        walk: whose scene it is.
        finer: multiplies links and states.
    """
    scene, numerics = walk.scene, walk.numerics
    if scene.valves.ideal or walk.time[-1] <= 0:
        return prediction.reference(scene, numerics, finer)
    states = prediction.LIMB_STATES if scene.in_space else STATES
    rows = _along(walk, round(states * finer))
    return prediction.reference(
        scene, numerics, finer, path=walk.pressure[rows], times=walk.time[rows]
    )


def _along(walk: Trajectory, states: int) -> NDArray[np.int_]:
    """Rows in which pressures have changed by a part of the peak, or time by a part of a ramp."""
    changed = np.abs(np.diff(walk.pressure[walk.start :], axis=0)).max(axis=1)
    changed /= walk.scene.robot.peak_pressure
    passed = np.full(len(changed), walk.numerics.timestep / max(walk.scene.gait.ramp_times))
    parts = np.cumsum(states * np.maximum(changed, passed)).astype(int)
    rows = walk.start + 1 + np.flatnonzero(np.diff(parts, prepend=0))
    return np.unique([walk.start, *rows, len(walk.time) - 1])


def _number(value: float | None) -> float | None:
    """The number, or None for one that does not exist."""
    return value if value is not None and math.isfinite(value) else None


def table(records: list[dict[str, Any]]) -> str:
    """Table of one line per run: displacement beside the prediction, and what it cost."""
    by, in_space = records[0]["predicted_by"], records[0]["robot"] != "strip"
    sloping = any(row.get("slope_deg") for row in records)
    aside = (
        Column("aside/L", "aside_over_L", "+.4f"), Column(by, "predicted_aside_over_L", "+.4f"),
    ) if in_space and sloping else ()  # fmt: skip
    middle = (
        *aside,
        Column("turn °", "turn_deg", "+.2f"), Column(by, "predicted_turn_deg", "+.2f"),
        Column("±", "prediction_uncertainty_deg", ".2f", error=True),
    ) if in_space else (Column("unexpl.", "unexplained_over_L", "+.4f"),)  # fmt: skip
    columns = (
        Column("surface", "surface"), Column("direction", "direction"),
        Column("Δ/L", "displacement_over_L", "+.4f"),
        Column(by, "predicted_displacement_over_L", "+.4f"),
        Column("±", "prediction_uncertainty_over_L", ".4f", error=True),
        Column("error", "error_over_L", "+.4f"), *middle,
        Column("height/L", "amplitude_over_L", ".3f"), Column("sim s", "sim_time_s", ".1f"),
        Column("wall s", "wall_time_s", ".2f"), Column("× real", "realtime_factor", ".0f"),
        Column("status", "result"),
    )  # fmt: skip
    return text_table(
        columns, [{**row, "result": row["status"] + _remarks(row)} for row in records]
    )


def _remarks(row: dict[str, Any]) -> str:
    """Flags and notes of the reference, the first cycle, and how far a strip slid down a slope."""
    remarks = [f"{row['predicted_by']} {flag.lower()}" for flag in row["prediction_flags"]]
    remarks += row["prediction_notes"]
    if (row["prediction_undecided_over_L"] or 0.0) > _OPEN:
        remarks.append(f"undecided by ±{row['prediction_undecided_over_L']:.3f}")
    text = f" ({'; '.join(remarks)})" if remarks else ""
    if row["displacement_by_cycle_over_L"] and _differ(row["displacement_by_cycle_over_L"]):
        text += f" first cycle {row['displacement_by_cycle_over_L'][0]:+.4f} L"
    if row["status"] == "slid":
        slid = row["slid_over_L"]
        where = "away before its first cycle" if slid is None else f"{slid:.3f} L downhill"
        text += f" {where}: its weight exceeds every friction bound there"
    return text


def _differ(by_cycle: list[float]) -> bool:
    return abs(by_cycle[0] - by_cycle[-1]) > APART
