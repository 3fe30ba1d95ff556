"""Gradient of a prediction, and where there is none."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from analytic.friction.laws import LAWS
from analytic.gradient.distance import derivatives, distance, terms
from analytic.gradient.inputs import Derivative, Inputs
from analytic.gradient.solved import UnclearError
from analytic.scene.ground import depends_on_speed
from analytic.scene.surface import Surface
from analytic.shapes import ContactShapes, Shapes
from analytic.solvers.models import Elastica, Solver

Array = NDArray[np.float64]

_AGREES = 3e-6  # over L, of the walk's distance and that of the ends of its slides; chosen
_OTHERS = {  # fields at whose present value, nothing, no effect of theirs is differentiated
    "surface.viscosity": "a film", "surface.adhesion": "adhesion", "friction.slope": "a slope",
    "surface.static_ratio": "friction that falls with speed",
}  # fmt: skip


def gradient(
    inputs: Inputs,
    solver: Solver,
    shapes: Shapes,
    left: Array,
    times: Array,
    cycles: int,
    names: Sequence[str],
) -> dict[str, Derivative]:
    """Derivatives of the distance of the last of some cycles.

    Args:
        inputs: the scene.
        solver: that walked it.
        shapes, left, times, cycles: of the walk, see analytic.prediction.Prediction.
        names: of the fields, as in robot.length.

    Raises:
        ValueError: there is no such field, or it has no number.
    """
    for name in names:
        inputs.of(name)
    reason = why_not(inputs, solver)
    if not reason and isinstance(shapes, ContactShapes) and isinstance(solver, Elastica):
        try:
            slide_ends = terms(inputs, shapes, left, times, cycles, solver.chamber)
            walked = _last_cycle(left, times, cycles)
            if not abs(distance(slide_ends) - walked) <= _AGREES * inputs.robot.length:
                raise UnclearError("the ends of slides that were found do not add up to the walk's "
                                   "distance")  # fmt: skip
            smooth = [name for name in names if name not in _OTHERS]
            result = derivatives(inputs, slide_ends, smooth, solver.links, solver.chamber)
            return {
                name: result.get(name)
                or _none(inputs, name, f"{_OTHERS.get(name)} is not differentiated")
                for name in names
            }
        except UnclearError as error:
            reason = str(error)
    return {name: _none(inputs, name, reason) for name in names}


def why_not(inputs: Inputs, solver: Solver) -> str:
    """Reason why walks of a scene are not differentiated, empty if they are."""
    robot, surface, friction = inputs.robot, inputs.surface, inputs.friction
    asked = {
        "models other than the elastica": not isinstance(solver, Elastica),
        "ground that changes along x": not isinstance(surface, Surface),
        "friction between the ends": friction.contacts == "all",
        "friction by load": LAWS[friction.law].needs_load,
        "slopes": friction.slope != 0,
        "feet": bool(robot.feet),
        "payloads": bool(robot.payload),
        "tethers": robot.tether is not None,
        "actuators that were measured": robot.actuator is not None,
    }
    if isinstance(surface, Surface):
        asked["adhesive ground"] = surface.adhesion > 0
        asked["ground that resists by speed"] = depends_on_speed(surface)
    refused = [what for what, present in asked.items() if present]
    return f"there is no derivative yet for {refused[0]}" if refused else ""


def _last_cycle(left: Array, times: Array, cycles: int) -> float:
    ends = np.interp([times[-1] / cycles * (cycles - 1), times[-1]], times, left)
    return float(ends[1] - ends[0])


def _none(inputs: Inputs, name: str, reason: str) -> Derivative:
    value = np.array(inputs.of(name), dtype=float)
    if name == "gait.stages" and inputs.gait.repeats:
        value = value[:-1]
    return Derivative(np.full(value.shape, np.nan), reason)
