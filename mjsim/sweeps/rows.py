"""Rows of results from points of a plan: the work of a worker."""

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from analytic.locomotion import direction
from analytic.shapes import Flag
from analytic.solvers.models import REFERENCE
from analytic.uncertainty import UNSOUND, modes_error
from mjsim.files.scene_tables.quantities import with_fields
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.results.prediction import (
    QUASI_STATIC,
    displacement,
    nap_error,
    prediction,
    reference,
)
from mjsim.scene import Numerics, Scene

_BOUNDED = 1e-3  # uncertainty over L up to which assumed contacts are no flag; chosen
REFUSED, CRASHED = "refused", "crashed"  # a bad scene; one that broke its process

OUTPUTS: dict[str, tuple[str, str, str]] = {  # column: type, unit, meaning
    "status": ("TEXT", "", "ok, or flags and failures of the model; refused, crashed"),
    "message": ("TEXT", "", "why there is no result"),
    "displacement_over_L": ("REAL", "1", "displacement ahead per cycle over the length, of a "
                            "strip's left end or a trunk's beginning"),
    "uncertainty_over_L": ("REAL", "1", "what is known of its error: of mujoco what inertia does, "
                           "of auto the last change too, of modes and lifted their assumption"),
    "displacement_m": ("REAL", "m", "the same"),
    "speed_m_per_s": ("REAL", "m/s", "the same over the period of the gait"),
    "direction": ("TEXT", "", "forward, backward, or none: within its uncertainty or 0.002 L"),
    "turn_deg": ("REAL", "deg", "turn to the left per cycle, of a robot of limbs"),
    "amplitude_over_L": ("REAL", "1", "greatest height over the length"),
    "cpu_s": ("REAL", "s", "time of all cores that the scene took, set-up included"),
}  # fmt: skip

Row = dict[str, Any]


@dataclass(frozen=True)
class Job:
    """Scenes to predict together.

    Attributes:
        base: tables of the scene that they start from.
        model: one of mjsim.sweeps.plan.MODELS.
        points: number of a scene, and its values of the fields in which scenes differ.
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
    """Row of each scene, with its number as `id`; of a bad one the message."""
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
        predict = _checked if job.model == "auto" else _predicted
        for number, scene, numerics in good:
            started = time.process_time()
            try:
                rows[number] = predict(job, scene, numerics)
            except ValueError as error:
                rows[number] = refused(str(error))
            rows[number]["cpu_s"] = time.process_time() - started
    share = (time.process_time() - began) / len(job.points)
    return [
        {"id": number, **rows[number], "cpu_s": rows[number].get("cpu_s", share)}
        for number, _ in job.points
    ]


def refused(message: str, status: str = REFUSED) -> Row:
    """Row of a scene without a result."""
    return {"status": status, "message": " ".join(message.split())}


def _simulated(job: Job, scenes: Sequence[tuple[int, Scene, Numerics]]) -> dict[int, Row]:
    from mjsim.results.trajectory import Trajectory
    from mjsim.simulation.side_by_side.simulate import simulate_batch

    rows: dict[int, Row] = {}
    alike: dict[Numerics, list[tuple[int, Scene]]] = {}
    for number, scene, numerics in scenes:
        alike.setdefault(job.numerics or numerics, []).append((number, scene))
    for numerics, group in alike.items():
        walks = simulate_batch([scene for _, scene in group], numerics)
        for (number, _), walk in zip(group, walks, strict=True):
            if isinstance(walk, Trajectory):
                rows[number] = _walked(walk)
            else:
                rows[number] = refused(walk.message)
    return rows


def _checked(job: Job, scene: Scene, numerics: Numerics) -> Row:
    from mjsim.simulation.checked import walk_checked

    check = walk_checked(scene, job.tolerance, twists=numerics.twists)
    row = _walked(check.walk)
    if not check.agreed:
        row["status"] = "unconverged" if row["status"] == "ok" else row["status"]
    elif "uncertainty_over_L" in row and math.isfinite(check.error):
        row["uncertainty_over_L"] = (row["uncertainty_over_L"] or 0.0) + check.error
        row["direction"] = direction(row["displacement_over_L"], 1.0, row["uncertainty_over_L"])
    return row


def _walked(walk: Any) -> Row:
    from mjsim.results.measures import measure

    numbers = measure(walk)
    if numbers is None:
        return {"status": str(walk.status)}
    error = abs(numbers.unexplained)
    return _row(
        walk.scene, str(walk.status), numbers.displacement, None if math.isnan(error) else error,
        numbers.amplitude, numbers.turn,
    )  # fmt: skip


def _predicted(job: Job, scene: Scene, numerics: Numerics) -> Row:
    if job.model == QUASI_STATIC:
        theory = reference(scene, numerics)
        shift, flags = float(theory.displacement[0]), "+".join(theory.flags) or "ok"
        if not math.isfinite(shift):
            return {"status": flags}
        height = theory.height / scene.robot.length
        return _row(scene, flags, shift, None, height, theory.turn)
    walk = prediction(scene, job.model, states=job.states, bent=job.bent)
    length, shift = scene.robot.length, displacement(scene, walk)
    error = modes_error(walk) / length if job.model in ("modes", "lifted") else None
    weak = not (job.bent and job.model == REFERENCE)
    over_nap = nap_error(scene, shift) if weak and math.isfinite(shift) else 0.0
    unsure = walk.flags
    if error is not None and error <= _BOUNDED:  # what these flags may do is known, and little
        unsure &= ~(UNSOUND | Flag.SEVERAL_ROOTS)
    flags = "+".join(flag.name.lower() for flag in unsure if flag.name) or "ok"
    if not math.isfinite(shift):
        return {"status": flags}
    if over_nap:
        total = (error or 0.0) + over_nap
        error = total if math.isfinite(total) else None
    return _row(scene, flags, shift, error, float(np.nanmax(walk.shapes.amplitude)) / length)


def _row(
    scene: Scene, status: str, shift: float, error: float | None, amplitude: float,
    turn: float = 0.0,
) -> Row:  # fmt: skip
    """Row of a scene with a result: displacement, its uncertainty and amplitude over L."""
    metres = shift * scene.robot.length
    return {
        "status": status,
        "displacement_over_L": shift,
        "uncertainty_over_L": error,
        "displacement_m": metres,
        "speed_m_per_s": metres / scene.gait.period,
        "direction": direction(shift, 1.0, error or 0.0),
        "turn_deg": math.degrees(turn) if scene.in_space else None,
        "amplitude_over_L": amplitude,
    }
