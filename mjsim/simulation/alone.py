"""Distances of models that walk by themselves, by mj_step alone."""

import math
from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import segment_overlap
from analytic.scene.gait import Gait
from analytic.scene.limbs import usual_twists
from mjsim.model.standalone.shoes import refusal
from mjsim.model.standalone.strips import standalone_spec
from mjsim.results.prediction import reference
from mjsim.scene import Numerics, Resolved, Scene, resolved
from mjsim.simulation.schedule import before_start, walking

Array = NDArray[np.float64]

_RIGID = "; its limbs do not twist, as numerics.twists is not given"
RAMP_TIMES = (2.0, 8.0)  # s; at which distances are told; chosen


def distance(
    scene: Scene, ramp_time: float | None = None, numerics: Numerics | None = None,
    cycles: int = 1, model: mujoco.MjModel | None = None,
) -> Array:  # fmt: skip
    """Displacement of the left end over L in each cycle of the scene's gait, (C,).

    Args:
        scene: whose model it is, of which the gait gives the controls.
        ramp_time: duration of each ramp [s]; the gait's own if None.
        numerics: of the model.
        cycles: number of cycles.
        model: of the scene, if it is compiled.

    Raises:
        ValueError: the model has no controls, or the body cannot do what the scene asks for.
    """
    model = model or standalone_spec(scene, numerics).compile()
    if not model.nu:
        raise ValueError(f"body {scene.body} has no controls in a file that walks by itself")
    gait = scene.gait if ramp_time is None else replace(scene.gait, ramp_time=ramp_time)
    scene = replace(scene, gait=gait, cycles=cycles)
    choice = replace(resolved(scene, numerics), timestep=model.opt.timestep)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("flat").id)
    _follow(model, data, scene, choice, before_start(scene, choice))
    parts = np.array_split(walking(scene, choice, gait), cycles)
    places = [data.qpos.item(0)]
    for part in parts:
        _follow(model, data, scene, choice, part)
        places.append(data.qpos.item(0))
    return np.diff(places) / scene.robot.length


def _follow(
    model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Resolved, pressures: Array
) -> None:
    """Do a step for each row of pressures in the chambers, (T, S) [Pa]."""
    if scene.body == "cable":  # whose controls are the pressures at its joints
        pressures = pressures @ segment_overlap(scene.strip.borders, numerics.links).T
    for control in pressures:
        data.ctrl[:] = control
        mujoco.mj_step(model, data)


def measured(scene: Scene, numerics: Numerics | None = None) -> str:
    """Line on how far a file of the scene goes in a cycle.

    At RAMP_TIMES where the gait has ramps of one duration, else at its own times. Beside constant
    bounds that shoes carry stands what the bounds themselves give, since shoes know contact lengths
    nearly.
    """
    if scene.slope:
        towards = f" towards {math.degrees(scene.uphill):g} degrees from +x" if scene.uphill else ""
        return (f"its gravity is that of ground which rises by {math.degrees(scene.slope):g} "
                f"degrees{towards}; not measured, since by load it may slide")  # fmt: skip
    model = standalone_spec(scene, numerics).compile()
    rigid = "" if numerics and numerics.twists else _RIGID * usual_twists(scene.robot, 2)
    if not model.nu:
        return "it has no controls: pressure is a couple on each edge, which mjsim applies"
    gait: Gait = scene.gait
    alike = gait.repeats and not isinstance(gait.ramp_time, tuple)
    times = RAMP_TIMES if alike else (None,)
    told = []
    for time in times:
        (shift,) = distance(scene, time, numerics, model=model)
        told.append(f"{shift:+.3f} L at {time:g} s per ramp" if time else f"{shift:+.3f} L")
    line = f"measured with mj_step alone, one cycle of gait {gait.name}: {', '.join(told)}{rigid}"
    if refusal(scene) is None:
        bounds = reference(replace(scene, chamber="constant-pressure"))
        if math.isfinite(bounds.displacement[0]):
            line += f"; quasi-statically by these bounds: {bounds.displacement[0]:+.3f} L"
        elif scene.ceiling is not None:
            line += "; shoes have the contact lengths of a robot that touches no ceiling"
    return line
