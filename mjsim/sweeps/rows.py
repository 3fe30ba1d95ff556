"""From points of a plan to rows of results: what a worker does."""

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from analytic.locomotion import direction
from analytic.uncertainty import modes_error
from mjsim.files.quantities import with_fields
from mjsim.files.tables import Tables, build
from mjsim.results.prediction import displacement, prediction
from mjsim.scene import Numerics, Scene

REFUSED, CRASHED = "refused", "crashed"  # a bad scene; one that took its process down

OUTPUTS: dict[str, tuple[str, str, str]] = {  # column: type, unit, what it is
    "status": ("TEXT", "", "ok, or flags and failures of the model; refused, crashed"),
    "message": ("TEXT", "", "why there is no result"),
    "displacement_over_L": ("REAL", "1", "displacement of the left end per cycle over the length"),
    "uncertainty_over_L": ("REAL", "1", "what is known of its error: of mujoco what inertia does, "
                           "of auto the last change too, of modes and lifted their assumption"),
    "displacement_m": ("REAL", "m", "displacement of the left end per cycle"),
    "speed_m_per_s": ("REAL", "m/s", "the same over the period of the gait"),
    "direction": ("TEXT", "", "forward, backward, or none: within its uncertainty or 0.002 L"),
    "amplitude_over_L": ("REAL", "1", "greatest height over the length"),
    "cpu_s": ("REAL", "s", "time of all cores that the scene took, set-up included"),
}  # fmt: skip

Row = dict[str, Any]


@dataclass(frozen=True)
class Job:
    """Some scenes to predict.

    Attributes:
        base: tables of the scene that they start from.
        model: of mjsim.sweeps.plan.MODELS.
        points: number of a scene, and its fields in which scenes differ.
        numerics: of mujoco, in place of the scenes' own.
        tolerance: of auto.
        states: of the theory in a ramp.
        bent: whether friction bends the strip of the theory.
    """

    base: Tables
    model: str
    points: Sequence[tuple[int, Mapping[str, Any]]]
    numerics: Numerics | None = None
    tolerance: float = 0.02
    states: int = 20
    bent: bool = False


def rows_of(job: Job) -> list[Row]:
    """A row a scene, with its number as `id`; of a bad one the message."""
    began = time.process_time()
    rows: dict[int, Row] = {}
    good: list[tuple[int, Scene, Numerics]] = []
    for number, values in job.points:
        try:
            good.append((number, *build(with_fields(job.base, values))))
        except ValueError as error:
            rows[number] = refused(str(error))
    if job.model == "mujoco":
        rows |= _simulated(job, good)
    else:
        one = _checked if job.model == "auto" else _predicted
        for number, scene, _ in good:
            started = time.process_time()
            try:
                rows[number] = one(job, scene)
            except ValueError as error:
                rows[number] = refused(str(error))
            rows[number]["cpu_s"] = time.process_time() - started
    share = (time.process_time() - began) / len(job.points)
    return [
        {"id": number, **rows[number], "cpu_s": rows[number].get("cpu_s", share)}
        for number, _ in job.points
    ]


def refused(message: str, status: str = REFUSED) -> Row:
    """The row of a scene without a result."""
    return {"status": status, "message": " ".join(message.split())}


def _simulated(job: Job, scenes: Sequence[tuple[int, Scene, Numerics]]) -> dict[int, Row]:
    from mjsim.results.trajectory import Trajectory
    from mjsim.simulation.batch_simulate import simulate_batch

    rows: dict[int, Row] = {}
    alike: dict[Numerics, list[tuple[int, Scene]]] = {}
    for number, scene, own in scenes:
        alike.setdefault(job.numerics or own, []).append((number, scene))
    for numerics, group in alike.items():
        walks = simulate_batch([scene for _, scene in group], numerics)
        for (number, _), walk in zip(group, walks, strict=True):
            if isinstance(walk, Trajectory):
                rows[number] = _walked(walk)
            else:
                rows[number] = refused(walk.message)
    return rows


def _checked(job: Job, scene: Scene) -> Row:
    from mjsim.simulation.checked import walk_checked

    found = walk_checked(scene, job.tolerance)
    row = _walked(found.walk)
    if not found.agreed:
        row["status"] = "unconverged" if row["status"] == "ok" else row["status"]
    elif "uncertainty_over_L" in row and math.isfinite(found.error):
        row["uncertainty_over_L"] += found.error
        row["direction"] = direction(row["displacement_over_L"], 1.0, row["uncertainty_over_L"])
    return row


def _walked(walk: Any) -> Row:
    from mjsim.results.measures import measure

    numbers = measure(walk)
    if numbers is None:
        return {"status": str(walk.status)}
    scene = walk.scene
    shift = numbers.displacement * scene.robot.length
    known = abs(numbers.unexplained)
    return {
        "status": str(walk.status),
        "displacement_over_L": numbers.displacement,
        "uncertainty_over_L": None if math.isnan(known) else known,
        "displacement_m": shift,
        "speed_m_per_s": shift / scene.gait.period,
        "direction": direction(numbers.displacement, 1.0, 0.0 if math.isnan(known) else known),
        "amplitude_over_L": numbers.amplitude,
    }


def _predicted(job: Job, scene: Scene) -> Row:
    walk = prediction(scene, job.model, states=job.states, bent=job.bent)
    length, shift = scene.robot.length, scene.robot.length * displacement(scene, walk)
    flags = "+".join(flag.name.lower() for flag in walk.flags if flag.name) or "ok"
    if not math.isfinite(shift):
        return {"status": flags}
    assumed = modes_error(walk) / length if job.model in ("modes", "lifted") else None
    return {
        "status": flags,
        "displacement_over_L": shift / length,
        "uncertainty_over_L": assumed,
        "displacement_m": shift,
        "speed_m_per_s": shift / scene.gait.period,
        "direction": direction(shift / length, 1.0, assumed or 0.0),
        "amplitude_over_L": float(np.nanmax(walk.shapes.amplitude)) / length,
    }
