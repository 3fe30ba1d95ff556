"""A walk of a robot of limbs beside its prediction, as one flat record and as text."""

import math
from typing import Any

import numpy as np

from analytic.locomotion import direction
from analytic.scene.surface import Surface
from analytic.solvers.limbs.prediction import TreePrediction, predict
from mjsim.model.limbs import longest_step
from mjsim.results.limb_walk import TreeWalk

REFERENCE = "quasi-static"
_MATTERS, _APART, _TURNED = 0.05, 2e-3, 0.2  # relative, L, degrees: less needs no word; chosen
_ROUNDED = 1.01  # a step that was printed to two digits is short enough
_FEET = 3  # that stand without falling, if it has so many
_STATES = 20  # of the reference, for a change by the peak pressure


def reference(walk: TreeWalk) -> TreePrediction | None:
    """What the quasi-static reference makes of one cycle; None of several on uneven ground."""
    scene = walk.scene
    if scene.cycles > 1 and not isinstance(scene.ground, Surface):
        return None
    return predict(scene.robot, scene.gait, scene.ground, _STATES, walk.numerics.elements,
                   law=scene.friction)  # fmt: skip


def record(walk: TreeWalk) -> dict[str, Any]:
    """The run as plain data; quantities that do not exist are None, never a number."""
    scene, length = walk.scene, walk.length
    found = reference(walk)
    fine = walk.status == "ok"
    ahead, aside = walk.displacement / length if fine else (None, None)
    turn = math.degrees(walk.turn) if fine else None
    bar = 0.0 if found is None else found.displacement_error / length
    simulated = float(len(walk.time) * walk.numerics.timestep)
    row: dict[str, Any] = {
        "surface": scene.ground.name,
        "robot": ", ".join(scene.robot.names),
        "gait": scene.gait.name,
        "friction": scene.friction,
        "cycles": scene.cycles,
        "elements": walk.numerics.elements,
        "timestep_s": walk.numerics.timestep,
        "peak_pressure_Pa": scene.robot.peak_pressure,
        "length_m": length,
        "displacement_over_L": ahead,
        "sideways_over_L": aside,
        "turn_deg": turn,
        "radius_over_L": _finite(walk.radius / length) if fine else None,
        "displacement_m": None if ahead is None else ahead * length,
        "direction": direction(ahead, 1.0, bar) if ahead is not None else None,
        "speed_m_per_s": None if ahead is None else ahead * length / scene.gait.period,
        "predicted_by": REFERENCE,
        "predicted_displacement_over_L": None,
        "predicted_sideways_over_L": None,
        "predicted_turn_deg": None,
        "predicted_direction": None,
        "prediction_uncertainty_over_L": None,
        "prediction_uncertainty_deg": None,
        "prediction_notes": [],
        "error_over_L": None,
        "error_deg": None,
        "fewest_limbs_on_ground": int(walk.contacts[walk.start :].min()),
        "sim_time_s": simulated,
        "wall_time_s": walk.wall_time,
        "realtime_factor": simulated / walk.wall_time,
        "status": str(walk.status),
    }
    if found is not None:
        forward, sideways = (found.displacement / length).tolist()
        row |= {
            "predicted_displacement_over_L": forward,
            "predicted_sideways_over_L": sideways,
            "predicted_turn_deg": math.degrees(found.turn),
            "predicted_direction": direction(forward, 1.0, bar),
            "prediction_uncertainty_over_L": bar,
            "prediction_uncertainty_deg": math.degrees(found.turn_error),
        }
        if ahead is not None and aside is not None and turn is not None:
            row["error_over_L"] = float(np.hypot(ahead - forward, aside - sideways))
            row["error_deg"] = turn - math.degrees(found.turn)
    row["prediction_notes"] = _notes(walk, row, found)
    return row


def _notes(walk: TreeWalk, row: dict[str, Any], found: TreePrediction | None) -> list[str]:
    notes = []
    if found is None:
        notes.append("no reference for several cycles on patches")
    elif not found.path.converged:
        notes.append("some states of the reference are unconverged")
    far = row["predicted_displacement_over_L"] or 0.0
    bar = row["prediction_uncertainty_over_L"] or 0.0
    if row["error_over_L"] is not None:
        much = row["error_over_L"] > max(_MATTERS * abs(far), _APART) + bar
        turned = abs(row["error_deg"]) > _TURNED + row["prediction_uncertainty_deg"]
        if much or (turned and abs(row["error_deg"]) > _MATTERS * abs(row["predicted_turn_deg"])):
            notes.append("inertia: a slower gait comes closer to the reference")
    step = longest_step(walk.scene, walk.numerics)
    if walk.numerics.timestep > step * _ROUNDED:
        notes.append(f"limbs sink in too deep: take a timestep of at most {step:.2g} s")
    feet = min(_FEET, len(walk.scene.robot.limbs))
    standing = np.mean(walk.contacts[walk.start :] < feet)
    if standing > 0:
        notes.append(f"on {row['fewest_limbs_on_ground']} limbs for {standing:.0%} of the time")
    return notes


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def table(records: list[dict[str, Any]]) -> str:
    """One line a run."""
    head = (
        f"{'surface':<14}{'direction':<11}{'Δ/L':>9}{REFERENCE:>14}{'±':>8}{'turn °':>9}"
        f"{REFERENCE:>14}{'±':>7}{'sim s':>8}{'wall s':>8}{'× real':>8}  status"
    )
    return "\n".join([head, *(_line(row) for row in records)])


def _line(row: dict[str, Any]) -> str:
    remarks = f" ({'; '.join(row['prediction_notes'])})" if row["prediction_notes"] else ""
    cells = (
        (row["displacement_over_L"], "+9.4f"),
        (row["predicted_displacement_over_L"], "+14.4f"),
        (row["prediction_uncertainty_over_L"], "8.4f"),
        (row["turn_deg"], "+9.2f"),
        (row["predicted_turn_deg"], "+14.2f"),
        (row["prediction_uncertainty_deg"], "7.2f"),
        (row["sim_time_s"], "8.1f"),
        (row["wall_time_s"], "8.2f"),
        (row["realtime_factor"], "8.0f"),
    )
    text = "".join(_cell(value, form) for value, form in cells)
    return f"{row['surface']:<14}{row['direction'] or '-':<11}{text}  {row['status']}{remarks}"


def _cell(value: float | None, form: str) -> str:
    width = form.lstrip("+").partition(".")[0]
    return f"{'-':>{width}}" if value is None else f"{value:{form}}"
