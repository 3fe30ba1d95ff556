"""Pressure as a control: valves and chambers as MuJoCo actuators, a gait as their control sequence.

The moment of a chamber on its hinges, beside that of the layer D0, is p (alpha D0 + eta k) +
alpha eta p^2 with curvature k (9), or p alpha D0 at constant pressure. So at constant pressure each
segment has one actuator, whose control is its pressure; by (9) each hinge has one whose gain is
affine in its angle and whose control is the pressure, and each segment one for the square. A
chamber that follows its valve by one time constant is a filter on the control; the control of the
square is what makes its filter follow the square of the pressure. Of valves that do more (see
mjsim.scene.Valves) the pressure itself is the control.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene import pneunet
from analytic.scene.chain import element_lengths, segment_overlap
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]


def controls(
    scene: Scene, numerics: Resolved, valves: Array, before: Array, pressures: Array
) -> Array:
    """The control sequence of a model with actuators.

    Args:
        scene, numerics: of the model.
        valves: commanded during each step, (T, S) [Pa].
        before: pressure in the chambers before the first step, (S,) [Pa].
        pressures: in the chambers at the end of each step, (T, S) [Pa].

    Returns:
        Shape (T, nu).
    """
    follows = _filtered(scene)
    inputs = valves if follows else pressures
    if scene.chamber == "constant-pressure":
        return inputs
    square = pressures**2
    hinges = inputs @ segment_overlap(scene.strip.borders, numerics.links).T
    if follows:
        keep = np.exp(-numerics.timestep / follows)
        earlier = np.concatenate([before[None] ** 2, square[:-1]])
        square = (square - keep * earlier) / (1 - keep)
    return np.concatenate([hinges, square], axis=1)


def _filtered(scene: Scene) -> float:
    """Time constant of the filter that an actuator is, 0 where the pressure itself is its input."""
    return scene.valves.time_constant or 0.0


def add_actuators(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> None:
    """Give the planar strip its actuators, in the order of `controls`."""
    robot = scene.strip
    bend = pneunet.curvature_per_pressure(robot) * pneunet.base_rigidity(robot)
    stiffen = pneunet.rigidity_per_pressure(robot)
    by_segment = scene.chamber == "constant-pressure"
    limit = robot.peak_pressure
    if not by_segment:
        slopes = -stiffen / element_lengths(robot, numerics.links)
        for hinge, slope in enumerate(slopes.tolist(), start=1):
            chamber = _actuator(spec, scene, f"chamber_{hinge}", limit)
            chamber.trntype, chamber.target = mujoco.mjtTrn.mjTRN_JOINT, f"hinge_{hinge}"
            chamber.gaintype = mujoco.mjtGain.mjGAIN_AFFINE
            chamber.gainprm[:3] = -bend, slope, 0.0
    for segment, inside in enumerate(segment_overlap(robot.borders, numerics.links).T, start=1):
        name = f"segment_{segment}"
        chamber = _actuator(spec, scene, name, limit if by_segment else limit**2)
        gain = bend if by_segment else pneunet.curvature_per_pressure(robot) * stiffen
        turn_hinges(spec, chamber, name, "hinge_", inside, -gain)


def turn_hinges(
    spec: mujoco.MjSpec, actuator: mujoco.MjsActuator, tendon: str, hinges: str, overlap: Array,
    gain: float,
) -> None:  # fmt: skip
    """Give an actuator the hinges of one segment, along a new tendon.

    Args:
        spec: the robot.
        actuator: of the segment.
        tendon: its name.
        hinges: their names before the numbers from 1.
        overlap: part of each hinge's element in the segment, (N,).
        gain: moment per control.
    """
    path = spec.add_tendon(name=tendon, group=4)
    for hinge in np.flatnonzero(overlap).tolist():
        path.wrap_joint(f"{hinges}{hinge + 1}", float(overlap[hinge]))
    actuator.trntype, actuator.target = mujoco.mjtTrn.mjTRN_TENDON, tendon
    actuator.gaintype, actuator.gainprm[0] = mujoco.mjtGain.mjGAIN_FIXED, gain


def _actuator(spec: mujoco.MjSpec, scene: Scene, name: str, limit: float) -> mujoco.MjsActuator:
    """Its control runs from 0 to the limit in the viewer; simulations may go beyond it."""
    actuator = spec.add_actuator(name=name)
    actuator.ctrlrange[:] = 0.0, limit
    actuator.ctrllimited = int(mujoco.mjtLimited.mjLIMITED_FALSE)
    if _filtered(scene):
        actuator.dyntype = mujoco.mjtDyn.mjDYN_FILTEREXACT
        actuator.dynprm[0], actuator.actearly = _filtered(scene), True
    return actuator
