"""A walk beside its prediction, as one flat record and as text."""

import math
from typing import Any

from analytic import REFERENCE, Prediction, direction, predict
from analytic.locomotion import undecided
from mjsim.simulation.measures import measure
from mjsim.simulation.trajectory import Trajectory

_OPEN = 1e-4  # of the length: less is a rounding


def record(walk: Trajectory) -> dict[str, Any]:
    """The run as plain data; quantities that do not exist are None, never a number."""
    scene, numerics = walk.scene, walk.numerics
    prediction = reference(walk)
    predicted = prediction.locomotion.per_cycle / scene.robot.length
    known = predicted == predicted  # not NaN
    coulomb = scene.friction == "coulomb"
    tied = undecided(prediction.shapes, scene.surface) / scene.robot.length if coulomb else 0.0
    measured = measure(walk)
    simulated = float(len(walk.time) * numerics.timestep)
    return {
        "surface": scene.surface.name,
        "gait": scene.gait.name,
        "body": scene.body,
        "friction": scene.friction,
        "cycles": scene.cycles,
        "links": numerics.links,
        "timestep_s": numerics.timestep,
        "peak_pressure_Pa": scene.robot.peak_pressure,
        "displacement_over_L": measured and measured.displacement,
        "direction": measured and measured.direction,
        "predicted_by": REFERENCE,
        "predicted_displacement_over_L": predicted if known else None,
        "predicted_direction": direction(predicted, 1.0) if known else None,
        "prediction_undecided_over_L": tied,
        "prediction_flags": [flag.name for flag in prediction.flags],
        "error_over_L": measured.displacement - predicted if measured and known else None,
        "slip_over_L": measured and measured.slip,
        "heading_deg": measured and math.degrees(measured.heading),
        "sideways_over_L": measured and measured.sideways,
        "amplitude_over_L": measured and measured.amplitude,
        "sim_time_s": simulated,
        "wall_time_s": walk.wall_time,
        "realtime_factor": simulated / walk.wall_time,
        "status": str(walk.status),
    }


def reference(walk: Trajectory) -> Prediction:
    """What the quasi-static reference makes of the same scene.

    Chambers that lag behind their valves take the strip along another path than the gait's: then
    it is theirs that the reference follows.
    """
    scene = walk.scene
    path = walk.pressure[walk.start :] if scene.lag else None
    return predict(
        scene.robot,
        scene.gait,
        scene.surface,
        friction=scene.hold,
        chamber=scene.chamber,
        path=path,
    )


def table(records: list[dict[str, Any]]) -> str:
    """One line a run: direction and displacement beside the prediction, and what it cost."""
    head = (
        f"{'surface':<14}{'direction':<11}{'Δ/L':>9}{REFERENCE:>9}{'error':>9}{'slip':>9}"
        f"{'height/L':>10}{'sim s':>8}{'wall s':>8}{'× real':>8}  status"
    )
    return "\n".join([head, *(_line(row) for row in records)])


def _line(row: dict[str, Any]) -> str:
    return (
        f"{row['surface']:<14}{row['direction'] or '-':<11}"
        f"{_signed(row['displacement_over_L'])}{_signed(row['predicted_displacement_over_L'])}"
        f"{_signed(row['error_over_L'])}{_signed(row['slip_over_L'])}"
        f"{_plain(row['amplitude_over_L'])}{row['sim_time_s']:>8.1f}{row['wall_time_s']:>8.2f}"
        f"{row['realtime_factor']:>8.0f}  {row['status']}{_flags(row)}"
    )


def _flags(row: dict[str, Any]) -> str:
    """What the reference met on its way, where it met anything."""
    met = [flag.lower() for flag in row["prediction_flags"]]
    if row["prediction_undecided_over_L"] > _OPEN:
        met.append(f"undecided by ±{row['prediction_undecided_over_L']:.3f}")
    return f" ({row['predicted_by']}: {', '.join(met)})" if met else ""


def _signed(value: float | None) -> str:
    return f"{'-':>9}" if value is None else f"{value:>+9.4f}"


def _plain(value: float | None) -> str:
    return f"{'-':>10}" if value is None else f"{value:>10.3f}"
